#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// 64 hexadecimal digits. Throws std::runtime_error when libcrypto refuses.
std::string sha256(std::string_view bytes);

}  // namespace kinegraph
