#include "gui/viewer/picture_maker.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <exception>

#include "gui/viewer/gl_painter.h"
#include "gui/viewer/raster_painter.h"

namespace kinegraph {
namespace {

QSurfaceFormat wanted_format() {
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  return format;
}

bool may_use_opengl() {
  if (qEnvironmentVariable("KINEGRAPH_OPENGL") == "0") return false;
  const QString platform = QGuiApplication::platformName();
  for (const char* without : {"offscreen", "minimal", "vnc", "linuxfb"})
    if (platform == without) return false;
  return true;
}

}  // namespace

PictureMaker::PictureMaker(QObject* parent) : QThread(parent) {
  if (may_use_opengl()) {
    // A surface belongs to the window's thread, its context to the one that draws.
    surface_ = std::make_unique<QOffscreenSurface>();
    surface_->setFormat(wanted_format());
    surface_->create();
    opengl_ = surface_->isValid();
  }
  start();
}

PictureMaker::~PictureMaker() {
  {
    std::lock_guard lock(mutex_);
    quitting_ = true;
  }
  wake_.notify_all();
  wait();
}

void PictureMaker::request(ScenePicture picture) {
  if (picture.size.isEmpty()) return;
  {
    std::lock_guard lock(mutex_);
    next_ = std::move(picture);
    busy_ = true;
  }
  wake_.notify_all();
}

QImage PictureMaker::make_now(ScenePicture picture) {
  Urgent urgent{std::move(picture), QImage(), false};
  std::unique_lock lock(mutex_);
  urgent_ = &urgent;
  wake_.notify_all();
  finished_.wait(lock, [&] { return urgent.done; });
  return urgent.image;
}

void PictureMaker::run() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), 3);
  std::unique_ptr<QOpenGLContext> context;
  std::unique_ptr<GlPainter> painter;
  if (opengl_) {
    context = std::make_unique<QOpenGLContext>();
    context->setFormat(wanted_format());
    try {
      if (context->create() && context->makeCurrent(surface_.get())) painter = std::make_unique<GlPainter>();
    } catch (const std::exception&) {
      painter.reset();  // QPainter draws the same
    }
    opengl_ = painter != nullptr;
  }
  const auto draw = [&](ScenePicture& picture) {
    pose_meshes(picture);
    if (painter) try {
        return painter->paint(picture);
      } catch (const std::exception&) {
        painter.reset();
        opengl_ = false;
      }
    return paint_raster(picture);
  };
  for (;;) {
    std::optional<ScenePicture> picture;
    Urgent* urgent = nullptr;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return quitting_ || next_ || urgent_; });
      if (quitting_) break;
      urgent = std::exchange(urgent_, nullptr);
      if (!urgent) picture = std::exchange(next_, std::nullopt);
    }
    if (urgent) {
      QImage image = draw(urgent->picture);
      std::lock_guard lock(mutex_);
      urgent->image = std::move(image);
      urgent->done = true;
      finished_.notify_all();
    } else {
      emit made(draw(*picture));
      ++drawn_;
      std::lock_guard lock(mutex_);
      busy_ = next_.has_value();
    }
  }
  painter.reset();
  if (context) context->doneCurrent();
}

}  // namespace kinegraph
