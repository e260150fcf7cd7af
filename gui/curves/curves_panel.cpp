#include "gui/curves/curves_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/curves/axis.h"
#include "gui/curves/bar_plot.h"
#include "gui/curves/channel_plot.h"
#include "gui/curves/warp_plot.h"
#include "gui/viewing/looked_at.h"
#include "gui/viewing/why_no_value.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/motion.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"

namespace kinegraph {
namespace {

enum Page { words_page, channels_page, warp_page, bars_page };

bool same(const Target& a, const Target& b) {
  return a.node == b.node && a.port == b.port;
}

enum Channel { position, speed, rotation };

// Series of one joint out of positions that are ready.
std::vector<PlotSeries> series_of(const ShownMotion& motion, int point, Channel channel, const QString& whose,
                                  bool source) {
  std::vector<PlotSeries> all;
  const std::size_t frames = static_cast<std::size_t>(motion.frames);
  const auto add = [&](const char* name, int hue) -> std::vector<float>& {
    PlotSeries& one = all.emplace_back();
    one.name = name;
    one.whose = whose;
    one.fps = motion.fps;
    one.hue = hue;
    one.source = source;
    one.values.reserve(frames);
    return one.values;
  };
  if (channel == rotation) {
    // The turn from rest as a vector along its axis, in the parent's frame.
    const auto* spoken = dynamic_cast<const Motion*>(motion.value.get());
    if (!spoken || point >= spoken->joints()) return all;
    all.reserve(3);
    std::vector<float>*x = &add("x", 0), *y = &add("y", 1), *z = &add("z", 2);
    const Quat rest = inverse(spoken->skeleton().joints[static_cast<std::size_t>(point)].rest);
    Quat before;
    for (std::size_t t = 0; t < frames; ++t) {
      before = nearer(spoken->rotation(point)[t] * rest, before);
      const Vec3 turned = 2 * degrees_per_radian * log(before);
      x->push_back(static_cast<float>(turned.x));
      y->push_back(static_cast<float>(turned.y));
      z->push_back(static_cast<float>(turned.z));
    }
  } else if (channel == position) {
    all.reserve(3);
    std::vector<float>*x = &add("x", 0), *y = &add("y", 1), *z = &add("z", 2);
    for (int t = 0; t < motion.frames; ++t) {
      const ShownMotion::Point3& p = motion.at(t, point);
      x->push_back(p.x);
      y->push_back(p.y);
      z->push_back(p.z);
    }
  } else {
    std::vector<float>& values = add("speed", 2);
    for (int t = 0; t < motion.frames; ++t) {
      const ShownMotion::Point3 &a = motion.at(std::max(0, t - 1), point),
                                &b = motion.at(std::min(motion.frames - 1, t + 1), point);
      const float span =
          static_cast<float>((std::min(motion.frames - 1, t + 1) - std::max(0, t - 1)) / motion.fps);
      const float way =
          std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y) + (b.z - a.z) * (b.z - a.z));
      values.push_back(span > 0 ? way / span : 0);
    }
  }
  return all;
}

// "m/s3" as it is written by hand.
QString raised(const std::string& unit) {
  return QString::fromStdString(unit).replace("s2", "s²").replace("s3", "s³");
}

}  // namespace

CurvesPanel::CurvesPanel(Session& session, Evaluation& evaluation, Playback& playback, Viewer& viewer,
                         QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      playback_(playback),
      viewer_(viewer),
      theme_(&dark_theme()) {
  setAccessibleName(tr("Curves"));
  build();
  connect(&session_, &Session::selection_changed, this, &CurvesPanel::find_wanted);
  connect(&session_, &Session::meaning_changed, this, &CurvesPanel::find_wanted);
  connect(&evaluation_, &Evaluation::values_changed, this, &CurvesPanel::take_values);
  connect(&viewer_.motions(), &ShownMotions::made, this, &CurvesPanel::take_values);
  connect(&evaluation_, &Evaluation::status_changed, this, [this] {
    if (visible_ && pages_->currentIndex() == words_page) take_values();
  });
  set_theme(*theme_);
  find_wanted();
}

void CurvesPanel::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 5, 8, 5);
  row->setSpacing(6);
  const auto choice = [&](const QString& name) {
    auto* one = new QComboBox(this);
    one->setAccessibleName(name);
    one->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    row->addWidget(one);
    return one;
  };
  what_ = choice(tr("What is plotted"));
  joint_ = choice(tr("Joint"));
  channel_ = choice(tr("Channel"));
  channel_->addItems({tr("Position"), tr("Speed"), tr("Rotation")});
  row->addStretch(1);
  column->addLayout(row);
  pages_ = new QStackedWidget(this);
  column->addWidget(pages_, 1);
  empty_ = new QLabel(this);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  empty_->setMargin(24);
  pages_->addWidget(empty_);
  channels_ = new ChannelPlot(playback_, this);
  pages_->addWidget(channels_);
  warp_ = new WarpPlot(playback_, this);
  pages_->addWidget(warp_);
  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  bars_ = new BarPlot(scroll);
  scroll->setWidget(bars_);
  pages_->addWidget(scroll);
  connect(what_, &QComboBox::activated, this, [this](int) {
    if (const Offer* one = offer()) looked_at_ = QString::fromStdString(one->type);
    take_values();
  });
  connect(joint_, &QComboBox::activated, this, &CurvesPanel::take_values);
  connect(channel_, &QComboBox::activated, this, &CurvesPanel::take_values);
}

void CurvesPanel::set_theme(const Theme& theme) {
  theme_ = &theme;
  channels_->set_theme(theme);
  warp_->set_theme(theme);
  bars_->set_theme(theme);
  QPalette colors = empty_->palette();
  colors.setColor(QPalette::WindowText, theme.faint_text);
  empty_->setPalette(colors);
}

std::vector<Target> CurvesPanel::wanted() const {
  return visible_ ? wanted_ : std::vector<Target>();
}

void CurvesPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  visible_ = true;
  emit wanted_changed();
  take_values();
}

void CurvesPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  visible_ = false;
  emit wanted_changed();
}

const CurvesPanel::Offer* CurvesPanel::offer() const {
  const int index = what_->currentIndex();
  return index >= 0 && static_cast<std::size_t>(index) < offers_.size()
             ? &offers_[static_cast<std::size_t>(index)]
             : nullptr;
}

void CurvesPanel::find_wanted() {
  const Document& document = session_.document();
  const Registry& registry = session_.registry();
  std::string current = session_.current();
  if (current.empty() && !viewer_.shown().empty()) current = viewer_.shown().front().target.node;
  std::vector<Offer> offers;
  const auto first = [&](const char* port) {
    const std::vector<Target> all = linked_to(document, current, port);
    return all.empty() ? Target() : all.front();
  };
  if (document.nodes.count(current)) {
    for (const char* type : {"Warp", "Stats", "Metrics"}) {
      std::vector<Target> outputs = outputs_of(document, registry, current, type);
      if (document.nodes.find(current)->second.type == "Load" && outputs.size() > 0 &&
          std::string(type) != "Stats" && !outputs_of(document, registry, current, "Motion").empty())
        outputs.clear();
      for (const Target& output : outputs) {
        Offer one{QString::fromStdString(output.node + "." + output.port), type, output, {}, {}};
        if (one.type == "Warp") {
          one.source = first("source");
          one.reference = first("reference");
        }
        offers.push_back(std::move(one));
      }
    }
    if (auto result = nearest_output(document, registry, current, {"Motion", "Points"})) {
      Offer one{QString::fromStdString(result->node + "." + result->port), "Motion", *result, {}, {}};
      // The source: what goes into the node that made the result, and is of its kind.
      auto node = document.nodes.find(result->node);
      if (node != document.nodes.end())
        for (const auto& [port, inputs] : node->second.inputs)
          for (const Link& link : inputs.links)
            if ((port == "motion" || port == "source") && one.source.node.empty()) {
              const std::string type = type_of_output(document, registry, {link.node, link.port});
              if (type == "Motion" || type == "Points") one.source = {link.node, link.port};
            }
      offers.push_back(std::move(one));
    }
  }
  offers_ = std::move(offers);
  {
    const QSignalBlocker quiet(what_);
    QStringList names, there;
    for (const Offer& one : offers_) names << one.name;
    for (int i = 0; i < what_->count(); ++i) there << what_->itemText(i);
    if (names != there) {  // else every step of a drag would lay out the dock anew
      what_->clear();
      what_->addItems(names);
    }
    int index = 0;
    for (std::size_t i = 0; i < offers_.size(); ++i)
      if (QString::fromStdString(offers_[i].type) == looked_at_) {
        index = static_cast<int>(i);
        break;
      }
    what_->setCurrentIndex(offers_.empty() ? -1 : index);
  }
  std::vector<Target> wanted;
  for (const Offer& one : offers_)
    for (const Target& target : {one.result, one.source, one.reference})
      if (!target.node.empty() && std::none_of(wanted.begin(), wanted.end(),
                                               [&](const Target& other) { return same(other, target); }))
        wanted.push_back(target);
  const bool changed = !std::equal(wanted.begin(), wanted.end(), wanted_.begin(), wanted_.end(), same);
  wanted_ = std::move(wanted);
  take_values();
  if (changed && visible_) emit wanted_changed();
}

void CurvesPanel::tell(const QString& words) {
  if (empty_->text() != words) empty_->setText(words);
  pages_->setCurrentIndex(words_page);
}

void CurvesPanel::take_values() {
  const Offer* one = offer();
  const bool channels = one && one->type == "Motion";
  const bool there = one && evaluation_.value(one->result.node, one->result.port);
  joint_->setVisible(channels && (there || joint_->count() > 0));
  channel_->setVisible(channels && (there || joint_->count() > 0));
  what_->setVisible(one != nullptr);
  if (!one && !session_.current().empty() && session_.document().nodes.count(session_.current()))
    return tell(tr("Nothing of %1 can be plotted. Choose a node to see its channels, statistics or warp.")
                    .arg(QString::fromStdString(session_.current())));
  if (!one) return tell(tr("Choose a node to see its channels, statistics or warp as curves."));
  if (!visible_) return;
  const ValuePtr value = evaluation_.value(one->result.node, one->result.port);
  if (!value) return tell(why_no_value(session_, evaluation_, one->result.node));
  if (one->type == "Warp")
    show_warp(*one);
  else if (channels)
    show_channels(*one);
  else
    show_bars(*one);
}

void CurvesPanel::fill_joints(const ShownMotion& motion) {
  QStringList names;
  for (const std::string& name : motion.names)
    if (!name.empty()) names << QString::fromStdString(name);
  QStringList there;
  for (int i = 0; i < joint_->count(); ++i) there << joint_->itemText(i);
  if (names == there) return;
  const QString before = joint_->currentText();
  const QSignalBlocker quiet(joint_);
  joint_->clear();
  joint_->addItems(names);
  joint_->setCurrentIndex(std::max<int>(0, static_cast<int>(names.indexOf(before))));
}

void CurvesPanel::show_channels(const Offer& offer) {
  const auto result = viewer_.motions().find(evaluation_.value(offer.result.node, offer.result.port));
  if (!result) return tell(tr("Evaluating %1…").arg(offer.name));
  fill_joints(*result);
  const std::string name = joint_->currentText().toStdString();
  const auto channel = static_cast<Channel>(std::max(0, channel_->currentIndex()));
  std::vector<PlotSeries> series;
  const auto add = [&](const ShownMotion& motion, const QString& whose, bool source) {
    for (std::size_t i = 0; i < motion.names.size(); ++i)
      if (motion.names[i] == name) {
        for (PlotSeries& one : series_of(motion, static_cast<int>(i), channel, whose, source))
          series.push_back(std::move(one));
        break;
      }
  };
  add(*result, QString::fromStdString(offer.result.node), false);
  if (!offer.source.node.empty())
    if (const auto source = viewer_.motions().find(evaluation_.value(offer.source.node, offer.source.port)))
      add(*source, QString::fromStdString(offer.source.node), true);
  const QString units[] = {tr("m"), tr("m/s"), QStringLiteral("°")};
  channels_->set_series(std::move(series), units[channel]);
  pages_->setCurrentIndex(channels_page);
}

void CurvesPanel::show_warp(const Offer& offer) {
  warp_->set_warp(
      std::dynamic_pointer_cast<const Warp>(evaluation_.value(offer.result.node, offer.result.port)));
  const auto motion = [&](const Target& target) -> std::shared_ptr<const ShownMotion> {
    if (target.node.empty()) return nullptr;
    return viewer_.motions().find(evaluation_.value(target.node, target.port));
  };
  warp_->set_motions(motion(offer.source), motion(offer.reference));
  pages_->setCurrentIndex(warp_page);
}

void CurvesPanel::show_bars(const Offer& offer) {
  const ValuePtr value = evaluation_.value(offer.result.node, offer.result.port);
  std::vector<PlotBar> bars;
  QString title = tr("Figures; bars of the same kind have one scale");
  if (const auto* stats = dynamic_cast<const Stats*>(value.get())) {
    title = tr("How much each joint turns (standard deviation), and the root's mean ± spread");
    for (const JointStats& joint : stats->joints) {
      if (!joint.chosen) continue;
      double spread = 2 * joint.spread;  // the half-angle's, as a turn
      if (stats->space == "euler")
        spread = std::sqrt(joint.euler_spread[0] * joint.euler_spread[0] +
                           joint.euler_spread[1] * joint.euler_spread[1] +
                           joint.euler_spread[2] * joint.euler_spread[2]);
      const double degrees = spread * degrees_per_radian;
      bars.push_back(
          {QString::fromStdString(joint.joint), QString("%1°").arg(degrees, 0, 'f', 1), degrees, "spread"});
    }
    const char* const root[] = {"root sideways", "root forwards", "root height", "root turning"};
    const char* const units[] = {"m/s", "m/s", "m", "rad/s"};
    for (std::size_t i = 0; i < 4; ++i)
      bars.push_back({root[i],
                      QString("%1 ± %2 %3")
                          .arg(plain_number(std::round(100 * stats->root_mean[i]) / 100),
                               plain_number(std::round(100 * stats->root_spread[i]) / 100), units[i]),
                      stats->root_mean[i], QString("root%1").arg(i)});
  } else if (const auto* metrics = dynamic_cast<const Metrics*>(value.get())) {
    for (const Metric& metric : metrics->all) {
      const QString name = QString::fromStdString(metric.name), unit = raised(metric.unit);
      const QString shown =
          metric.value ? QString("%1 %2").arg(plain_number(*metric.value), unit) : tr("not measured");
      // Only numbers of one kind compare: those of joints by the name before the dot.
      bars.push_back({name, shown, metric.value, name.section('.', 0, 0)});
    }
  }
  if (bars.empty()) return tell(tr("Nothing to plot here."));
  bars_->set_bars(std::move(bars), title);
  pages_->setCurrentIndex(bars_page);
}

}  // namespace kinegraph
