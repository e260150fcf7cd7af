// Highway's library times its clock as it is loaded, for benchmarks that nobody here runs: a quarter of the
// program's start. The dynamic linker takes this answer instead of the library's own.
#include <hwy/nanobenchmark.h>

namespace hwy::platform {

HWY_DLLEXPORT uint64_t TimerResolution() {
  return 1;
}

}  // namespace hwy::platform
