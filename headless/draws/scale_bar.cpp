#include "headless/draws/scale_bar.h"

#include <fmt/format.h>

#include "headless/draws/theme.h"

namespace kinegraph {

void draw_scale_bar(Canvas& canvas, double right, double y, double scale) {
  // The longest of 1, 2, 5 times a power of ten that stays short.
  double metres = 1e-4;
  for (double power = 1e-4; power < 1e5; power *= 10)
    for (double factor : {1.0, 2.0, 5.0})
      if (power * factor * scale <= 130) metres = power * factor;
  const std::string words = metres < 0.0095  ? fmt::format("{:g} mm", 1000 * metres)
                            : metres < 0.095 ? fmt::format("{:g} cm", 100 * metres)
                                             : fmt::format("{:g} m", metres);
  const double x = right - metres * scale;
  canvas.stroke(polyline({{x, y - 4}, {x, y}, {right, y}, {right, y - 4}}), {theme::muted, 1.1});
  canvas.text({(x + right) / 2, y - 6}, words, {.size = 10, .color = theme::muted, .anchor = Anchor::middle});
}

}  // namespace kinegraph
