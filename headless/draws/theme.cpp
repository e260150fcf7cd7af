#include "headless/draws/theme.h"

#include <array>

namespace kinegraph::theme {

Color series(int index) {
  static constexpr std::array<std::uint32_t, 7> colors = {0x2b7bd3, 0xe2652f, 0x1d9a78, 0x7a5cc2,
                                                          0xc4912a, 0xc8374f, 0x66778a};
  return rgb(colors[static_cast<std::size_t>(index) % colors.size()]);
}

double draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle) {
  double room = canvas.width() - 2 * margin;
  canvas.text({margin, 40}, fitted(title, 18, room, true), {.size = 18, .color = ink, .bold = true});
  canvas.text({margin, 60}, fitted(subtitle, 11.5, room), {.size = 11.5, .color = muted});
  return 76;
}

double draw_key(Canvas& canvas, Spot at, const std::string& word, Color color) {
  canvas.fill(ellipse({at.x + 4, at.y - 3.8}, 4, 4), color);
  canvas.text({at.x + 12, at.y}, word, {.size = 11, .color = muted});
  return at.x + 12 + text_width(word, 11) + 16;
}

}  // namespace kinegraph::theme
