// What Export lets a person say about the file it writes.
#pragma once
#include <string>

#include "graph/json.h"

namespace kinegraph {

struct WriteOptions {
  std::string euler = "source";  // source, or an order: "ZYX" is R = Rz Ry Rx
  int precision = 6;             // decimals of text
  bool repair = false;           // glTF: normalise weights, put the skinned mesh at the root
  std::string stretch = "keep";  // keep, error, drop: varying bone lengths
  Json unit = "source";          // "source", a key of known_units, or metres
};

}  // namespace kinegraph
