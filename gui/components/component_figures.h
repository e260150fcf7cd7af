// Components made ready to look at: for each a short motion on the spot, its signal and a caption. Made on a
// thread beside the window's, once a value.
#pragma once
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <atomic>
#include <memory>
#include <vector>

#include "graph/value.h"
#include "gui/viewer/shown_motion.h"

namespace kinegraph {

struct ComponentFigure {
  std::shared_ptr<const ShownMotion> motion;  // null where it can't be drawn
  QString share;                              // "38.2 %"
  QString cadence;                            // "1.0 Hz"; empty: no steady one
  QString joints;                             // those that move most: "LeftArm, RightArm"
  QString short_joints;                       // the same for a small place: "L+R Arm"
  std::vector<float> signal;                  // over all segments, at most some 600 values
  bool unique = true;
};
struct ComponentPicture {
  ValuePtr value;  // what it was made from, kept alive
  std::vector<ComponentFigure> figures;
  std::vector<double> seams;  // where one segment ends and the next starts, as a share of the whole
  int segments = 0;
  double frames = 0, fps = 120;
};
std::shared_ptr<const ComponentPicture> make_component_picture(const ValuePtr& value, Work& work);

class ComponentFigures : public QObject {
  Q_OBJECT

 public:
  explicit ComponentFigures(QObject* parent = nullptr);
  ~ComponentFigures() override;
  // Of the value asked for last; null while it is being made.
  std::shared_ptr<const ComponentPicture> find(const ValuePtr& value);

 signals:
  void made();

 private:
  ValuePtr asked_;
  std::shared_ptr<const ComponentPicture> picture_;
  std::shared_ptr<std::atomic<bool>> stop_;
  QThreadPool pool_;
};

}  // namespace kinegraph
