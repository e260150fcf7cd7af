// Reading and writing motion files, MB of text a second, one thread.
#include <benchmark/benchmark.h>

#include <string>

#include "nodes/files/acclaim_motion.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/bvh_write.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/rotation.h"
#include "tests/mocap.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

FileBytes bytes_of(benchmark::State& state, const char* clip) {
  const std::string path = mocap(clip);
  if (!std::filesystem::exists(path)) {
    state.SkipWithError("no motion capture; set KINEGRAPH_MOCAP");
    return nullptr;
  }
  return PlainFiles().read(path);
}

void count(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

void read_bvh_clip(benchmark::State& state, const char* clip) {
  const FileBytes bytes = bytes_of(state, clip);
  if (!bytes) return;
  Alone work;
  for (auto _ : state) benchmark::DoNotOptimize(read_bvh(*bytes, {}, work));
  count(state, bytes->size());
}
BENCHMARK_CAPTURE(read_bvh_clip, cmu_02_05, "cmu/bvh/02_05.bvh");
BENCHMARK_CAPTURE(read_bvh_clip, boxing_toes, "odd/Boxing_Toes.bvh");
BENCHMARK_CAPTURE(read_bvh_clip, exponents, "odd/MS2_8Walk_M.bvh");

void read_amc_clip(benchmark::State& state, const char* skeleton, const char* clip) {
  const FileBytes asf = bytes_of(state, skeleton), amc = bytes_of(state, clip);
  if (!asf || !amc) return;
  Alone work;
  const AcclaimSkeleton bones = read_asf(*asf, work);
  for (auto _ : state) benchmark::DoNotOptimize(acclaim_motion(bones, *amc, {}, work));
  count(state, amc->size());
}
BENCHMARK_CAPTURE(read_amc_clip, cmu_17_10, "cmu/asfamc/17.asf", "cmu/asfamc/17_10.amc");

void write_untouched(benchmark::State& state) {
  const FileBytes bytes = bytes_of(state, "cmu/bvh/02_05.bvh");
  if (!bytes) return;
  Alone work;
  const Motion motion = read_bvh(*bytes, {}, work);
  std::size_t written = 0;
  for (auto _ : state) written = write_bvh(motion, {}, work).size();
  count(state, written);
}
BENCHMARK(write_untouched);

void write_edited(benchmark::State& state) {
  const FileBytes bytes = bytes_of(state, "cmu/bvh/02_05.bvh");
  if (!bytes) return;
  Alone work;
  Motion motion = read_bvh(*bytes, {}, work);
  for (int j = 0; j < motion.joints(); ++j)
    for (std::size_t t = 0; t < motion.frames(); ++t)
      motion.rotation(j).set(t, motion.rotation(j)[t] * axis_angle({0, 1, 0}, 0.01));
  std::size_t written = 0;
  for (auto _ : state) written = write_bvh(motion, {}, work).size();
  count(state, written);
}
BENCHMARK(write_edited);

}  // namespace
}  // namespace kinegraph
