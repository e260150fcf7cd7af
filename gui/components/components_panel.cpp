#include "gui/components/components_panel.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "graph/edit.h"
#include "gui/components/component_edits.h"
#include "gui/components/component_marks.h"
#include "gui/components/components_grid.h"
#include "gui/document/problem_text.h"
#include "gui/viewing/looked_at.h"
#include "gui/viewing/why_no_value.h"

namespace kinegraph {
namespace {

constexpr double slider_steps = 100;  // of a slider for 1

Link link_of(const Target& target) {
  Link link;
  link.node = target.node;
  link.port = target.port;
  return link;
}

}  // namespace

ComponentsPanel::ComponentsPanel(Session& session, Evaluation& evaluation, Playback& playback,
                                 QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      playback_(playback),
      theme_(&dark_theme()) {
  setAccessibleName(tr("Components"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  pages_ = new QStackedWidget(this);
  column->addWidget(pages_);
  auto* nothing = new QWidget(this);
  auto* middle = new QVBoxLayout(nothing);
  middle->setContentsMargins(24, 16, 24, 16);
  middle->setSpacing(10);
  empty_ = new QLabel(nothing);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  progress_ = new QProgressBar(nothing);
  progress_->setAccessibleName(tr("Progress"));
  progress_->setTextVisible(false);
  progress_->setFixedWidth(260);
  middle->addStretch(1);
  middle->addWidget(empty_);
  middle->addWidget(progress_, 0, Qt::AlignHCenter);
  middle->addStretch(1);
  pages_->addWidget(nothing);
  auto* page = new QWidget(this);
  parts_ = new QBoxLayout(QBoxLayout::TopToBottom, page);
  parts_->setContentsMargins(0, 0, 0, 0);
  parts_->setSpacing(0);
  auto* scroll = new QScrollArea(page);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  grid_ = new ComponentsGrid(scroll);
  scroll->setWidget(grid_);
  parts_->addWidget(scroll, 1);
  controls_ = new QScrollArea(page);
  controls_->setWidgetResizable(true);
  controls_->setFrameShape(QFrame::NoFrame);
  controls_->setFocusPolicy(Qt::NoFocus);
  controls_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  controls_->setWidget(build_controls());
  parts_->addWidget(controls_);
  pages_->addWidget(page);

  connect(grid_, &ComponentsGrid::chosen_changed, this, &ComponentsPanel::update_controls);
  connect(&session_, &Session::selection_changed, this, &ComponentsPanel::find_wanted);
  connect(&session_, &Session::meaning_changed, this, &ComponentsPanel::find_wanted);
  connect(&evaluation_, &Evaluation::values_changed, this, &ComponentsPanel::take_values);
  connect(&evaluation_, &Evaluation::status_changed, this, [this](const QString& node) {
    if (node.toStdString() == components_.node) take_values();
  });
  connect(&figures_, &ComponentFigures::made, this, &ComponentsPanel::take_values);
  set_theme(*theme_);
  find_wanted();
}

QSlider* ComponentsPanel::build_slider(const QString& name, double low, double high) {
  auto* slider = new QSlider(Qt::Horizontal, this);
  slider->setRange(static_cast<int>(low * slider_steps), static_cast<int>(high * slider_steps));
  slider->setSingleStep(5);
  slider->setPageStep(25);
  slider->setAccessibleName(name);
  connect(slider, &QSlider::sliderPressed, this, [this] { session_.begin_gesture(); });
  connect(slider, &QSlider::sliderReleased, this, [this] { session_.end_gesture(); });
  return slider;
}

QWidget* ComponentsPanel::build_controls() {
  auto* box = new QWidget(this);
  control_grid_ = new QGridLayout(box);
  control_grid_->setHorizontalSpacing(8);
  control_grid_->setVerticalSpacing(6);
  scale_ = build_slider(tr("Scale"), -1, 3);
  translate_ = build_slider(tr("Translate"), -3, 3);
  scale_label_ = new QLabel(tr("Scale"), box);
  translate_label_ = new QLabel(tr("Translate"), box);
  scale_value_ = new QLabel(box);
  translate_value_ = new QLabel(box);
  for (QLabel* label : {scale_value_, translate_value_})
    label->setFixedWidth(fontMetrics().horizontalAdvance("−0.00 σ") + 4);
  take_away_ = new QPushButton(tr("Take away"), box);
  take_away_->setToolTip(tr("Scales what is chosen to nothing"));
  merge_ = new QPushButton(tr("Merge"), box);
  merge_->setToolTip(tr("Makes the chosen components one; choose several with Ctrl"));
  from_ = new QComboBox(box);
  from_->setAccessibleName(tr("Clip that gives"));
  to_ = new QComboBox(box);
  to_->setAccessibleName(tr("Clip that receives"));
  for (QComboBox* one : {from_, to_}) {
    one->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    one->setMinimumContentsLength(6);
  }
  arrow_ = new QLabel(QStringLiteral("→"), box);
  transfer_ = new QPushButton(tr("Transfer"), box);
  transfer_->setToolTip(tr("Gives the chosen components of one clip to another"));
  told_ = new QLabel(box);
  told_->setTextFormat(Qt::PlainText);
  told_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);

  connect(scale_, &QSlider::valueChanged, this, [this](int at) { set_amount("scale", at / slider_steps); });
  connect(translate_, &QSlider::valueChanged, this,
          [this](int at) { set_amount("translate", at / slider_steps); });
  connect(take_away_, &QPushButton::clicked, this, [this] {
    session_.begin_gesture();
    set_amount("scale", 0);
    session_.end_gesture();
  });
  connect(merge_, &QPushButton::clicked, this, [this] { set_edits(with_merge(edits(), chosen())); });
  connect(transfer_, &QPushButton::clicked, this, [this] {
    set_edits(with_transfer(edits(), chosen(), from_->currentIndex(), to_->currentIndex()));
  });
  return box;
}

// In two lines above the figures where there is room for it, else in four below them.
void ComponentsPanel::lay_controls(bool above) {
  QGridLayout& grid = *control_grid_;
  while (QLayoutItem* item = grid.takeAt(0)) delete item;
  for (int column = 0; column < 13; ++column) grid.setColumnStretch(column, 0);
  if (above) {
    grid.setContentsMargins(10, 6, 10, 4);
    int column = 0;
    for (QWidget* one : std::initializer_list<QWidget*>{scale_label_, scale_, scale_value_, translate_label_,
                                                        translate_, translate_value_, take_away_, merge_})
      grid.addWidget(one, 0, column++);
    auto* clips = new QHBoxLayout;
    clips->setSpacing(8);
    clips->addWidget(told_, 1);
    for (QWidget* one : std::initializer_list<QWidget*>{from_, arrow_, to_, transfer_}) clips->addWidget(one);
    grid.addLayout(clips, 1, 0, 1, column);
    grid.setColumnStretch(1, 1);
    grid.setColumnStretch(4, 1);
  } else {
    grid.setContentsMargins(10, 8, 10, 8);
    grid.addWidget(told_, 0, 0, 1, 5);
    grid.addWidget(scale_label_, 1, 0);
    grid.addWidget(scale_, 1, 1, 1, 2);
    grid.addWidget(scale_value_, 1, 3);
    grid.addWidget(take_away_, 1, 4);
    grid.addWidget(translate_label_, 2, 0);
    grid.addWidget(translate_, 2, 1, 1, 2);
    grid.addWidget(translate_value_, 2, 3);
    grid.addWidget(merge_, 2, 4);
    grid.addWidget(from_, 3, 0, 1, 2);
    grid.addWidget(arrow_, 3, 2);
    grid.addWidget(to_, 3, 3);
    grid.addWidget(transfer_, 3, 4);
    grid.setColumnStretch(1, 1);
  }
}

void ComponentsPanel::set_theme(const Theme& theme) {
  theme_ = &theme;
  grid_->set_theme(theme);
  for (QLabel* label : {empty_, told_, arrow_}) {
    QPalette colors = label->palette();
    colors.setColor(QPalette::WindowText, theme.faint_text);
    label->setPalette(colors);
  }
}

std::vector<Target> ComponentsPanel::wanted() const {
  if (!wanting_ || components_.node.empty()) return {};
  return {components_};
}

void ComponentsPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  wanting_ = true;
  find_wanted();
  emit wanted_changed();
}

void ComponentsPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  wanting_ = false;
  emit wanted_changed();
}

void ComponentsPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const bool above = width() > 780;
  if (above != above_ || control_grid_->count() == 0) {
    above_ = above;
    lay_controls(above);
    parts_->setDirection(above ? QBoxLayout::BottomToTop : QBoxLayout::TopToBottom);
  }
  const int controls = control_grid_->parentWidget()->sizeHint().height();
  controls_->setFixedHeight(controls);
  grid_->set_room(std::max(above ? 0 : 212, height() - controls));
  control_grid_->activate();
  tell_edits();
}

void ComponentsPanel::find_wanted() {
  const Document& document = session_.document();
  const Registry& registry = session_.registry();
  const std::string& current = session_.current();
  std::optional<Target> found;
  auto node = document.nodes.find(current);
  if (node != document.nodes.end()) {
    // At an edit, what goes into it is shown: that is what its edits speak of.
    if (node->second.type == "ComponentEdit") {
      const std::vector<Target> inputs = linked_to(document, current, "components");
      if (!inputs.empty()) found = inputs.front();
    } else {
      found = nearest_output(document, registry, current, {"Components"});
    }
  }
  // What was shown before stays, while its node still makes components: a Load's new file may hold none.
  if (!found)
    for (const Target& own : outputs_of(document, registry, components_.node, "Components"))
      if (own.port == components_.port) found = components_;
  if (!found)
    for (const auto& [name, one] : document.nodes)
      if (one.type != "ComponentEdit" && !found) {
        const std::vector<Target> own = outputs_of(document, registry, name, "Components");
        if (!own.empty() && one.type != "Load") found = own.front();
      }
  const Target before = components_;
  components_ = found.value_or(Target());
  find_edit_node();
  take_values();
  if (before.node != components_.node || before.port != components_.port) emit wanted_changed();
}

void ComponentsPanel::find_edit_node() {
  const Document& document = session_.document();
  const auto takes = [&](const std::string& name) {
    auto node = document.nodes.find(name);
    if (node == document.nodes.end() || node->second.type != "ComponentEdit") return false;
    const std::vector<Target> inputs = linked_to(document, name, "components");
    return !inputs.empty() && inputs.front().node == components_.node &&
           inputs.front().port == components_.port;
  };
  if (takes(session_.current())) {
    edit_node_ = session_.current();
    return;
  }
  if (takes(edit_node_)) return;
  edit_node_.clear();
  if (components_.node.empty()) return;
  for (const auto& [name, node] : document.nodes)
    if (edit_node_.empty() && takes(name)) edit_node_ = name;
}

void ComponentsPanel::take_values() {
  ValuePtr value;
  if (!components_.node.empty()) value = evaluation_.value(components_.node, components_.port);
  auto picture = figures_.find(value);
  if (picture) {
    grid_->set_picture(picture);
    name_segments(picture->segments);
  } else {
    tell_nothing();
  }
  pages_->setCurrentIndex(picture && !components_.node.empty() ? 1 : 0);
  update_controls();
}

// Why there are no figures, and what to do about it.
void ComponentsPanel::tell_nothing() {
  const QString name = QString::fromStdString(components_.node);
  const NodeStatus* status = components_.node.empty() ? nullptr : evaluation_.status(components_.node);
  const auto state = status ? status->state : NodeStatus::State::idle;
  bool working = false;
  if (components_.node.empty()) {
    empty_->setText(
        tr("No components here. Link motions to an ICA: it finds the independent movements that they "
           "are made of, and each appears here as a small figure."));
  } else if (state == NodeStatus::State::incomplete) {
    empty_->setText(
        tr("%1 isn't linked yet.\nLink motions to it: it finds the movements they are made of.").arg(name));
  } else if (state == NodeStatus::State::failed && !status->diagnostics.empty()) {
    const Diagnostic& problem = status->diagnostics.front();
    const QString advice = advice_on(problem);
    empty_->setText(tr("%1 failed.\n%2").arg(name, problem_text(problem)) +
                    (advice.isEmpty() ? QString() : "\n" + advice));
  } else if (!is_on_its_way(session_, evaluation_, components_.node)) {
    empty_->setText(why_no_value(session_, evaluation_, components_.node));
  } else {
    working = true;
    const bool runs = state == NodeStatus::State::running;
    // Until the node itself has come some way nobody knows how long it takes.
    const int percent = runs ? static_cast<int>(std::lround(100 * status->progress)) : 0;
    progress_->setRange(0, percent > 0 ? 100 : 0);
    progress_->setValue(percent);
    empty_->setText((runs ? tr("%1 looks for the movements that its clips are made of…")
                     : state == NodeStatus::State::done ? tr("The figures of %1 are drawn…")
                                                        : tr("%1 waits for the nodes before it…"))
                        .arg(name));
  }
  progress_->setVisible(working);
}

// Segments are called after the nodes whose clips they are, in the order of the links.
void ComponentsPanel::name_segments(int count) {
  QStringList names;
  const std::vector<Target> inputs = linked_to(session_.document(), components_.node, "motions");
  for (int i = 0; i < count; ++i)
    names << (static_cast<int>(inputs.size()) == count
                  ? QString::fromStdString(inputs[static_cast<std::size_t>(i)].node)
                  : tr("clip %1").arg(i));
  for (QComboBox* one : {from_, to_}) {
    QStringList shown;
    for (int i = 0; i < one->count(); ++i) shown << one->itemText(i);
    if (shown == names) continue;
    const int before = one->currentIndex();
    one->clear();
    one->addItems(names);
    one->setCurrentIndex(std::clamp(before, 0, std::max(0, count - 1)));
  }
  if (count > 1 && from_->currentIndex() == to_->currentIndex())
    to_->setCurrentIndex(from_->currentIndex() == 0 ? 1 : 0);
}

std::vector<int> ComponentsPanel::chosen() const {
  std::vector<int> numbers;
  for (int component : grid_->chosen()) numbers.push_back(component + 1);
  return numbers;
}

Json ComponentsPanel::edits() const {
  auto node = session_.document().nodes.find(edit_node_);
  if (node != session_.document().nodes.end()) {
    auto edits = node->second.params.find("edits");
    if (edits != node->second.params.end() && edits->second.is_array()) return edits->second;
  }
  return Json(Json::Array{});
}

void ComponentsPanel::set_edits(const Json& edits) {
  const bool own_gesture = !session_.in_gesture();
  if (own_gesture) session_.begin_gesture();
  bool fine = true;
  if (edit_node_.empty()) {
    const std::string name = fresh_name(session_.document(), "ComponentEdit");
    const Target from = components_;
    fine = session_.perform([&](const Document& document, const Registry& registry) {
      return add_node(document, registry, name, "ComponentEdit");
    });
    fine = fine && session_.perform([&](const Document& document, const Registry& registry) {
      return connect_edit(document, registry, from, name);
    });
    edit_node_ = fine ? name : std::string();
  }
  if (fine)
    session_.perform([&](const Document& document, const Registry& registry) {
      return set_param(document, registry, edit_node_, "edits", edits);
    });
  if (own_gesture) session_.end_gesture();
}

Edit ComponentsPanel::connect_edit(const Document& document, const Registry& registry, const Target& from,
                                   const std::string& name) {
  Edit edit = kinegraph::connect(document, registry, link_of(from), name, "components");
  // Beside the node whose components it edits.
  auto place = document.ui.nodes.find(from.node);
  if (place != document.ui.nodes.end())
    if (const Json* at = place->second.find("pos"); at && at->is_array() && at->array().size() == 2) {
      const Json::Array pos{Json(at->array()[0].number() + 240), Json(at->array()[1].number())};
      edit = combined(std::move(edit), set_unit(document, {Unit::Kind::ui_node, name, ""},
                                                Json(Json::Object{{"pos", Json(pos)}}), "Place " + name));
    }
  return edit;
}

void ComponentsPanel::set_amount(const char* op, double amount) {
  Json all = edits();
  const std::vector<int> components = chosen();
  if (components.empty()) return;
  for (int component : components) all = with_amount(all, op, component, amount);
  set_edits(all);
}

void ComponentsPanel::tell_edits() {
  const bool any = !grid_->chosen().empty() && !session_.is_read_only();
  QString which;
  for (int component : chosen()) which += (which.isEmpty() ? "u" : ", u") + QString::number(component);
  const QString where =
      edit_node_.empty() ? tr("a new ComponentEdit") : tr("“%1”").arg(QString::fromStdString(edit_node_));
  QString words =
      any ? tr("%1: edits go to %2").arg(which, where) : tr("Click a figure; Ctrl+click takes several");
  QStringList done;
  for (const std::string& one : told(edits())) done << QString::fromStdString(one);
  told_->setText(fitting(words, done, std::max(160, told_->width())));
  told_->setToolTip(done.isEmpty() ? words : words + "\n" + tr("So far:") + "\n• " + done.join("\n• "));
}

// With as many edits as there is room for, and how many more there are.
QString ComponentsPanel::fitting(const QString& words, const QStringList& done, int room) const {
  const auto fits = [&](const QString& text) { return fontMetrics().horizontalAdvance(text) <= room; };
  for (qsizetype shown = done.size(); shown > 0; --shown) {
    QString all = words + tr(" · so far: %1").arg(done.first(shown).join(", "));
    if (shown < done.size()) all += tr(" and %1 more").arg(done.size() - shown);
    if (fits(all)) return all;
  }
  const QString counted =
      words + (done.size() == 1 ? tr(" · 1 edit so far") : tr(" · %1 edits so far").arg(done.size()));
  if (!done.isEmpty() && fits(counted)) return counted;
  return fontMetrics().elidedText(words, Qt::ElideRight, room);
}

void ComponentsPanel::update_controls() {
  const Json all = edits();
  const std::vector<int> components = chosen();
  const bool any = !components.empty() && !session_.is_read_only();
  for (QWidget* one : std::initializer_list<QWidget*>{scale_label_, scale_, scale_value_, translate_label_,
                                                      translate_, translate_value_, take_away_})
    one->setEnabled(any);
  merge_->setEnabled(any && components.size() > 1);
  const bool several = from_->count() > 1;
  transfer_->setEnabled(any && several);
  from_->setEnabled(several);
  to_->setEnabled(several);
  const double scale = any ? amount_of(all, "scale", components.front()) : 1;
  const double translate = any ? amount_of(all, "translate", components.front()) : 0;
  const auto show = [](QSlider* slider, double amount) {
    if (slider->isSliderDown()) return;
    const QSignalBlocker quiet(slider);
    slider->setValue(static_cast<int>(std::lround(amount * slider_steps)));
  };
  show(scale_, scale);
  show(translate_, translate);
  scale_value_->setText(QString("× %1").arg(scale, 0, 'f', 2));
  translate_value_->setText(QString("%1 σ").arg(translate, 0, 'f', 2));
  tell_edits();
  std::vector<QString> badges;
  if (auto picture = figures_.find(
          components_.node.empty() ? nullptr : evaluation_.value(components_.node, components_.port)))
    for (std::size_t i = 0; i < picture->figures.size(); ++i)
      badges.push_back(QString::fromStdString(mark_of(all, static_cast<int>(i) + 1)));
  grid_->set_badges(std::move(badges));
}

}  // namespace kinegraph
