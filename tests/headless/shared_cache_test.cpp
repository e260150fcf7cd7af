// Many processes on one cache folder at once, some of them killed: nothing is wrong, nothing is torn, and
// hardly anything is computed twice.
#include <signal.h>
#include <unistd.h>

#include <map>
#include <random>
#include <set>
#include <sstream>

#include "program.h"

namespace kinegraph {
namespace {

using nlohmann::json;

constexpr int chains = 50, keys = 2 * chains + 1;

class SharedCache : public ProgramTest {
 protected:
  void SetUp() override {
    std::string nodes, joined;
    for (int i = 0; i < chains; ++i) {
      const std::string n = std::to_string(i);
      nodes += R"("walk)" + n + R"(": {"type": "Gait", "params": {"seconds": 1, "seed": )" + n + R"(}},
        "smooth)" +
               n + R"(": {"type": "Filter", "inputs": {"motion": "walk)" + n + R"(.motion"}},)";
      joined += (i ? ", " : "") + ("\"smooth" + n + ".motion\"");
    }
    write("g.kg.json",
          graph(nodes + R"("all": {"type": "Concatenate", "inputs": {"motions": [)" + joined + R"(]}},
      "out": {"type": "Export", "params": {"file": "all.bvh"}, "inputs": {"motion": "all.motion"}})"));
    ASSERT_EQ(run({"run", "g.kg.json", "--out", "alone"}).exit, 0);
  }
  RunningProgram begin(int number, int threads = 1) {
    const std::string n = std::to_string(number);
    return start({"run", "g.kg.json", "--out", "out" + n, "--report", "r" + n + ".json", "--cache", "cache",
                  "--threads", std::to_string(threads), "--progress", "json"});
  }
  // Nodes that the process computed, or had begun to compute when it was killed.
  static std::set<std::string> begun(const Ran& ran) {
    std::set<std::string> nodes;
    std::istringstream lines(ran.err);
    for (std::string line; std::getline(lines, line);) {
      const json told = json::parse(line, nullptr, false);  // the last one of a killed process may be cut
      if (told.is_object() && told["state"] == "running" && told["node"] != "out") nodes.insert(told["node"]);
    }
    return nodes;
  }
  // Its file is that of a process by itself, and no entry of the cache is damaged.
  void expect_whole(int number) {
    EXPECT_EQ(read("out" + std::to_string(number) + "/all.bvh"), read("alone/all.bvh")) << number;
  }
  void expect_whole_cache() {
    const Ran verified = run({"cache", "verify", "--cache", "cache"});
    EXPECT_EQ(verified.exit, 0) << verified.err << verified.out;
  }

  void run_at_once(int processes) {
    std::vector<RunningProgram> running;
    for (int i = 0; i < processes; ++i) running.push_back(begin(i));
    std::size_t computed = 0;
    std::set<std::string> nodes;
    for (int i = 0; i < processes; ++i) {
      const Ran ran = wait(running[static_cast<std::size_t>(i)]);
      EXPECT_EQ(ran.exit, 0) << ran.err;
      expect_whole(i);
      for (const std::string& node : begun(ran)) {
        ++computed;
        nodes.insert(node);
      }
    }
    EXPECT_EQ(nodes.size(), std::size_t{keys});
    EXPECT_LE(computed - nodes.size(), std::size_t{keys / 100});
    expect_whole_cache();
  }
  // Twenty at once; whoever is killed gets a successor, and all go on until there is nothing more to compute.
  // What a thread is at work on, or has not put on the disk yet, is lost with it; all that is finished is
  // there. So a kill repeats at most one node for each of the process's threads.
  void run_with_kills(int threads) {
    std::mt19937 random(7);
    std::map<int, RunningProgram> running;
    std::size_t computed = 0;
    std::set<std::string> nodes;
    int number = 0, kills = 0;
    const auto count = [&](const Ran& ran) {
      for (const std::string& node : begun(ran)) {
        ++computed;
        nodes.insert(node);
      }
    };
    const auto begin_another = [&] {
      const int process = number++;
      running[process] = begin(process, threads);
    };
    while (number < 20) begin_another();
    for (int round = 0; round < 15; ++round) {
      usleep(15000 + static_cast<useconds_t>(random() % 30000));
      auto victim = running.begin();
      std::advance(victim, static_cast<long>(random() % running.size()));
      ::kill(victim->second.process, SIGKILL);
      const Ran ran = wait(victim->second);
      kills += ran.exit == 128 + SIGKILL;
      count(ran);
      running.erase(victim);
      begin_another();
    }
    for (const auto& [process, one] : running) {
      const Ran ran = wait(one);
      EXPECT_EQ(ran.exit, 0) << ran.err;
      count(ran);
      expect_whole(process);
    }
    EXPECT_GT(kills, 3);
    EXPECT_EQ(nodes.size(), std::size_t{keys});
    RecordProperty("kills", kills);
    RecordProperty("repeats", static_cast<int>(computed - nodes.size()));
    EXPECT_LE(computed - nodes.size(), static_cast<std::size_t>(kills * threads)) << kills << " kills";
    expect_whole_cache();
  }
};

TEST_F(SharedCache, TwoProcessesComputeEachKeyOnce) {
  run_at_once(2);
}

TEST_F(SharedCache, TwentyProcessesComputeEachKeyOnce) {
  run_at_once(20);
}

TEST_F(SharedCache, OfTwentyProcessesKilledOnTheWayAtMostOneKeyAKillIsRepeated) {
  run_with_kills(1);
}

TEST_F(SharedCache, OfProcessesOfSeveralThreadsAKillRepeatsAtMostOneKeyAThread) {
  run_with_kills(4);
}

TEST_F(SharedCache, ALimitHoldsWhileManyWrite) {
  std::vector<RunningProgram> running;
  for (int i = 0; i < 4; ++i)
    running.push_back(start({"run", "g.kg.json", "--out", "out" + std::to_string(i), "--cache", "cache",
                             "--cache-limit", "1M", "--threads", "1", "--progress", "none"}));
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(wait(running[static_cast<std::size_t>(i)]).exit, 0);
    expect_whole(i);
  }
  EXPECT_EQ(run({"cache", "gc", "--cache", "cache", "--cache-limit", "1M"}).exit, 0);
  std::uintmax_t bytes = 0;
  for (const auto& file : files())
    if (file.starts_with("cache/") && std::filesystem::is_regular_file(path(file)))
      bytes += std::filesystem::file_size(path(file));
  EXPECT_LE(bytes, 1u << 20);
  EXPECT_GT(bytes, 1u << 19) << "a limit is no reason to keep nothing";
  expect_whole_cache();
}

}  // namespace
}  // namespace kinegraph
