#include <cstddef>
#include <cstdint>

#include "tests/fuzz/read_once.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinegraph::read_bvh_once({reinterpret_cast<const char*>(data), size});
  return 0;
}
