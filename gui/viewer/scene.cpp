#include "gui/viewer/scene.h"

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

}  // namespace kinegraph
