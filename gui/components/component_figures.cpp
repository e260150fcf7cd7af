#include "gui/components/component_figures.h"

#include <QMap>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <cmath>

// Qt's word for a part of a class is the papers' name of what ICA finds.
#undef signals
#include "nodes/components/component_meaning.h"
#include "nodes/components/components.h"
#include "nodes/components/rebuild.h"
#include "nodes/time/trim.h"

namespace kinegraph {
namespace {

constexpr std::size_t drawn_values = 600;
constexpr double shown_seconds = 8;  // of a long clip: a figure shows how it moves, not all of it
constexpr std::size_t named_joints = 3;

class Stoppable : public Alone {
 public:
  explicit Stoppable(std::shared_ptr<std::atomic<bool>> stop) : stop_(std::move(stop)) {}
  void check() override {
    if (*stop_) throw Cancelled();
  }
  void progress(double) override { check(); }

 private:
  std::shared_ptr<std::atomic<bool>> stop_;
};

// The first seconds of a segment, with as much of its clip.
ComponentSegment start_of(const ComponentSegment& segment, std::size_t frames) {
  ComponentSegment part = segment;
  part.end = part.start + std::min(frames, segment.frames());
  if (segment.motion) {
    part.motion = std::make_shared<Motion>(trimmed(*segment.motion, {0, part.frames()}));
  } else if (segment.points) {
    const Points& whole = *segment.points;
    auto cut = std::make_shared<Points>(whole.labels, whole.fps, part.frames());
    cut->links = whole.links;
    for (std::size_t label = 0; label < whole.labels.size(); ++label)
      for (std::size_t t = 0; t < part.frames(); ++t)
        cut->track(static_cast<int>(label)).set(t, whole.track(static_cast<int>(label))[t]);
    part.points = cut;
  }
  return part;
}

// "RightToeBase, LeftToeBase, RightFoot" as "L+R ToeBase, R Foot".
QString shortened(const QStringList& joints) {
  static const QRegularExpression sided("^(Left|Right|left|right)[_ .]?(?=[A-Z0-9a-z])");
  QStringList parts;
  QMap<QString, QString> sides;
  for (const QString& joint : joints) {
    const QRegularExpressionMatch side = sided.match(joint);
    const QString part = side.hasMatch() ? joint.mid(side.capturedLength()) : joint;
    if (!parts.contains(part)) parts << part;
    if (side.hasMatch()) sides[part] += side.captured(1).left(1).toUpper();
  }
  for (QString& part : parts)
    if (const QString side = sides.value(part); !side.isEmpty())
      part = (side.size() > 1 ? QStringLiteral("L+R ") : side + ' ') + part;
  return parts.join(", ");
}

std::shared_ptr<const ShownMotion> figure_of(const Components& components, const ComponentSegment& part,
                                             std::size_t entry, Work& work) {
  const Rows x = channels_from_signals(components, signals_of(components, part), {entry});
  WayBack on_the_spot;
  on_the_spot.root = false;
  ValuePtr value;
  if (part.motion)
    value = std::make_shared<const Motion>(motion_of(components, x, part, on_the_spot, work));
  else
    value = std::make_shared<const Points>(points_of(components, x, part, on_the_spot, work));
  return make_shown_motion(value, work);
}

}  // namespace

std::shared_ptr<const ComponentPicture> make_component_picture(const ValuePtr& value, Work& work) {
  const auto* components = dynamic_cast<const Components*>(value.get());
  if (!components || components->segments.empty()) return nullptr;
  auto picture = std::make_shared<ComponentPicture>();
  picture->value = value;
  picture->segments = static_cast<int>(components->segments.size());
  picture->frames = static_cast<double>(components->frames());
  picture->fps = components->fps;
  for (std::size_t i = 1; i < components->segments.size(); ++i)
    picture->seams.push_back(static_cast<double>(components->segments[i].start) / picture->frames);
  const ComponentSegment part =
      start_of(components->segments.front(), static_cast<std::size_t>(shown_seconds * components->fps));
  const auto cadences = cadences_of(*components);
  for (std::size_t entry = 0; entry < components->count(); ++entry) {
    work.check();
    ComponentFigure figure;
    try {
      figure.motion = figure_of(*components, part, entry, work);
    } catch (const Failure&) {
      // Without a figure the signal and caption still tell what there is.
    }
    figure.share = QString("%1 %").arg(100 * components->shares[entry], 0, 'f', 1);
    if (cadences[entry]) figure.cadence = QString("%1 Hz").arg(cadences[entry]->hertz, 0, 'f', 1);
    QStringList words;
    const std::vector<Moved> moved = moved_by(*components, entry);
    for (std::size_t i = 0; i < std::min(named_joints, moved.size()); ++i)
      words << QString::fromStdString(moved[i].label);
    figure.joints = words.join(", ");
    figure.short_joints = shortened(words);
    figure.unique = components->unique.size() <= entry || components->unique[entry];
    const std::size_t step = std::max<std::size_t>(1, components->frames() / drawn_values);
    for (std::size_t t = 0; t < components->frames(); t += step)
      figure.signal.push_back(static_cast<float>(components->signals(entry, t)));
    picture->figures.push_back(std::move(figure));
  }
  return picture;
}

ComponentFigures::ComponentFigures(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);
  pool_.setThreadPriority(QThread::LowPriority);
}

ComponentFigures::~ComponentFigures() {
  if (stop_) *stop_ = true;
  pool_.clear();
  pool_.waitForDone();
}

std::shared_ptr<const ComponentPicture> ComponentFigures::find(const ValuePtr& value) {
  if (!value) return nullptr;
  if (value == asked_) return picture_;
  if (stop_) *stop_ = true;
  stop_ = std::make_shared<std::atomic<bool>>(false);
  asked_ = value;
  picture_.reset();
  pool_.clear();
  pool_.start([this, value, stop = stop_] {
    std::shared_ptr<const ComponentPicture> picture;
    try {
      Stoppable work(stop);
      picture = make_component_picture(value, work);
    } catch (const std::exception&) {
      return;  // stopped, or nothing that can be shown; the node itself tells what is wrong
    }
    QMetaObject::invokeMethod(
        this,
        [this, value, picture] {
          if (value != asked_) return;
          picture_ = picture;
          emit made();
        },
        Qt::QueuedConnection);
  });
  return picture_;
}

}  // namespace kinegraph
