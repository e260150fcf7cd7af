// What the viewer draws, as plain shapes in world metres, Y up: two painters draw it, one with OpenGL and one
// with QPainter. A scene is made anew for every picture, which costs little: motions are ready.
#pragma once
#include <QColor>
#include <QRectF>
#include <QString>
#include <QVector3D>
#include <memory>
#include <vector>

#include "gui/viewer/orbit_camera.h"
#include "gui/viewer/shown_mesh.h"

namespace kinegraph {

// A tapered bone with round ends; where both ends are one it is a ball.
struct SceneCapsule {
  QVector3D a, b;
  float radius_a = 0.02f, radius_b = 0.02f;
  QRgb color = 0xffffffff;
};

struct SceneFigure {
  std::vector<SceneCapsule> capsules;
  // A skin over the motion's pose at a frame; posed where the picture is drawn, as it takes a while.
  ValuePtr character, motion;
  std::size_t frame = 0;
  std::shared_ptr<const PosedMesh> mesh;  // null: none, or not posed yet
  QRgb mesh_color = 0xffffffff;
  float opacity = 1;  // of the whole figure: what is behind its own surface never shines through
  bool shadow = true;
};

// A line through the world of a width in metres, fading to its start.
struct ScenePath {
  std::vector<QVector3D> points;
  QRgb color = 0xffffffff;
  float width = 0.01f;
  float strength = 1;  // of its end
};

constexpr float mark_inside = 0.8f;    // of a mark's radius: outside of it is a ring
constexpr float mark_strength = 0.4f;  // of the disc that the ring encloses
// A mark on the floor.
struct SceneMark {
  QVector3D at;
  float radius = 0.05f;
  QRgb color = 0xffffffff;
};

struct Scene {
  std::vector<SceneFigure> figures;  // the opaque ones first
  std::vector<ScenePath> paths;
  std::vector<SceneMark> marks;
  float floor = 0;  // height, m
  bool has_floor = true;
  float grid = 1;          // m between lines
  QVector3D camera_shift;  // added to the camera's target: where what is followed stands
};

struct SceneColors {
  QRgb sky = 0xff20242b, ground = 0xff2a2e35, ground_line = 0xff3a404a, shadow = 0x6e000000;
};

// A picture: one or several scenes, each in a part of it. `where`: the part that the camera's picture fills,
// `clip`: the part of it that is drawn. In fractions of the whole, y down.
struct SceneCell {
  Scene scene;
  QRectF where{0, 0, 1, 1}, clip{0, 0, 1, 1};
};
struct ScenePicture {
  std::vector<SceneCell> cells;
  OrbitCamera camera;
  SceneColors colors;
  QSize size;           // pixels
  bool smooth = false;  // antialiased, for a picture that rests
};

void pose_meshes(ScenePicture& picture);
OrbitCamera camera_of(const ScenePicture& picture, const SceneCell& cell);
// The floor is a disc around what is looked at: its radius in metres, and how strong it is at a share of
// that.
float floor_reach(const OrbitCamera& camera, const Scene& scene);
constexpr float floor_fades_from = 0.25f, floor_fades_to = 0.95f;
float floor_strength(float share);
constexpr float quarter_lines = 0.35f;  // how strong the lines between the metres are

}  // namespace kinegraph
