// Draws scenes with QPainter, where there is no OpenGL: the same shapes and camera, nearer shapes over
// farther.
#pragma once
#include <QImage>
#include <QPainter>

#include "gui/viewer/scene.h"

namespace kinegraph {

QImage paint_raster(const ScenePicture& picture);
// One scene into a rectangle of a painter, over what is there: for small figures in panels.
void paint_scene(QPainter& painter, const QRectF& where, const Scene& scene, const OrbitCamera& camera,
                 const SceneColors& colors, bool smooth);

}  // namespace kinegraph
