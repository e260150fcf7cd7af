#include "tests/places.h"

namespace kinegraph {

std::string source_folder() {
  return KINEGRAPH_SOURCE_DIR;
}
std::string bin_folder() {
  return KINEGRAPH_BIN_DIR;
}

}  // namespace kinegraph
