// Balls and tapered rods drawn by pixels, each pixel showing what is nearest there, lit as the OpenGL painter
// lights it: how solid bodies come about where there is no OpenGL.
#pragma once
#include <QImage>
#include <QRect>
#include <vector>

#include "gui/viewer/scene.h"

namespace kinegraph {

// A surface that faces this way, seen from `toward`.
QRgb lit_color(QRgb base, QVector3D normal, QVector3D toward);
// Towards the light.
QVector3D light_way();

// A capsule as the camera sees it: pixels, y down, and how far its ends are, m.
struct SeenCapsule {
  QPointF a, b;
  double radius_a = 1, radius_b = 1;  // pixels
  double depth_a = 1, depth_b = 1;    // m
  double scale = 1;                   // pixels a metre, at its middle
  QRgb color = 0xffffffff;
  QVector3D toward;  // from its middle to the eye
};

// What they look like together, inside `area` of the picture; transparent where there is none of them.
// `up`: of the camera.
QImage solid_sheet(const QRect& area, const std::vector<SeenCapsule>& capsules, QVector3D up);

}  // namespace kinegraph
