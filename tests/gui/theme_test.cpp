#include "gui/look/theme.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kinegraph {
namespace {

// WCAG 2.1: relative luminance, and the contrast of two colours.
double luminance(const QColor& color) {
  const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) + 0.0722 * linear(color.blueF());
}
double contrast(const QColor& a, const QColor& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

class EditorTheme : public testing::TestWithParam<const Theme*> {};

TEST_P(EditorTheme, WordsStandOutFromTheirGround) {
  const Theme& t = *GetParam();
  const std::pair<const char*, QColor> grounds[] = {{"window", t.window}, {"panel", t.panel},
                                                    {"raised", t.raised}, {"canvas", t.canvas},
                                                    {"node", t.node},     {"node_title", t.node_title}};
  const std::pair<const char*, QColor> words[] = {{"text", t.text},       {"faint_text", t.faint_text},
                                                  {"warning", t.warning}, {"error", t.error},
                                                  {"missing", t.missing}, {"good", t.good}};
  for (const auto& [ground, under] : grounds)
    for (const auto& [name, color] : words)
      EXPECT_GE(contrast(color, under), 4.5) << name << " on " << ground;
  EXPECT_GE(contrast(t.text, t.selection), 4.5);
  for (const QColor& under : {t.window, t.panel, t.raised, t.canvas, t.node})
    EXPECT_GE(contrast(t.accent, under), 4.5);
}

TEST_P(EditorTheme, WiresAndPortsStandOutFromTheCanvas) {
  const Theme& t = *GetParam();
  for (const char* type :
       {"Motion", "Points", "Warp", "Stats", "Components", "Contacts", "Character", "Metrics"})
    for (const QColor& under : {t.canvas, t.node}) EXPECT_GE(contrast(t.port(type), under), 3) << type;
}

INSTANTIATE_TEST_SUITE_P(Both, EditorTheme, testing::Values(&dark_theme(), &light_theme()),
                         [](const auto& one) { return one.param->dark ? "dark" : "light"; });

}  // namespace
}  // namespace kinegraph
