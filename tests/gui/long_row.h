// A graph file that takes long to read.
#pragma once
#include <string>

namespace kinegraph {

// A Gait and 999 Trims behind one another; the last one's motion is published.
inline std::string long_row() {
  std::string text =
      R"({"format": "kinegraph", "schema": 1, "publish": {"outputs": {"motion": "t998.motion"}},
      "nodes": {"walk": {"type": "Gait"})";
  for (int i = 0; i < 999; ++i)
    text += ",\n\"t" + std::to_string(i) + R"(": {"type": "Trim", "inputs": {"motion": ")" +
            (i ? "t" + std::to_string(i - 1) : "walk") + ".motion\"}}";
  return text + "}}";
}

}  // namespace kinegraph
