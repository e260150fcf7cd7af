#include "gui/timeline/timeline.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/timeline/timeline_tracks.h"
#include "gui/timeline/transport_icon.h"
#include "gui/viewer/motion_scene.h"
#include "gui/viewing/looked_at.h"
#include "gui/viewing/why_no_value.h"

namespace kinegraph {
namespace {
constexpr double speeds[] = {0.1, 0.25, 0.5, 1, 2, 4};
constexpr int patience_ms = 250;
}  // namespace

Timeline::Timeline(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
                   QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      playback_(playback),
      viewer_(viewer),
      theme_(&dark_theme()) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Timeline"));
  patience_.setSingleShot(true);
  patience_.setInterval(patience_ms);
  connect(&patience_, &QTimer::timeout, this, [this] {
    playable_ = false;
    take_values();
  });
  build();
  connect(&session_, &Session::selection_changed, this, &Timeline::find_wanted);
  connect(&session_, &Session::meaning_changed, this, &Timeline::find_wanted);
  connect(&evaluation_, &Evaluation::values_changed, this, &Timeline::take_values);
  connect(&viewer_, &Viewer::shown_changed, this, &Timeline::take_values);
  // Why there is nothing to play yet may have changed.
  connect(&evaluation_, &Evaluation::status_changed, this, [this](const QString& node) {
    for (const Viewer::Shown& one : viewer_.shown())
      if (!one.motion && (!playable_ || one.target.node == node.toStdString())) return take_values();
  });
  connect(&viewer_.motions(), &ShownMotions::made, this, &Timeline::take_values);
  connect(&playback_, &Playback::state_changed, this, &Timeline::update_state);
  connect(&playback_, &Playback::clip_changed, this, &Timeline::update_moment);
  connect(&playback_, &Playback::moved, this, &Timeline::update_moment);
  set_theme(*theme_);
  find_wanted();
  update_state();
}

void Timeline::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(6, 3, 6, 3);
  row->setSpacing(2);
  const auto button = [&](TransportIcon icon, const QString& name, const QString& tip) {
    auto* one = new QToolButton(this);
    one->setAccessibleName(name);
    one->setToolTip(tip);
    one->setIconSize({18, 18});
    one->setAutoRaise(true);
    row->addWidget(one);
    buttons_.push_back({one, icon});
    return one;
  };
  connect(button(TransportIcon::start, tr("To the start"), tr("To the start (Home)")), &QToolButton::clicked,
          &playback_, &Playback::to_start);
  connect(button(TransportIcon::back, tr("A frame back"), tr("A frame back (Left)")), &QToolButton::clicked,
          this, [this] { playback_.step(-1); });
  play_ = button(TransportIcon::play, tr("Play"), tr("Plays and pauses (Space)"));
  connect(play_, &QToolButton::clicked, &playback_, &Playback::toggle);
  connect(button(TransportIcon::forward, tr("A frame on"), tr("A frame on (Right)")), &QToolButton::clicked,
          this, [this] { playback_.step(1); });
  connect(button(TransportIcon::end, tr("To the end"), tr("To the end (End)")), &QToolButton::clicked,
          &playback_, &Playback::to_end);
  loop_ = button(TransportIcon::loop, tr("Loop"), tr("Starts again at the end (L)"));
  loop_->setCheckable(true);
  connect(loop_, &QToolButton::toggled, &playback_, &Playback::set_loops);
  row->addSpacing(8);
  speed_ = new QComboBox(this);
  for (double speed : speeds) speed_->addItem(QString("%1 ×").arg(speed), speed);
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Speed of playing"));
  speed_->setFocusPolicy(Qt::ClickFocus);
  connect(speed_, &QComboBox::activated, this,
          [this](int index) { playback_.set_speed(speed_->itemData(index).toDouble()); });
  row->addWidget(speed_);
  row->addSpacing(8);
  connect(button(TransportIcon::in, tr("Start of the range here"), tr("The range starts here (I)")),
          &QToolButton::clicked, this, [this] { set_in(); });
  connect(button(TransportIcon::out, tr("End of the range here"), tr("The range ends here (O)")),
          &QToolButton::clicked, this, [this] { set_out(); });
  row->addStretch(1);
  moment_ = new QLabel(this);
  moment_->setAccessibleName(tr("Moment"));
  moment_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  row->addWidget(moment_);
  column->addLayout(row);
  tracks_ = new TimelineTracks(playback_, this);
  tracks_->setFocusPolicy(Qt::StrongFocus);
  setFocusProxy(tracks_);  // which shows that the keyboard is here
  column->addWidget(tracks_, 1);
}

void Timeline::set_theme(const Theme& theme) {
  theme_ = &theme;
  tracks_->set_theme(theme);
  take_values();
  update_state();
}

std::vector<Target> Timeline::wanted() const {
  return wanted_;
}

void Timeline::keyPressEvent(QKeyEvent* event) {
  const int step = event->modifiers() & Qt::ShiftModifier ? 10 : 1;
  if (!playable_ || event->modifiers() & (Qt::ControlModifier | Qt::AltModifier))
    return QWidget::keyPressEvent(event);
  switch (event->key()) {
    case Qt::Key_Space:
      return playback_.toggle();
    case Qt::Key_Left:
      return playback_.step(-step);
    case Qt::Key_Right:
      return playback_.step(step);
    case Qt::Key_Home:
      return playback_.to_start();
    case Qt::Key_End:
      return playback_.to_end();
    case Qt::Key_I:
      return set_in();
    case Qt::Key_O:
      return set_out();
    case Qt::Key_X:
      return playback_.clear_range();
    case Qt::Key_L:
      return playback_.set_loops(!playback_.loops());
    case Qt::Key_Up:
    case Qt::Key_Down:
      return change_speed(event->key() == Qt::Key_Up ? 1 : -1);
    default:
      QWidget::keyPressEvent(event);
  }
}

void Timeline::set_in() {
  playback_.set_range(playback_.frame(), std::max(playback_.out(), playback_.frame() + 1));
}

void Timeline::set_out() {
  playback_.set_range(std::min(playback_.in(), playback_.frame()), playback_.frame() + 1);
}

void Timeline::change_speed(int steps) {
  const int index = std::clamp(speed_->currentIndex() + steps, 0, speed_->count() - 1);
  playback_.set_speed(speed_->itemData(index).toDouble());
}

void Timeline::find_wanted() {
  const Document& document = session_.document();
  std::vector<Target> wanted;
  warp_ = source_ = reference_ = Target();
  // Only where the person looks at a warp: at its node, or at one that takes it.
  const std::string& current = session_.current();
  if (!current.empty())
    if (auto warp = nearest_warp(document, session_.registry(), current)) {
      warp_ = *warp;
      wanted.push_back(warp_);
      const std::vector<Target> sources = linked_to(document, warp_.node, "source");
      const std::vector<Target> references = linked_to(document, warp_.node, "reference");
      if (!sources.empty() && !references.empty()) {
        source_ = sources.front();
        reference_ = references.front();
        wanted.push_back(source_);
        wanted.push_back(reference_);
      }
    }
  const auto same = [](const Target& a, const Target& b) { return a.node == b.node && a.port == b.port; };
  const bool changed = !std::equal(wanted.begin(), wanted.end(), wanted_.begin(), wanted_.end(), same);
  wanted_ = std::move(wanted);
  take_values();
  if (changed) emit wanted_changed();
}

std::optional<Target> Timeline::nearest_warp(const Document& document, const Registry& registry,
                                             const std::string& node) const {
  const std::vector<Target> own = outputs_of(document, registry, node, "Warp");
  if (!own.empty()) return own.front();
  auto found = document.nodes.find(node);
  if (found == document.nodes.end()) return {};
  for (const auto& [port, inputs] : found->second.inputs)
    for (const Link& link : inputs.links)
      if (type_of_output(document, registry, {link.node, link.port}) == "Warp")
        return Target{link.node, link.port};
  return {};
}

void Timeline::take_values() {
  const Viewer::Shown* main = nullptr;
  const auto& shown = viewer_.shown();
  const bool any =
      std::any_of(shown.begin(), shown.end(), [](const auto& one) { return one.motion != nullptr; });
  if (any) {
    patience_.stop();
  } else if (shown.empty() || !is_on_its_way(session_, evaluation_, shown.front().target.node)) {
    playback_.pause();  // else it would go on unseen
  } else if (playable_) {
    if (!patience_.isActive()) patience_.start();
    return;
  }
  std::vector<TimelineTracks::Row> rows;
  std::shared_ptr<const Warp> warp;
  if (!warp_.node.empty())
    warp = std::dynamic_pointer_cast<const Warp>(evaluation_.value(warp_.node, warp_.port));
  if (warp && !source_.node.empty()) {
    const auto row = [&](const Target& target, const QColor& color) {
      rows.push_back({QString::fromStdString(target.node), color,
                      viewer_.motions().find(evaluation_.value(target.node, target.port))});
    };
    row(source_, theme_->accent);
    row(reference_, theme_->second);
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Viewer::Shown& one = shown[i];
    if (one.motion && !main) main = &one;
    const QString name = QString::fromStdString(one.target.node);
    const bool there =
        std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.motion == one.motion; });
    if (!there)
      rows.push_back({name, color_of_shown(*theme_, i), one.motion,
                      one.motion ? QString() : why_no_value(session_, evaluation_, one.target.node),
                      one.contacts()});
  }
  if (main) playback_.set_clip(main->motion->fps, main->motion->frames);
  const bool with_warp = warp && rows.size() >= 2 && !source_.node.empty();
  tracks_->set_warp(with_warp && !warp->identity ? warp : nullptr);
  tracks_->set_rows(std::move(rows));
  set_playable(main != nullptr);
}

void Timeline::set_playable(bool playable) {
  if (playable == playable_ && play_->isEnabled() == playable) return;
  playable_ = playable;
  for (const auto& [button, icon] : buttons_) button->setEnabled(playable);
  speed_->setEnabled(playable);
  update_moment();
}

void Timeline::update_state() {
  QColor unusable = theme_->faint_text;
  unusable.setAlpha(85);
  for (const auto& [button, icon] : buttons_) {
    const bool pausing = icon == TransportIcon::play && playback_.is_playing();
    button->setIcon(
        transport_icon(pausing ? TransportIcon::pause : icon, theme_->text, unusable, devicePixelRatioF()));
  }
  const QSignalBlocker quiet(loop_);
  loop_->setChecked(playback_.loops());
  for (int i = 0; i < speed_->count(); ++i)
    if (speed_->itemData(i).toDouble() == playback_.speed()) speed_->setCurrentIndex(i);
  update_moment();
}

void Timeline::update_moment() {
  if (!playback_.frames() || !playable_) return moment_->clear();
  moment_->setText(tr("frame %1 of %2   %3 s   %4 fps")
                       .arg(playback_.frame())
                       .arg(playback_.frames())
                       .arg(playback_.time(), 0, 'f', 2)
                       .arg(playback_.fps(), 0, 'g', 5));
  // Of a size of its own, so that not every frame lays out the window anew.
  const QSize needed = moment_->sizeHint();
  if (needed.width() > moment_->width() || needed.height() != moment_->height())
    moment_->setFixedSize(needed + QSize(moment_->fontMetrics().horizontalAdvance("00"), 0));
}

}  // namespace kinegraph
