#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "headless/draws/canvas.h"
#include "headless/draws/xml_text.h"
#include "nodes/files/clip_json.h"

namespace kinegraph {

namespace {

// At most two decimals, no trailing zeros, no -0: short files whose bytes depend on nothing else.
std::string decimal(double value) {
  auto text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(Color color) {
  auto byte = [](double share) { return static_cast<int>(std::lround(share * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color.r), byte(color.g), byte(color.b));
}

std::string steps_text(const Outline& outline) {
  std::string out;
  for (const auto& step : outline.steps()) {
    out += step.kind;
    int count = step.kind == 'C' ? 3 : step.kind == 'Z' ? 0 : 1;
    for (int i = 0; i < count; ++i)
      out += (i ? " " : "") + decimal(step.at[i].x) + "," + decimal(step.at[i].y);
  }
  return out;
}

std::string opacity(const char* name, double alpha) {
  return alpha < 1 ? fmt::format(" {}=\"{}\"", name, decimal(alpha)) : std::string();
}

}  // namespace

struct SvgWriter {
  std::string body, definitions;
  int named = 0;

  std::string paint(const Paint& paint) {
    if (paint.stops.size() == 1)
      return fmt::format("fill=\"{}\"{}", hex(paint.stops[0].color),
                         opacity("fill-opacity", paint.stops[0].color.a));
    auto name = fmt::format("p{}", ++named);
    const char* element = paint.radius > 0 ? "radialGradient" : "linearGradient";
    if (paint.radius > 0)
      definitions += fmt::format(
          "<radialGradient id=\"{}\" gradientUnits=\"userSpaceOnUse\" cx=\"{}\" cy=\"{}\" r=\"{}\">", name,
          decimal(paint.from.x), decimal(paint.from.y), decimal(paint.radius));
    else
      definitions += fmt::format(
          "<linearGradient id=\"{}\" gradientUnits=\"userSpaceOnUse\" x1=\"{}\" y1=\"{}\" x2=\"{}\" "
          "y2=\"{}\">",
          name, decimal(paint.from.x), decimal(paint.from.y), decimal(paint.to.x), decimal(paint.to.y));
    for (const auto& stop : paint.stops)
      definitions += fmt::format("<stop offset=\"{}\" stop-color=\"{}\"{}/>", decimal(stop.at),
                                 hex(stop.color), opacity("stop-opacity", stop.color.a));
    definitions += fmt::format("</{}>\n", element);
    return fmt::format("fill=\"url(#{})\"", name);
  }

  void operator()(const Canvas::Fill& fill) {
    body += fmt::format("<path d=\"{}\" {}/>\n", steps_text(fill.outline), paint(fill.paint));
  }
  void operator()(const Canvas::Stroke& stroke) {
    std::string dashes;
    for (double dash : stroke.pen.dashes) dashes += (dashes.empty() ? "" : " ") + decimal(dash);
    if (!dashes.empty()) dashes = " stroke-dasharray=\"" + dashes + "\"";
    body += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}{}/>\n",
                        steps_text(stroke.outline), hex(stroke.pen.color), decimal(stroke.pen.width), dashes,
                        opacity("stroke-opacity", stroke.pen.color.a));
  }
  void operator()(const Canvas::Text& text) {
    const auto& style = text.lettering;
    const char* anchor = style.anchor == Anchor::middle ? " text-anchor=\"middle\""
                         : style.anchor == Anchor::end  ? " text-anchor=\"end\""
                                                        : "";
    std::string turned;
    if (style.turned != 0)
      turned = fmt::format(" transform=\"rotate({} {} {})\"", decimal(style.turned), decimal(text.at.x),
                           decimal(text.at.y));
    body += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}{} fill=\"{}\"{}>{}</text>\n",
                        decimal(text.at.x), decimal(text.at.y), decimal(style.size),
                        style.bold ? " font-weight=\"bold\"" : "", anchor, turned, hex(style.color),
                        opacity("fill-opacity", style.color.a), xml_text(text.text));
  }
  void operator()(const Canvas::Image& image) {
    body += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        decimal(image.x), decimal(image.y), decimal(image.width), decimal(image.height),
        base64(png_of(*image.pixels)));
  }
  void operator()(const Canvas::Clip& clip) {
    auto name = fmt::format("c{}", ++named);
    definitions +=
        fmt::format("<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
                    name, decimal(clip.x), decimal(clip.y), decimal(clip.width), decimal(clip.height));
    body += fmt::format("<g clip-path=\"url(#{})\">\n", name);
  }
  void operator()(const Canvas::Group& group) {
    body += fmt::format("<g opacity=\"{}\">\n", decimal(group.opacity));
  }
  void operator()(const Canvas::End&) { body += "</g>\n"; }
};

std::string Canvas::svg(std::string_view title) const {
  SvgWriter writer;
  for (const auto& mark : marks_) std::visit(writer, mark);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" "
      "font-family=\"'DejaVu Sans', Verdana, 'Bitstream Vera Sans', sans-serif\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\">\n<title>{2}</title>\n<defs>\n{3}</defs>\n{4}</svg>\n",
      decimal(width_), decimal(height_), xml_text(title), writer.definitions, writer.body);
}

}  // namespace kinegraph
