// How far a character's skin reaches beyond the joints it hangs on, found beside the window's thread.
#pragma once
#include <QObject>
#include <QThreadPool>
#include <memory>
#include <vector>

#include "graph/value.h"
#include "gui/viewer/motion_scene.h"
#include "gui/viewer/shown_motion.h"

namespace kinegraph {

class SkinBoxes : public QObject {
  Q_OBJECT

 public:
  explicit SkinBoxes(QObject* parent = nullptr);
  ~SkinBoxes() override;
  // What the box around the joints lacks to hold the skin in the pose of a frame: low is not above zero, high
  // not below it. A guess until made() tells that it was measured.
  SceneBox around(const ValuePtr& character, const std::shared_ptr<const ShownMotion>& motion, int frame);

 signals:
  void made();

 private:
  struct Known {
    ValuePtr character;
    std::shared_ptr<const ShownMotion> motion;
    SceneBox around;
  };
  std::vector<Known> known_;
  QThreadPool pool_;
};

}  // namespace kinegraph
