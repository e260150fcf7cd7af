// One drawing surface for every picture. It records what is drawn and writes it out as SVG (real text, fixed
// number format) or PNG (through cairo). The same calls give the same bytes: no dates, no fonts measured at
// run time. Units are points of the picture, y down, origin at the top left.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kinegraph {

struct Color {
  double r = 0, g = 0, b = 0, a = 1;
  bool operator==(const Color&) const = default;
};
Color rgb(std::uint32_t hex, double alpha = 1);   // rgb(0x3366cc)
Color mixed(Color from, Color to, double share);  // share 0 = from, 1 = to
inline Color faded(Color color, double alpha) {
  return {color.r, color.g, color.b, color.a * alpha};
}

struct Spot {
  double x = 0, y = 0;
  bool operator==(const Spot&) const = default;
};
inline Spot operator+(Spot a, Spot b) {
  return {a.x + b.x, a.y + b.y};
}
inline Spot operator-(Spot a, Spot b) {
  return {a.x - b.x, a.y - b.y};
}
inline Spot operator*(double s, Spot a) {
  return {s * a.x, s * a.y};
}

class Outline {
 public:
  Outline& move(Spot to);
  Outline& line(Spot to);
  Outline& curve(Spot first_control, Spot second_control, Spot to);
  Outline& close();
  bool empty() const { return steps_.empty(); }

  struct Step {
    char kind;  // 'M', 'L', 'C', 'Z'
    Spot at[3];
  };
  const std::vector<Step>& steps() const { return steps_; }

 private:
  std::vector<Step> steps_;
};
Outline polyline(const std::vector<Spot>& spots, bool closed = false);
Outline rectangle(double x, double y, double width, double height, double corner = 0);
Outline ellipse(Spot centre, double rx, double ry,
                double turned = 0);  // turned: radians, clockwise on the page
// The hull of two discs: a bone seen from the side. Where one disc holds the other it is that disc.
Outline capsule(Spot a, double radius_a, Spot b, double radius_b);

struct Stop {
  double at;  // 0 to 1
  Color color;
};
// A colour, or a gradient along a line (radius 0) or from a centre outwards.
struct Paint {
  Paint(Color plain) : stops{{0, plain}} {}
  static Paint along(Spot from, Spot to, std::vector<Stop> stops);
  static Paint around(Spot centre, double radius, std::vector<Stop> stops);
  std::vector<Stop> stops;
  Spot from, to;
  double radius = 0;
};

struct Pen {
  Color color;
  double width = 1;
  std::vector<double> dashes = {};
};

enum class Anchor { start, middle, end };
struct Lettering {
  double size = 11;
  Color color;
  bool bold = false;
  Anchor anchor = Anchor::start;
  double turned = 0;  // degrees, clockwise
};
double text_width(std::string_view utf8, double size, bool bold = false);
// Cut to a width, with an ellipsis where something had to go.
std::string fitted(std::string_view utf8, double size, double width, bool bold = false);

// Pixels to lay into a picture, such as a shaded mesh: rows from the top, 0xAARRGGBB, premultiplied by alpha.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint32_t> argb;
};

class Canvas {
 public:
  Canvas(double width, double height);
  double width() const { return width_; }
  double height() const { return height_; }
  void set_height(double height) { height_ = height; }

  void fill(Outline outline, Paint paint);
  void stroke(Outline outline, Pen pen);
  void text(Spot baseline, std::string_view utf8, Lettering lettering);
  // Spread over a rectangle of the picture. A picture of no pixels draws nothing.
  void image(std::shared_ptr<const Pixels> pixels, double x, double y, double width, double height);
  // What is drawn until the matching end() is cut to a rectangle, or laid over the picture as one sheet of an
  // opacity.
  void begin_clip(double x, double y, double width, double height);
  void begin_group(double opacity);
  void end();

  std::string svg(std::string_view title) const;
  std::string png(double pixels_per_point = 2) const;

 private:
  struct Fill {
    Outline outline;
    Paint paint;
  };
  struct Stroke {
    Outline outline;
    Pen pen;
  };
  struct Text {
    Spot at;
    std::string text;
    Lettering lettering;
  };
  struct Image {
    std::shared_ptr<const Pixels> pixels;
    double x, y, width, height;
  };
  struct Clip {
    double x, y, width, height;
  };
  struct Group {
    double opacity;
  };
  struct End {};
  using Mark = std::variant<Fill, Stroke, Text, Image, Clip, Group, End>;
  friend struct CairoPainter;
  friend struct SvgWriter;

  double width_, height_;
  std::vector<Mark> marks_;
};

// The pixels as a PNG file. Throws Failure ("cannot-draw").
std::string png_of(const Pixels& pixels);

// Bytes in the format that the path's ending names, .svg or .png; throws Failure ("unknown-picture-format").
std::string encoded_picture(const Canvas& canvas, std::string_view path, std::string_view title);

}  // namespace kinegraph
