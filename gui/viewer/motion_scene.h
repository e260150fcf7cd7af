// From motions at a moment to the shapes of a scene.
#pragma once
#include <memory>
#include <vector>

#include "gui/look/theme.h"
#include "gui/viewer/scene.h"
#include "gui/viewer/shown_motion.h"

namespace kinegraph {

struct SceneLooks {
  bool trails = false, contacts = true, stretch = true;
  int ghosts = 0;                               // frames between ghosts, 0 = none
  float opacity = 1;                            // of the figure
  QColor tint;                                  // to be told from another figure; invalid: in its own colours
  QVector3D shift;                              // where the motion's origin is put
  std::shared_ptr<const Contacts> contacts_of;  // marked instead of those found in the motion
};

// Adds a motion at a time to a scene. `character`: a skin to draw instead of bones, or null.
void add_motion(Scene& scene, const ShownMotion& motion, double seconds, const SceneLooks& looks,
                const Theme& theme, ValuePtr character = nullptr);
SceneColors colors_of(const Theme& theme);
// Of one of several motions that are shown, the first being 0: of its name, and of its body over another's.
QColor color_of_shown(const Theme& theme, std::size_t index);
// The box that a body of this size fills where its root is: what "follow" frames.
struct SceneBox {
  QVector3D low, high;
};
SceneBox box_of(const ShownMotion& motion);                    // over all frames
SceneBox box_at(const ShownMotion& motion, int frame);         // of one frame
QVector3D ground_under(const ShownMotion& motion, int frame);  // its root put on the floor

}  // namespace kinegraph
