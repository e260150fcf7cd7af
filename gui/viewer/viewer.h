// The Viewer dock: motions in 3D. It shows the current node, or what is pinned to its places 1 to 9, side by
// side, overlaid or with a wipe between two. A node that makes no motion shows what leads to it.
#pragma once
#include <QTimer>
#include <QWidget>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "graph/evaluate/run_log.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"
#include "gui/viewer/orbit_camera.h"
#include "gui/viewer/shown_motions.h"
#include "gui/viewer/skin_boxes.h"
#include "gui/viewing/playback.h"

class QAction;
class QComboBox;
class QLabel;
class QToolBar;
class QToolButton;

namespace kinegraph {

class Stage;

class Viewer : public QWidget {
  Q_OBJECT

 public:
  static constexpr int places = 9;
  enum class Arrangement { side_by_side, overlaid, wipe };
  struct Looks {
    bool trails = false, contacts = true, stretch = true, follow = true;
    int ghosts = 0;  // a ghost every so many frames, 0 = none
  };
  // What is on the stage: `motion` is null while it is evaluated or made ready.
  struct Shown {
    int place = 0;  // 1 to 9; 0 = the current node
    Target target;
    ValuePtr value;
    std::shared_ptr<const ShownMotion> motion;
    Target skin;  // the node's character, node "" where it makes none
    ValuePtr character;
    Target marks;  // the contacts that the looked at node makes of the motion, node "" where it makes none
    ValuePtr marked;
    std::shared_ptr<const Contacts> contacts() const;  // null: those that are found in the motion
  };

  Viewer(Session& session, Evaluation& evaluation, Playback& playback, QWidget* parent = nullptr);
  ~Viewer() override;

  void set_theme(const Theme& theme);
  // The outputs that must be evaluated for what is shown.
  std::vector<Target> wanted() const;

  // Pins a node to a place, 1 to 9; "" empties it. With no pins the current node is shown.
  void pin(int place, const std::string& node);
  const std::string& pinned(int place) const { return pins_[static_cast<std::size_t>(place - 1)]; }
  const std::vector<Shown>& shown() const { return shown_; }
  // The motions made ready, for whoever else draws them.
  ShownMotions& motions() { return motions_; }

  void set_arrangement(Arrangement arrangement);
  Arrangement arrangement() const { return arrangement_; }
  void set_looks(const Looks& looks);
  const Looks& looks() const { return looks_; }
  void frame_all();
  // The picture of the stage as it is now, drawn at once. For tests and screenshots.
  QImage picture();
  int pictures_drawn() const;  // since the start: for measuring
  bool uses_opengl() const;

 signals:
  void wanted_changed();
  void shown_changed();  // shown() is new

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void build();
  void find_wanted();
  void take_values();
  void update_scene();
  void update_words();
  bool may_wait() const;  // the chosen node's value can come any moment
  void update_controls();
  void set_ghosts(int frames);
  void build_places(QToolBar& bar);
  void build_show_menu();
  void toggle_pin(int place);
  void set_follow(bool follow);
  QString caption_of(const Shown& one) const;

  Session& session_;
  Evaluation& evaluation_;
  Playback& playback_;
  ShownMotions motions_;
  const Theme* theme_;
  Arrangement arrangement_ = Arrangement::side_by_side;
  Looks looks_;
  using Pins = std::array<std::string, places>;
  Pins pins_;
  QString page_;  // the path of the shown page: each has its pins
  std::map<QString, Pins> pins_of_page_;
  SkinBoxes skins_;
  OrbitCamera framed_camera_;  // as frame_all left it
  double framed_size_ = 0;     // m, of the largest body then
  std::string looked_at_;      // the node shown without pins
  std::vector<Target> wanted_;
  std::vector<Shown> shown_;
  bool framed_ = false;  // the camera has found what is shown once
  QTimer patience_;      // what was on the stage stays while the next is on its way, so that nothing flickers

  Stage* stage_ = nullptr;
  QLabel* words_ = nullptr;
  QComboBox* arrange_ = nullptr;
  QToolButton* show_ = nullptr;
  std::vector<QAction*> ghosts_;  // each holds its number of frames
  std::array<QAction*, places> place_actions_{};
  QAction *trails_ = nullptr, *contacts_ = nullptr, *stretch_ = nullptr, *follow_ = nullptr,
          *frame_ = nullptr;
};

}  // namespace kinegraph
