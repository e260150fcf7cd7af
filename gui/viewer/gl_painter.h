// Draws scenes with OpenGL (3.3 core or ES 3) into a picture in memory. Lives where its context is current: a
// thread without a window, so that software rasterising never holds up the window.
#pragma once
#include <QImage>
#include <memory>

#include "gui/viewer/scene.h"

namespace kinegraph {

class GlPainter {
 public:
  GlPainter();  // a context is current; throws std::runtime_error naming what the driver can't do
  ~GlPainter();
  QImage paint(const ScenePicture& picture);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kinegraph
