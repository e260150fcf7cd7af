// Draws pictures of scenes on a thread of its own: with OpenGL where there is one, else with QPainter. The
// newest picture asked for is drawn; older ones that wait are left out.
#pragma once
#include <QImage>
#include <QThread>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "gui/viewer/scene.h"

class QOffscreenSurface;

namespace kinegraph {

class PictureMaker : public QThread {
  Q_OBJECT

 public:
  // OpenGL is not tried on platforms without windows of their own (offscreen, minimal, vnc), nor with
  // KINEGRAPH_OPENGL=0 in the environment, for drivers that misbehave.
  explicit PictureMaker(QObject* parent = nullptr);
  ~PictureMaker() override;

  void request(ScenePicture picture);
  // Waits for this one picture.
  QImage make_now(ScenePicture picture);
  // Pictures drawn so far, and whether one that was asked for is still to come.
  int drawn() const { return drawn_; }
  bool is_busy() const { return busy_; }
  bool uses_opengl() const { return opengl_; }

 signals:
  void made(const QImage& image);

 protected:
  void run() override;

 private:
  struct Urgent {
    ScenePicture picture;
    QImage image;
    bool done = false;
  };
  std::unique_ptr<QOffscreenSurface> surface_;
  std::mutex mutex_;
  std::condition_variable wake_, finished_;
  std::optional<ScenePicture> next_;
  Urgent* urgent_ = nullptr;
  bool quitting_ = false;
  std::atomic<bool> opengl_ = false, busy_ = false;
  std::atomic<int> drawn_ = 0;
};

}  // namespace kinegraph
