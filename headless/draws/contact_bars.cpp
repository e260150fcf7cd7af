#include "headless/draws/contact_bars.h"

#include <fmt/format.h>

#include <algorithm>

#include "headless/draws/curves.h"
#include "headless/draws/theme.h"

namespace kinegraph {

double draw_contact_bars(Canvas& canvas, const Contacts& contacts, double x0, double x1, double y) {
  const double row = 17, bar = 11;
  double last = static_cast<double>(std::max<std::size_t>(contacts.frames, 2) - 1);
  auto place = [&](double frame) { return x0 + (x1 - x0) * std::clamp(frame, 0.0, last) / last; };
  for (const auto& point : contacts.points) {
    Color color = point.left ? theme::left : theme::right;
    canvas.text({x0 - 10, y + bar - 1.5}, (point.left ? "left " : "right ") + point.part,
                {.size = 10.5, .color = theme::muted, .anchor = Anchor::end});
    canvas.fill(rectangle(x0, y, x1 - x0, bar, 2), theme::panel);
    for (const auto& run : runs_of(point.planted)) {
      double from = place(static_cast<double>(run.start) - 0.5),
             to = place(static_cast<double>(run.end) - 0.5);
      canvas.fill(rectangle(from, y, std::max(1.2, to - from), bar, 2.5),
                  point.part == "heel" ? color : mixed(color, theme::paper, 0.35));
    }
    y += row;
  }
  if (contacts.points.empty())
    canvas.text({x0, y + 11}, "no feet were found", {.size = 11, .color = theme::muted}), y += row;
  draw_time_axis(canvas, x0, x1, y + 3, last / contacts.fps);
  return y + 40;
}

std::string facts_of(const Contacts& contacts) {
  std::size_t plants = 0, planted = 0, all = 0;
  for (const auto& point : contacts.points) {
    plants += runs_of(point.planted).size();
    planted += static_cast<std::size_t>(std::count(point.planted.begin(), point.planted.end(), true));
    all += point.planted.size();
  }
  return fmt::format("{} frames · {:g} fps · {} plants · planted {:.0f} % of the time · floor at {:.3f} m",
                     contacts.frames, contacts.fps, plants,
                     all ? 100.0 * static_cast<double>(planted) / static_cast<double>(all) : 0.0,
                     contacts.floor);
}

Canvas draw_contacts(const Contacts& contacts, const std::string& title) {
  Canvas canvas(1000, 100);
  double y = theme::draw_title(canvas, title, facts_of(contacts));
  canvas.set_height(
      draw_contact_bars(canvas, contacts, theme::margin + 80, canvas.width() - theme::margin, y + 10) + 10);
  return canvas;
}

}  // namespace kinegraph
