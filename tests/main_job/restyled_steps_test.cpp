// Every step of the clip that a style was put on is still a step of its restyled self: where the source's
// heel or toe rests, by the tests' own rule, DetectContacts finds a plant of the same foot afterwards.
#include <fmt/format.h>

#include "exported.h"
#include "nodes/feet/detect_contacts.h"
#include "tests/nodes/feet/independent_feet.h"

namespace kinegraph {
namespace {

// An output of a saved graph, through the real program.
Motion got(const std::string& graph, const std::string& port) {
  namespace fs = std::filesystem;
  const fs::path file = fs::temp_directory_path() / fmt::format("kinegraph_steps_{}.bvh", ::getpid());
  const std::string command = fmt::format(
      "'{}/kinegraph' get '{}/{}' {} -o '{}' --var 'mocap={}' --progress none > '{}.log' 2>&1",
      KINEGRAPH_BIN_DIR, KINEGRAPH_SOURCE_DIR, graph, port, file.string(), mocap(), file.string());
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(command);
  FileStore files;
  Alone work;
  const Motion motion = *read_motion_file(file.string(), {}, files, work).motion();
  fs::remove(file);
  fs::remove(file.string() + ".log");
  return motion;
}

std::size_t expect_steps_kept(const Motion& source, const Motion& restyled, double min_time,
                              const std::string& name) {
  DetectContactsParams params;
  params.min_time = min_time;
  Alone work;
  const Contacts contacts = detect_contacts(restyled, params, work);
  EXPECT_EQ(restyled.frames(), source.frames()) << name;
  std::size_t steps = 0;
  for (bool left : {true, false}) {
    for (const kinegraph::Run& step : runs_of(independent::rests(source, left, min_time))) {
      if (step.start == 0 || step.end == source.frames()) continue;  // cut by the clip's ends
      ++steps;
      bool kept = false;
      for (const FootPoint& point : contacts.points)
        for (std::size_t t = step.start; t < step.end && point.left == left; ++t)
          kept = kept || point.planted[t];
      EXPECT_TRUE(kept) << name << (left ? ": left " : ": right ") << step.start << " to " << step.end;
    }
  }
  return steps;
}

struct Restyled {
  const char *graph, *source, *result;
};
class RestyledByAGraph : public testing::TestWithParam<Restyled> {};
INSTANTIATE_TEST_SUITE_P(Graphs, RestyledByAGraph,
                         testing::Values(Restyled{"style_transfer", "walk.motion", "transfer.motion"},
                                         Restyled{"style_transfer", "walk.motion", "unwarp.motion"},
                                         Restyled{"style_transfer", "walk.motion", "feet.motion"},
                                         Restyled{"sneaky_walk", "walk.motion", "feet.motion"},
                                         Restyled{"styled_rubber_walk", "walk.motion", "planted.motion"},
                                         Restyled{"component_transfer", "walk.motion", "feet.motion"},
                                         Restyled{"component_between", "walk.motion", "feet.motion"},
                                         Restyled{"component_run_walk", "walk.motion", "walk_feet.motion"}),
                         [](const auto& each) {
                           std::string name = fmt::format("{}_{}", each.param.graph, each.param.result);
                           name.erase(name.find('.'));
                           return name;
                         });
TEST_P(RestyledByAGraph, KeepsEachStepOfEachFoot) {
  const Restyled& one = GetParam();
  const std::string graph = fmt::format("graphs/{}.kg.json", one.graph);
  EXPECT_GE(expect_steps_kept(got(graph, one.source), got(graph, one.result), 0.1, one.graph), 5u);
}

// The pairs of [Wu] Table 1 after cleanup, a run's steps in plants of 0.03 s: its feet come in faster than
// before. Before it their feet slide and sink at up to 2 m/s in stance, and the plants are known from the
// source.
struct Pair {
  const char* name;
  double min_time;  // s
};
class RestyledPair : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Wu, RestyledPair,
                         testing::Values(Pair{"stealthy", 0.1}, Pair{"stride_run", 0.03}, Pair{"happy", 0.1},
                                         Pair{"old", 0.1}),
                         [](const auto& pair) { return std::string(pair.param.name); });
TEST_P(RestyledPair, KeepsEachStepOfEachFoot) {
  KINEGRAPH_NEEDS_MOCAP();
  const std::string graph = fmt::format("tests/main_job/{}.kg.json", GetParam().name);
  const Motion source = got(graph, "source.motion"), result = got(graph, "feet.motion");
  EXPECT_GE(expect_steps_kept(source, result, GetParam().min_time, GetParam().name), 3u);
}

}  // namespace
}  // namespace kinegraph
