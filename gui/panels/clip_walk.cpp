#include "gui/panels/clip_walk.h"

#include <QDirIterator>

namespace kinegraph {
namespace {

constexpr int most_clips = 500;
constexpr int most_files = 200000;

bool is_clip(const QString& name) {
  static const QStringList endings{".bvh", ".amc", ".c3d", ".trc", ".glb", ".gltf", ".fbx"};
  for (const QString& ending : endings)
    if (name.endsWith(ending, Qt::CaseInsensitive)) return true;
  return false;
}

}  // namespace

ClipWalk::~ClipWalk() {
  give_up();
}

void ClipWalk::give_up() {
  stopped_ = true;
  wait();
  stopped_ = false;
}

void ClipWalk::look_through(const QStringList& folders) {
  give_up();
  folders_ = folders;
  if (!folders_.isEmpty()) start(QThread::LowPriority);
}

void ClipWalk::run() {
  for (const QString& folder : folders_) {
    QDirIterator files(folder, QDir::Files, QDirIterator::Subdirectories);
    QStringList clips;
    for (int seen = 0; seen < most_files && clips.size() < most_clips && files.hasNext(); ++seen) {
      if (stopped_) return;
      const QString path = files.next();
      if (is_clip(path)) clips << path;
    }
    clips.sort();
    emit found(folder, clips);
  }
}

}  // namespace kinegraph
