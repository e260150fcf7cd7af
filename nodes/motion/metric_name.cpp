#include "nodes/motion/metric_name.h"

namespace kinegraph {

std::string joint_metric_name(std::string_view name, std::string_view joint) {
  std::string out(name);
  out += '.';
  for (char c : joint) {
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '.' || c == '-';
    out += plain ? c : '_';
  }
  return out;
}

}  // namespace kinegraph
