#include "graph/evaluate/cpu_path.h"

namespace kinegraph {

std::string cpu_path() {
#if defined(__x86_64__)
  std::string name = "x86-64";
  if (__builtin_cpu_supports("avx512f")) return name + "-avx512";
  if (__builtin_cpu_supports("avx2")) name += "-avx2";
  if (__builtin_cpu_supports("fma")) name += "-fma";
  return name;
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "portable";
#endif
}

}  // namespace kinegraph
