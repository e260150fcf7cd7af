// Colours, shapes and sizes of the editor, in a dark and a light theme. Everything that is drawn takes them
// from here.
#pragma once
#include <QColor>
#include <QPalette>
#include <QString>
#include <string_view>

namespace kinegraph {

struct Theme {
  bool dark = true;
  QColor window, panel, raised, line, text, faint_text, accent, selection;
  QColor canvas, grid, node, node_title, node_line, wire, still_ground;
  QColor good, running, warning, error, missing;
  QColor ground, ground_line, sky, bone, joint, skin, left, right, second, shadow, stretch_short,
      stretch_long;

  // Of a port type's wires and ports; the shape tells types apart without colour.
  QColor port(std::string_view type) const;
  enum class Shape { circle, square, diamond, triangle, hexagon, star, bar, ring };
  static Shape shape(std::string_view type);

  QPalette palette() const;
  QString style_sheet() const;
};

const Theme& dark_theme();
const Theme& light_theme();

}  // namespace kinegraph
