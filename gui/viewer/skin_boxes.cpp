#include "gui/viewer/skin_boxes.h"

#include <QMetaObject>
#include <algorithm>

#include "gui/viewer/shown_mesh.h"

namespace kinegraph {
namespace {

constexpr std::size_t most_known = 16;

// A skin is thicker than the joints it hangs on, most of all around the head.
SceneBox guess(const ShownMotion& motion) {
  const float skin = 0.14f * static_cast<float>(motion.size);
  return {QVector3D(-0.3f * skin, 0, -0.3f * skin), QVector3D(0.3f * skin, skin, 0.3f * skin)};
}

SceneBox measured(const Character& character, const ShownMotion& motion, int frame) {
  const auto* poses = dynamic_cast<const Motion*>(motion.value.get());
  const auto mesh = posed_mesh(character, poses, static_cast<std::size_t>(frame));
  if (!mesh) return {};
  const SceneBox joints = box_at(motion, frame);
  SceneBox around;
  for (std::size_t i = 0; i + 2 < mesh->positions.size(); i += 3)
    for (int axis = 0; axis < 3; ++axis) {
      const float at = mesh->positions[i + static_cast<std::size_t>(axis)];
      around.low[axis] = std::min(around.low[axis], at - joints.low[axis]);
      around.high[axis] = std::max(around.high[axis], at - joints.high[axis]);
    }
  return around;
}

}  // namespace

SkinBoxes::SkinBoxes(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);
  pool_.setThreadPriority(QThread::LowPriority);
}

SkinBoxes::~SkinBoxes() {
  pool_.clear();
  pool_.waitForDone();
}

SceneBox SkinBoxes::around(const ValuePtr& character, const std::shared_ptr<const ShownMotion>& motion,
                           int frame) {
  for (const Known& one : known_)
    if (one.character == character && one.motion == motion) return one.around;
  if (known_.size() == most_known) known_.erase(known_.begin());
  known_.push_back({character, motion, guess(*motion)});
  pool_.start([this, character, motion, frame] {
    const auto* skin = dynamic_cast<const Character*>(character.get());
    if (!skin) return;
    const SceneBox around = measured(*skin, *motion, frame);
    QMetaObject::invokeMethod(
        this,
        [this, character, motion, around] {
          for (Known& one : known_)
            if (one.character == character && one.motion == motion) one.around = around;
          emit made();
        },
        Qt::QueuedConnection);
  });
  return known_.back().around;
}

}  // namespace kinegraph
