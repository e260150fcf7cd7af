// The bytes up to the first 0 are an .asf, the rest an .amc.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/read_once.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = bytes.find('\0');
  const std::string_view asf = bytes.substr(0, cut);
  kinegraph::read_amc_once(asf, cut == std::string_view::npos ? std::string_view() : bytes.substr(cut + 1));
  return 0;
}
