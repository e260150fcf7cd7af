#include "headless/exit_code.h"

#include <algorithm>
#include <array>

namespace kinegraph::exit_code {

int graver(int a, int b) {
  constexpr std::array<int, 10> order = {usage,        interrupted, terminated, timed_out,     internal,
                                         cannot_write, invalid,     failed,     checks_failed, done};
  auto rank = [&](int code) { return std::find(order.begin(), order.end(), code) - order.begin(); };
  return rank(a) <= rank(b) ? a : b;
}

}  // namespace kinegraph::exit_code
