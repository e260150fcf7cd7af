#include <cairo.h>

#include <cmath>
#include <memory>

#include "graph/diagnostic.h"
#include "headless/draws/canvas.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

// Cairo reads the pixels where they are: the surface must not outlive them.
Surface surface_of(const Pixels& pixels) {
  auto bytes = reinterpret_cast<unsigned char*>(const_cast<std::uint32_t*>(pixels.argb.data()));
  return {cairo_image_surface_create_for_data(bytes, CAIRO_FORMAT_ARGB32, pixels.width, pixels.height,
                                              4 * pixels.width),
          cairo_surface_destroy};
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Failure(error("cannot-draw",
                        std::string("the picture could not be made: ") + cairo_status_to_string(status)));
}

std::string png_bytes(cairo_surface_t* surface) {
  std::string bytes;
  auto append = [](void* out, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  check(cairo_surface_write_to_png_stream(surface, append, &bytes));
  return bytes;
}

}  // namespace

std::string png_of(const Pixels& pixels) {
  return png_bytes(surface_of(pixels).get());
}

struct CairoPainter {
  cairo_t* cairo;
  std::vector<double> opacities;  // of the open groups; -1 for a clip

  void trace(const Outline& outline) {
    cairo_new_path(cairo);
    for (const auto& step : outline.steps()) {
      const Spot* at = step.at;
      if (step.kind == 'M')
        cairo_move_to(cairo, at[0].x, at[0].y);
      else if (step.kind == 'L')
        cairo_line_to(cairo, at[0].x, at[0].y);
      else if (step.kind == 'C')
        cairo_curve_to(cairo, at[0].x, at[0].y, at[1].x, at[1].y, at[2].x, at[2].y);
      else
        cairo_close_path(cairo);
    }
  }
  void use(Color color) { cairo_set_source_rgba(cairo, color.r, color.g, color.b, color.a); }

  void operator()(const Canvas::Fill& fill) {
    trace(fill.outline);
    const auto& paint = fill.paint;
    if (paint.stops.size() == 1) {
      use(paint.stops[0].color);
    } else {
      cairo_pattern_t* pattern =
          paint.radius > 0 ? cairo_pattern_create_radial(paint.from.x, paint.from.y, 0, paint.from.x,
                                                         paint.from.y, paint.radius)
                           : cairo_pattern_create_linear(paint.from.x, paint.from.y, paint.to.x, paint.to.y);
      for (const auto& stop : paint.stops)
        cairo_pattern_add_color_stop_rgba(pattern, stop.at, stop.color.r, stop.color.g, stop.color.b,
                                          stop.color.a);
      cairo_set_source(cairo, pattern);
      cairo_pattern_destroy(pattern);
    }
    cairo_fill(cairo);
  }
  void operator()(const Canvas::Stroke& stroke) {
    trace(stroke.outline);
    use(stroke.pen.color);
    cairo_set_line_width(cairo, stroke.pen.width);
    cairo_set_dash(cairo, stroke.pen.dashes.data(), static_cast<int>(stroke.pen.dashes.size()), 0);
    cairo_stroke(cairo);
  }
  void operator()(const Canvas::Text& text) {
    const auto& style = text.lettering;
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, style.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text.text.c_str(), &extents);
    double shift = style.anchor == Anchor::middle ? -extents.x_advance / 2
                   : style.anchor == Anchor::end  ? -extents.x_advance
                                                  : 0;
    use(style.color);
    cairo_save(cairo);
    cairo_translate(cairo, text.at.x, text.at.y);
    cairo_rotate(cairo, style.turned / degrees_per_radian);
    cairo_move_to(cairo, shift, 0);
    cairo_show_text(cairo, text.text.c_str());
    cairo_restore(cairo);
  }
  void operator()(const Canvas::Image& image) {
    const Surface surface = surface_of(*image.pixels);
    cairo_save(cairo);
    cairo_translate(cairo, image.x, image.y);
    cairo_scale(cairo, image.width / image.pixels->width, image.height / image.pixels->height);
    cairo_set_source_surface(cairo, surface.get(), 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
  }
  void operator()(const Canvas::Clip& clip) {
    cairo_save(cairo);
    cairo_rectangle(cairo, clip.x, clip.y, clip.width, clip.height);
    cairo_clip(cairo);
    opacities.push_back(-1);
  }
  void operator()(const Canvas::Group& group) {
    cairo_push_group(cairo);
    opacities.push_back(group.opacity);
  }
  void operator()(const Canvas::End&) {
    double opacity = opacities.back();
    opacities.pop_back();
    if (opacity < 0) {
      cairo_restore(cairo);
    } else {
      cairo_pop_group_to_source(cairo);
      cairo_paint_with_alpha(cairo, opacity);
    }
  }
};

std::string Canvas::png(double pixels_per_point) const {
  Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width_ * pixels_per_point)),
                                 static_cast<int>(std::ceil(height_ * pixels_per_point))),
      cairo_surface_destroy);
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_scale(cairo.get(), pixels_per_point, pixels_per_point);
  cairo_set_source_rgb(cairo.get(), 1, 1, 1);
  cairo_paint(cairo.get());
  cairo_set_line_cap(cairo.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo.get(), CAIRO_LINE_JOIN_ROUND);
  // Hinting would move letters by whole pixels and spoil the layout that text_width() made.
  std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo.get(), options.get());
  CairoPainter painter{cairo.get(), {}};
  for (const auto& mark : marks_) std::visit(painter, mark);

  check(cairo_status(cairo.get()));
  return png_bytes(surface.get());
}

}  // namespace kinegraph
