// The look that all pictures share: light paper, quiet lines, one colour a side of the body.
#pragma once
#include <string>

#include "headless/draws/canvas.h"

namespace kinegraph::theme {

inline const Color paper = rgb(0xffffff);
inline const Color ink = rgb(0x1f2933);
inline const Color muted = rgb(0x5f6c7b);
inline const Color faint = rgb(0x98a4b3);
inline const Color hairline = rgb(0xe1e6ec);
inline const Color panel = rgb(0xf6f8fa);
inline const Color floor = rgb(0xe9edf2);

// Sides of a body. Both stay apart for readers who see no red or no green.
inline const Color left = rgb(0x2b7bd3);
inline const Color right = rgb(0xe2652f);
inline const Color centre = rgb(0x76879a);

// Of links that are longer and shorter than at rest; full at twice and half the length.
inline const Color stretched = rgb(0xc2188f);
inline const Color squashed = rgb(0x0b8f7d);

inline const Color good = rgb(0x1d9a78);
inline const Color bad = rgb(0xc8374f);

inline constexpr double margin = 32;

// Colours of curves that have no side, repeating after seven.
Color series(int index);

// Title and a muted line below it; returns the y below which a picture may start.
double draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle);
// A dot and a word each; returns the x after the last.
double draw_key(Canvas& canvas, Spot at, const std::string& word, Color color);

}  // namespace kinegraph::theme
