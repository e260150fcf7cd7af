#include "gui/viewer/scene.h"

#include <algorithm>

namespace kinegraph {

void pose_meshes(ScenePicture& picture) {
  for (SceneCell& cell : picture.cells)
    for (SceneFigure& figure : cell.scene.figures)
      if (const auto* character = dynamic_cast<const Character*>(figure.character.get()))
        figure.mesh = posed_mesh(*character, dynamic_cast<const Motion*>(figure.motion.get()), figure.frame);
}

OrbitCamera camera_of(const ScenePicture& picture, const SceneCell& cell) {
  OrbitCamera camera = picture.camera;
  camera.target += cell.scene.camera_shift;
  return camera;
}

float floor_reach(const OrbitCamera& camera, const Scene& scene) {
  return camera.distance * 4 + 6 * scene.grid;
}

float floor_strength(float share) {
  const float t = std::clamp((share - floor_fades_from) / (floor_fades_to - floor_fades_from), 0.0f, 1.0f);
  return 1 - t * t * (3 - 2 * t);
}

}  // namespace kinegraph
