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
  RunningProgram begin(int number, int threads) {
    const std::string n = std::to_string(number);
    return start({"run", "g.kg.json", "--out", "out" + n, "--report", "r" + n + ".json", "--cache", "cache",
                  "--threads", std::to_string(threads), "--progress", "json"});
  }
  // Nodes, each with a key of its own: how many processes began to compute it, and how many of them were
  // killed.
  struct Work {
    std::map<std::string, int> begun, by_killed;

    void add(const Ran& ran) {
      std::set<std::string> nodes;
      std::istringstream lines(ran.err);
      for (std::string line; std::getline(lines, line);) {
        const json told = json::parse(line, nullptr, false);  // the last one of a killed process may be cut
        if (told.is_object() && told["state"] == "running" && told["node"] != "out")
          nodes.insert(told["node"]);
      }
      for (const std::string& node : nodes) {
        ++begun[node];
        by_killed[node] += ran.exit == 128 + SIGKILL;
      }
    }
    std::size_t repeats() const {
      std::size_t all = 0;
      for (const auto& [node, times] : begun) all += static_cast<std::size_t>(times - 1);
      return all;
    }
  };
  // Its file is that of a process by itself, and no entry of the cache is damaged.
  void expect_whole(int number) {
    EXPECT_EQ(read("out" + std::to_string(number) + "/all.bvh"), read("alone/all.bvh")) << number;
  }
  void expect_whole_cache() {
    const Ran verified = run({"cache", "verify", "--cache", "cache"});
    EXPECT_EQ(verified.exit, 0) << verified.err << verified.out;
  }

  void run_at_once(int processes, int threads) {
    std::vector<RunningProgram> running;
    for (int i = 0; i < processes; ++i) running.push_back(begin(i, threads));
    Work work;
    for (int i = 0; i < processes; ++i) {
      const Ran ran = wait(running[static_cast<std::size_t>(i)]);
      EXPECT_EQ(ran.exit, 0) << ran.err;
      expect_whole(i);
      work.add(ran);
    }
    EXPECT_EQ(work.begun.size(), std::size_t{keys});
    EXPECT_LE(work.repeats(), std::size_t{keys / 100});
    expect_whole_cache();
  }
  // Twenty at once; whoever is killed gets a successor, and all go on until there is nothing more to compute.
  // What is finished is on the disk before its thread takes the next node, so a kill loses one key a thread:
  // it repeats those once, and no other.
  void run_with_kills(int threads) {
    std::mt19937 random(7);
    std::map<int, RunningProgram> running;
    Work work;
    int number = 0, kills = 0;
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
      work.add(ran);
      running.erase(victim);
      begin_another();
    }
    for (const auto& [process, one] : running) {
      const Ran ran = wait(one);
      EXPECT_EQ(ran.exit, 0) << ran.err;
      work.add(ran);
      expect_whole(process);
    }
    EXPECT_GT(kills, 3);
    EXPECT_EQ(work.begun.size(), std::size_t{keys});
    for (const auto& [node, times] : work.begun) EXPECT_LE(times, 1 + work.by_killed[node]) << node;
    EXPECT_LE(work.repeats(), static_cast<std::size_t>(kills * threads)) << kills << " kills";
    RecordProperty("kills", kills);
    RecordProperty("repeats", static_cast<int>(work.repeats()));
    expect_whole_cache();
  }
};

TEST_F(SharedCache, TwoProcessesComputeEachKeyOnce) {
  run_at_once(2, 1);
}

TEST_F(SharedCache, TwentyProcessesComputeEachKeyOnce) {
  run_at_once(20, 1);
}

TEST_F(SharedCache, TwoProcessesOfFourThreadsComputeEachKeyOnce) {
  run_at_once(2, 4);
}

TEST_F(SharedCache, TwentyProcessesOfFourThreadsComputeEachKeyOnce) {
  run_at_once(20, 4);
}

TEST_F(SharedCache, OfTwentyProcessesKilledOnTheWayAtMostOneKeyAKillIsRepeated) {
  run_with_kills(1);
}

TEST_F(SharedCache, OfProcessesOfFourThreadsAKillRepeatsAKeyAtMostOnceAndAtMostOneAThread) {
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
