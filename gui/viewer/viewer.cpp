#include "gui/viewer/viewer.h"

#include <QAction>
#include <QComboBox>
#include <QImage>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/look/icons.h"
#include "gui/viewer/motion_scene.h"
#include "gui/viewer/stage.h"
#include "gui/viewing/looked_at.h"

namespace kinegraph {
namespace {

constexpr double caption_row = 24;     // pixels from one caption to the next
constexpr double caption_height = 34;  // of a cell, that its caption stands in
constexpr int patience_ms = 250;

bool same_targets(const std::vector<Target>& a, const std::vector<Target>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Target& x, const Target& y) { return x.node == y.node && x.port == y.port; });
}

// Where all of it is at some moments of the clip, counted from `ground` at the moment, in seconds.
template <class Ground>
void add_points(const ShownMotion& motion, int first, int last, Ground ground, std::vector<QVector3D>& all) {
  constexpr int looks = 24;
  for (int k = 0; k < (first == last ? 1 : looks); ++k) {
    const int frame = first + k * (last - first) / (looks - 1);
    const QVector3D from = ground(frame / motion.fps);
    for (int point = 0; point < motion.points; ++point) {
      const ShownMotion::Point3& p = motion.at(frame, point);
      if (!std::isnan(p.x)) all.push_back(QVector3D(p.x, p.y, p.z) - from);
    }
    for (const ShownMotion::Bone& bone : motion.bones)
      if (bone.beyond > 0) {
        const ShownMotion::Point3 &a = motion.at(frame, bone.from), &b = motion.at(frame, bone.to);
        const QVector3D tip(b.x, b.y, b.z), way = tip - QVector3D(a.x, a.y, a.z);
        all.push_back(tip + bone.beyond * way.normalized() - from);
      }
  }
}

// Of cells beside each other: as many a row as make the bodies in them largest.
int columns_for(int count, QSizeF stage) {
  constexpr double body = 0.62;  // as wide as high
  int best = 1;
  double largest = 0;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double high = std::min(stage.height() / rows, stage.width() / columns / body);
    if (high > largest * 1.001) {
      largest = high;
      best = columns;
    }
  }
  return best;
}

}  // namespace

Viewer::Viewer(Session& session, Evaluation& evaluation, Playback& playback, QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      playback_(playback),
      theme_(&dark_theme()) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Viewer"));
  build();
  patience_.setSingleShot(true);
  patience_.setInterval(patience_ms);
  connect(&patience_, &QTimer::timeout, this, &Viewer::update_scene);
  // Of another graph nothing stays on the stage, even where its nodes have the same names.
  connect(&session_, &Session::page_changed, this, [this] {
    shown_.clear();
    patience_.stop();
    pins_of_page_[page_] = pins_;
    page_ = session_.path();
    pins_ = pins_of_page_[page_];
    looked_at_.clear();
    framed_ = false;
  });
  connect(&session_, &Session::file_changed, this, [this] {
    if (session_.path() == page_) return;
    pins_of_page_.erase(page_);  // saved under another name
    page_ = session_.path();
  });
  connect(&skins_, &SkinBoxes::made, this, [this] {
    const OrbitCamera& now = stage_->camera();
    if (now.target == framed_camera_.target && now.distance == framed_camera_.distance) frame_all();
  });
  connect(&session_, &Session::selection_changed, this, &Viewer::find_wanted);
  connect(&session_, &Session::meaning_changed, this, &Viewer::find_wanted);
  connect(&evaluation_, &Evaluation::values_changed, this, &Viewer::take_values);
  connect(&evaluation_, &Evaluation::status_changed, this, &Viewer::update_words);
  connect(&motions_, &ShownMotions::made, this, &Viewer::take_values);
  connect(&playback_, &Playback::moved, this, &Viewer::update_scene);
  connect(&playback_, &Playback::state_changed, this, &Viewer::update_scene);
  set_theme(*theme_);
  find_wanted();
}

Viewer::~Viewer() = default;

std::shared_ptr<const Contacts> Viewer::Shown::contacts() const {
  return std::dynamic_pointer_cast<const Contacts>(marked);
}

void Viewer::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* bar = new QToolBar(tr("Viewer tools"), this);
  column->addWidget(bar);
  stage_ = new Stage(this);
  column->addWidget(stage_, 1);

  arrange_ = new QComboBox(this);
  arrange_->addItems({tr("Side by side"), tr("Overlaid"), tr("Wipe")});
  arrange_->setAccessibleName(tr("Arrangement of several motions"));
  arrange_->setToolTip(tr("How several motions are shown (W)"));
  connect(arrange_, &QComboBox::activated, this,
          [this](int index) { set_arrangement(static_cast<Arrangement>(index)); });
  bar->addWidget(arrange_);
  build_places(*bar);
  bar->addSeparator();
  follow_ = bar->addAction(tr("Follow"));
  follow_->setCheckable(true);
  follow_->setChecked(looks_.follow);
  follow_->setToolTip(tr("The camera goes along with the root (R)"));
  connect(follow_, &QAction::toggled, this, &Viewer::set_follow);
  frame_ = bar->addAction(tr("Frame"));
  frame_->setToolTip(tr("Shows all of it (F)"));
  connect(frame_, &QAction::triggered, this, &Viewer::frame_all);
  build_show_menu();
  bar->addWidget(show_);

  for (QAction* action : {follow_, frame_})
    if (QWidget* button = bar->widgetForAction(action)) {
      button->setAccessibleName(action->text());
      button->setFocusPolicy(Qt::TabFocus);
    }
  bar->setIconSize({16, 16});
  bar->setObjectName("viewer_bar");
  bar->setContextMenuPolicy(Qt::PreventContextMenu);

  words_ = new QLabel(stage_);
  words_->setAlignment(Qt::AlignCenter);
  words_->setWordWrap(true);
  words_->setTextFormat(Qt::RichText);
  words_->setMinimumWidth(280);
  words_->setAttribute(Qt::WA_TransparentForMouseEvents);
  auto* over = new QVBoxLayout(stage_);
  over->setContentsMargins(28, 12, 28, 12);
  over->addWidget(words_, 0, Qt::AlignCenter);

  connect(stage_, &Stage::wipe_moved, this, &Viewer::update_scene);
  connect(stage_, &Stage::clicked, this, [this] { setFocus(Qt::MouseFocusReason); });
}

void Viewer::build_places(QToolBar& bar) {
  for (int place = 1; place <= places; ++place) {
    QAction* action = bar.addAction(QString::number(place));
    action->setCheckable(true);
    action->setToolTip(tr("Pins the current node to place %1, or empties it (%1)").arg(place));
    connect(action, &QAction::triggered, this, [this, place] { toggle_pin(place); });
    place_actions_[static_cast<std::size_t>(place - 1)] = action;
    if (QWidget* button = bar.widgetForAction(action)) {
      button->setFixedWidth(16);
      button->setStyleSheet("padding: 4px 0;");
      button->setAccessibleName(tr("Place %1").arg(place));
    }
  }
}

void Viewer::build_show_menu() {
  show_ = new QToolButton(this);
  show_->setStyleSheet("QToolButton::menu-indicator { image: none; }");
  show_->setToolTip(tr("Trails, ghosts, contacts, stretch"));
  show_->setAccessibleName(tr("What is shown beside the body"));
  show_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(show_);
  show_->setMenu(menu);
  const auto toggle = [&](const QString& name, bool Looks::*which) {
    QAction* action = menu->addAction(name);
    action->setCheckable(true);
    action->setChecked(looks_.*which);
    connect(action, &QAction::toggled, this, [this, which](bool on) {
      looks_.*which = on;
      update_scene();
    });
    return action;
  };
  trails_ = toggle(tr("Trails of hands, feet, head and root\tT"), &Looks::trails);
  contacts_ = toggle(tr("Contacts on the floor\tC"), &Looks::contacts);
  stretch_ = toggle(tr("Stretched links by colour\tS"), &Looks::stretch);
  menu->addSeparator();
  for (int frames : {0, 5, 10, 20, 30, 60, 120}) {
    QAction* action =
        menu->addAction(frames == 0 ? tr("No ghosts\tG") : tr("A ghost every %1 frames").arg(frames));
    action->setCheckable(true);
    action->setData(frames);
    connect(action, &QAction::triggered, this, [this, frames] { set_ghosts(frames); });
    ghosts_.push_back(action);
  }
}

void Viewer::set_ghosts(int frames) {
  looks_.ghosts = frames;
  update_controls();
  update_scene();
}

void Viewer::set_theme(const Theme& theme) {
  theme_ = &theme;
  // On a ground of its own: the floor's lines would run through the letters.
  const QColor& ground = theme.panel;
  words_->setStyleSheet(QString("background: rgba(%1, %2, %3, 215); color: %4; border-radius: 6px; "
                                "padding: 10px 14px;")
                            .arg(ground.red())
                            .arg(ground.green())
                            .arg(ground.blue())
                            .arg(theme.text.name()));
  stage_->set_colors(colors_of(theme), theme);
  follow_->setIcon(icon(Sign::follow, theme));
  frame_->setIcon(icon(Sign::frame, theme));
  show_->setIcon(icon(Sign::eye, theme));
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

void Viewer::toggle_pin(int place) {
  const std::string& node = session_.current().empty() ? looked_at_ : session_.current();
  pin(place, pinned(place) == node ? std::string() : node);
  update_controls();
}

void Viewer::set_arrangement(Arrangement arrangement) {
  arrangement_ = arrangement;
  update_controls();
  update_scene();
}

void Viewer::set_looks(const Looks& looks) {
  const bool follow = looks.follow;
  looks_ = looks;
  looks_.follow = follow_->isChecked();
  update_controls();
  set_follow(follow);
}

void Viewer::set_follow(bool follow) {
  if (follow != looks_.follow) {
    // The picture stays as it is: only what the camera's point is counted from changes.
    for (const Shown& one : shown_)
      if (one.motion) {
        const QVector3D ground = ground_under(*one.motion, one.motion->frame_at(playback_.time()));
        stage_->camera().target += follow ? -ground : ground;
        break;
      }
    looks_.follow = follow;
    stage_->camera_changed();
  }
  update_controls();
  update_scene();
}

void Viewer::frame_all() {
  update_scene();  // into cells of the shape that they have now
  std::vector<QVector3D> points;
  float thickness = 0;
  const ShownMotion* leader = nullptr;
  for (const Shown& one : shown_) {
    if (!one.motion) continue;
    // On one stage the camera goes along with the first; the others are where they are now beside it.
    if (!leader || arrangement_ == Arrangement::side_by_side) leader = one.motion.get();
    const int now = one.motion->frame_at(playback_.time());
    const bool leads = leader == one.motion.get() || !looks_.follow;
    add_points(
        *one.motion, leads ? 0 : now, leads ? one.motion->frames - 1 : now,
        [&](double seconds) {
          return looks_.follow ? ground_under(*leader, leader->frame_at(seconds)) : QVector3D();
        },
        points);
    // Bones are thicker than the lines between their joints, and skins than bones.
    thickness = std::max(thickness, static_cast<float>(0.03 * one.motion->size));
    if (!one.character) continue;
    const SceneBox skin = skins_.around(one.character, one.motion, one.motion->frame_at(playback_.time()));
    for (int axis = 0; axis < 3; ++axis)
      thickness = std::max({thickness, std::abs(skin.low[axis]), std::abs(skin.high[axis])});
  }
  if (points.empty()) return;
  stage_->camera().frame_closely(points, thickness, stage_->shape(),
                                 std::min(0.25, caption_height / std::max(1.0, stage_->cell_height())));
  framed_camera_ = stage_->camera();
  framed_size_ = 0;
  for (const Shown& one : shown_)
    if (one.motion) framed_size_ = std::max(framed_size_, one.motion->size);
  stage_->camera_changed();
  update_scene();
}

QImage Viewer::picture() {
  update_scene();
  return stage_->picture_now(true);
}

int Viewer::pictures_drawn() const {
  return stage_->pictures();
}

bool Viewer::uses_opengl() const {
  return stage_->uses_opengl();
}

void Viewer::keyPressEvent(QKeyEvent* event) {
  constexpr double turn = 24;  // as a drag of so many pixels
  const auto orbit = [&](double x, double y) {
    stage_->camera().orbit({x, y});
    stage_->camera_changed();
  };
  const int key = event->key();
  if (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) return QWidget::keyPressEvent(event);
  if (key >= Qt::Key_1 && key <= Qt::Key_9) return toggle_pin(key - Qt::Key_0);
  switch (key) {
    case Qt::Key_0:
      pins_.fill({});
      return find_wanted();
    case Qt::Key_F:
      return frame_all();
    case Qt::Key_R:
      return follow_->toggle();
    case Qt::Key_T:
      return trails_->toggle();
    case Qt::Key_C:
      return contacts_->toggle();
    case Qt::Key_S:
      return stretch_->toggle();
    case Qt::Key_G:
      return set_ghosts(looks_.ghosts > 0 ? 0 : 30);
    case Qt::Key_W:
      return set_arrangement(static_cast<Arrangement>((static_cast<int>(arrangement_) + 1) % 3));
    case Qt::Key_Space:
      return playback_.toggle();
    case Qt::Key_Left:
      return orbit(turn, 0);
    case Qt::Key_Right:
      return orbit(-turn, 0);
    case Qt::Key_Up:
      return orbit(0, turn);
    case Qt::Key_Down:
      return orbit(0, -turn);
    case Qt::Key_Plus:
    case Qt::Key_Equal:
    case Qt::Key_Minus:
      stage_->camera().zoom(key == Qt::Key_Minus ? -1 : 1);
      return stage_->camera_changed();
    default:
      QWidget::keyPressEvent(event);
  }
}

void Viewer::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  stage_->update();
}

void Viewer::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  stage_->update();
}

void Viewer::find_wanted() {
  const Document& document = session_.document();
  const Registry& registry = session_.registry();
  if (!session_.current().empty()) looked_at_ = session_.current();
  if (!document.nodes.count(looked_at_)) looked_at_ = node_to_look_at(document, registry);
  std::vector<Shown> shown;
  const auto add = [&](int place, const std::string& node) {
    const auto target = nearest_output(document, registry, node, {"Motion", "Points"});
    if (!target) return;
    Shown one;
    one.place = place;
    one.target = *target;
    const std::vector<Target> skins = outputs_of(document, registry, target->node, "Character");
    if (!skins.empty()) one.skin = skins.front();
    const std::vector<Target> marks = outputs_of(document, registry, node, "Contacts");
    if (!marks.empty()) one.marks = marks.front();
    for (const Shown& old : shown_)
      if (old.target.node == one.target.node && old.target.port == one.target.port) {
        one.value = old.value;
        one.motion = old.motion;
        one.character = old.character;
      }
    shown.push_back(std::move(one));
  };
  for (int place = 1; place <= places; ++place)
    if (document.nodes.count(pinned(place))) add(place, pinned(place));
  if (shown.empty() && !looked_at_.empty()) add(0, looked_at_);
  std::vector<Target> wanted;
  for (const Shown& one : shown) {
    wanted.push_back(one.target);
    if (!one.skin.node.empty()) wanted.push_back(one.skin);
    if (!one.marks.node.empty()) wanted.push_back(one.marks);
  }
  // What goes while the next is on its way.
  const bool goes = std::any_of(shown_.begin(), shown_.end(), [](const Shown& one) { return one.motion; });
  shown_ = std::move(shown);
  update_controls();
  const bool comes = std::none_of(shown_.begin(), shown_.end(), [](const Shown& one) { return one.motion; });
  if (goes && comes && may_wait()) patience_.start();
  take_values();
  if (!same_targets(wanted, wanted_)) {
    wanted_ = std::move(wanted);
    emit wanted_changed();
  }
}

void Viewer::take_values() {
  bool any = false;
  for (Shown& one : shown_) {
    one.value = evaluation_.value(one.target.node, one.target.port);
    if (!one.skin.node.empty()) one.character = evaluation_.value(one.skin.node, one.skin.port);
    if (!one.marks.node.empty()) one.marked = evaluation_.value(one.marks.node, one.marks.port);
    // While a new value is made ready the old motion stays on the stage.
    if (auto motion = motions_.find(one.value)) one.motion = std::move(motion);
    any = any || one.motion;
  }
  emit shown_changed();
  // A face after a body would be a dot, and the other way round a knee.
  constexpr double far_larger = 2.5;
  double size = 0;
  for (const Shown& one : shown_)
    if (one.motion) size = std::max(size, one.motion->size);
  const bool of_another_size = size > far_larger * framed_size_ || size * far_larger < framed_size_;
  if (any && (!framed_ || of_another_size)) {
    framed_ = true;
    frame_all();
  }
  update_scene();
}

QString Viewer::caption_of(const Shown& one) const {
  const QString name = QString::fromStdString(one.target.node);
  return one.place > 0 ? QString("%1  %2").arg(one.place).arg(name) : name;
}

void Viewer::update_scene() {
  const bool any =
      std::any_of(shown_.begin(), shown_.end(), [](const Shown& one) { return one.motion != nullptr; });
  if (any || !may_wait()) patience_.stop();
  if (patience_.isActive()) return;
  std::vector<SceneCell> cells;
  std::vector<Stage::Caption> captions;
  SceneLooks looks;
  looks.trails = looks_.trails;
  looks.contacts = looks_.contacts;
  looks.stretch = looks_.stretch;
  looks.ghosts = looks_.ghosts;
  const double seconds = playback_.time();
  const auto followed = [&](const Shown& one) {
    return looks_.follow ? ground_under(*one.motion, one.motion->frame_at(seconds)) : QVector3D();
  };
  std::vector<const Shown*> ready;
  for (const Shown& one : shown_)
    if (one.motion) ready.push_back(&one);
  const bool one_stage = arrangement_ == Arrangement::overlaid && ready.size() > 1;
  const bool wipe = arrangement_ == Arrangement::wipe && ready.size() > 1;
  if (one_stage) {
    SceneCell cell;
    cell.scene.camera_shift = followed(*ready.front());
    for (std::size_t i = 0; i < ready.size(); ++i) {
      if (i > 0) looks.tint = color_of_shown(*theme_, i);
      looks.opacity = i > 0 ? 0.5f : 1.0f;
      looks.contacts_of = ready[i]->contacts();
      add_motion(cell.scene, *ready[i]->motion, seconds, looks, *theme_, ready[i]->character);
      captions.push_back({QRectF(0, 0, 1, 1), caption_of(*ready[i]), color_of_shown(*theme_, i), false});
      captions.back().cell.setTop(
          std::min(0.9, caption_row * static_cast<double>(i) / std::max(1, stage_->height())));
    }
    cells.push_back(std::move(cell));
  } else if (wipe) {
    const double at = stage_->wipe();
    for (std::size_t i = 0; i < 2; ++i) {
      SceneCell cell;
      cell.scene.camera_shift = followed(*ready.front());
      cell.clip = i == 0 ? QRectF(0, 0, at, 1) : QRectF(at, 0, 1 - at, 1);
      looks.contacts_of = ready[i]->contacts();
      add_motion(cell.scene, *ready[i]->motion, seconds, looks, *theme_, ready[i]->character);
      captions.push_back({cell.clip, caption_of(*ready[i]), color_of_shown(*theme_, i), i == 1});
      cells.push_back(std::move(cell));
    }
  } else {
    const int count = static_cast<int>(ready.size());
    const int columns = columns_for(count, QSizeF(stage_->size()));
    const int rows = count > 0 ? (count + columns - 1) / columns : 1;
    for (int i = 0; i < count; ++i) {
      const Shown& one = *ready[static_cast<std::size_t>(i)];
      SceneCell cell;
      // All of one size, so that they compare; a last row of fewer stands in the middle.
      const int row = i / columns, in_row = row == rows - 1 ? count - row * columns : columns;
      const double before = (columns - in_row) / 2.0 + i % columns;
      cell.where = cell.clip =
          QRectF(before / columns, static_cast<double>(row) / rows, 1.0 / columns, 1.0 / rows);
      cell.scene.camera_shift = followed(one);
      looks.contacts_of = one.contacts();
      add_motion(cell.scene, *one.motion, seconds, looks, *theme_, one.character);
      captions.push_back(
          {cell.clip, caption_of(one), color_of_shown(*theme_, static_cast<std::size_t>(i)), false});
      cells.push_back(std::move(cell));
    }
  }
  stage_->set_legend(looks_.stretch && std::any_of(ready.begin(), ready.end(), [](const Shown* one) {
                       return !one->motion->stretch.empty() && !one->character;
                     }));
  if (cells.empty()) cells.emplace_back();
  stage_->set_wipe(wipe);
  stage_->show_cells(std::move(cells), std::move(captions), playback_.is_playing());
  update_words();
}

void Viewer::update_controls() {
  arrange_->setCurrentIndex(static_cast<int>(arrangement_));
  for (int place = 1; place <= places; ++place) {
    QAction* action = place_actions_[static_cast<std::size_t>(place - 1)];
    const QSignalBlocker quiet(action);
    action->setChecked(!pinned(place).empty());
    if (QWidget* button = action->associatedObjects().isEmpty()
                              ? nullptr
                              : qobject_cast<QWidget*>(action->associatedObjects().first()))
      button->update();
  }
  const auto show = [](QAction* action, bool on) {
    const QSignalBlocker quiet(action);
    action->setChecked(on);
  };
  show(trails_, looks_.trails);
  show(contacts_, looks_.contacts);
  show(stretch_, looks_.stretch);
  show(follow_, looks_.follow);
  for (QAction* action : ghosts_) action->setChecked(action->data().toInt() == looks_.ghosts);
}

}  // namespace kinegraph
