#include "gui/viewer/viewer.h"

#include <QImage>
#include <QKeyEvent>
#include <QLabel>
#include <QVBoxLayout>

#include "gui/viewer/looked_at.h"

namespace kinegraph {

Viewer::Viewer(Session& session, Evaluation& evaluation, Playback& playback, QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      playback_(playback),
      theme_(&dark_theme()) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Viewer"));
  build();
  connect(&session_, &Session::selection_changed, this, &Viewer::find_wanted);
  connect(&session_, &Session::meaning_changed, this, &Viewer::find_wanted);
  connect(&evaluation_, &Evaluation::values_changed, this, &Viewer::take_values);
  connect(&motions_, &ShownMotions::made, this, &Viewer::take_values);
  connect(&playback_, &Playback::moved, this, &Viewer::update_scene);
  find_wanted();
}

Viewer::~Viewer() = default;

void Viewer::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  words_ = new QLabel(this);
  words_->setAlignment(Qt::AlignCenter);
  column->addWidget(words_);
}

void Viewer::set_theme(const Theme& theme) {
  theme_ = &theme;
  update_scene();
}

std::vector<Target> Viewer::wanted() const {
  return wanted_;
}

void Viewer::pin(int place, const std::string& node) {
  if (place < 1 || place > places) return;
  pins_[static_cast<std::size_t>(place - 1)] = node;
  find_wanted();
}

void Viewer::set_arrangement(Arrangement arrangement) {
  arrangement_ = arrangement;
  update_scene();
}

void Viewer::set_looks(const Looks& looks) {
  looks_ = looks;
  update_scene();
}

void Viewer::frame_all() {
  update_scene();
}

QImage Viewer::picture() {
  return grab().toImage();
}

bool Viewer::uses_opengl() const {
  return false;
}

void Viewer::keyPressEvent(QKeyEvent* event) {
  QWidget::keyPressEvent(event);
}

void Viewer::find_wanted() {
  const Document& document = session_.document();
  if (!session_.current().empty()) looked_at_ = session_.current();
  if (!document.nodes.count(looked_at_)) looked_at_ = node_to_look_at(document, session_.registry());
  std::vector<Shown> shown;
  for (int place = 1; place <= places; ++place) {
    const std::string& node = pinned(place);
    if (node.empty() || !document.nodes.count(node)) continue;
    if (auto target = nearest_output(document, session_.registry(), node, {"Motion", "Points"}))
      shown.push_back({place, *target, nullptr, nullptr});
  }
  if (shown.empty() && !looked_at_.empty())
    if (auto target = nearest_output(document, session_.registry(), looked_at_, {"Motion", "Points"}))
      shown.push_back({0, *target, nullptr, nullptr});
  std::vector<Target> wanted;
  for (const Shown& one : shown) wanted.push_back(one.target);
  shown_ = std::move(shown);
  const auto same = [](const Target& a, const Target& b) { return a.node == b.node && a.port == b.port; };
  if (!std::equal(wanted.begin(), wanted.end(), wanted_.begin(), wanted_.end(), same)) {
    wanted_ = std::move(wanted);
    emit wanted_changed();
  }
  take_values();
}

void Viewer::take_values() {
  for (Shown& one : shown_) {
    one.value = evaluation_.value(one.target.node, one.target.port);
    // While a new value is made ready the old motion stays on the stage.
    if (auto motion = motions_.find(one.value)) one.motion = std::move(motion);
  }
  emit shown_changed();
  update_scene();
}

void Viewer::update_scene() {
  update_words();
}

void Viewer::update_words() {
  words_->setText(shown_.empty() ? tr("Add a Load or a Gait to see a motion here") : QString());
}

}  // namespace kinegraph
