// Toy node types that count how often they are computed, and a world to run graphs of them in.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "graph/builtin_nodes.h"
#include "graph/compute.h"
#include "graph/evaluate/evaluator.h"
#include "graph/file/read.h"
#include "tests/graph/toys.h"

namespace kinegraph::toys {

// What toy nodes leave behind, by their `tag`, which is outside their keys.
struct Trace {
  void ran(const std::string& tag) {
    std::lock_guard lock(mutex);
    ++counts[tag];
    changed.notify_all();
  }
  int times(const std::string& tag) {
    std::lock_guard lock(mutex);
    return counts[tag];
  }
  int times() {
    std::lock_guard lock(mutex);
    int all = 0;
    for (const auto& [tag, count] : counts) all += count;
    return all;
  }
  // Whether `tag` began: for nodes that must run at the same time. A second thread comes in microseconds, but
  // on a machine with twenty times more to do than it has processors one of low priority was seen to wait 19 s
  // for its turn; so long that only a thread that never comes is too late.
  bool wait_for(const std::string& tag) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(240), [&] { return counts[tag] > 0; });
  }

  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::string, int> counts;
  std::function<void(const std::string& path)> on_read;  // called by Read before it reads
};

inline const std::vector<double>& numbers(const ValuePtr& value) {
  return dynamic_cast<const Numbers&>(*value).all;
}

inline NodeType toy(const std::string& name, Trace& trace, std::function<void(Compute&)> compute) {
  NodeType type;
  type.name = name;
  type.category = "toys";
  type.help = "A toy.";
  type.param("tag", text("").outside_key(), "counts under it");
  type.compute = [&trace, compute = std::move(compute)](Compute& node) {
    trace.ran(node.params().text("tag"));
    compute(node);
  };
  return type;
}

inline Registry toy_registry(Trace& trace) {
  Registry registry;
  add_toy_values(registry);
  registry.add(switch_node());
  registry.add(dot_node());

  registry.add(toy("Count", trace,
                   [](Compute& node) {
                     const auto size = static_cast<std::size_t>(node.params().integer("mib")) << 20;
                     node.output("numbers", Numbers({node.params().number("value")}, size));
                   })
                   .param("value", number(0), "the number")
                   .param("mib", integer(0), "pretended size")
                   .output("numbers", "Numbers", "one number"));

  auto read = toy("Read", trace,
                  [&trace](Compute& node) {
                    const auto& path = node.params().text("file");
                    if (trace.on_read) trace.on_read(path);
                    const auto bytes = node.files().read(path);
                    if (bytes->starts_with("warn"))
                      node.work().report(warning("odd", "an odd word in " + path).in_file(path, {1, 5}));
                    std::vector<double> all;
                    for (char c : *bytes) all.push_back(c);
                    for (const auto& beside : node.params().texts("beside"))
                      all.push_back(static_cast<double>(node.files().read(beside)->size()));
                    if (node.files().exists(path + ".more"))
                      all.push_back(static_cast<double>(node.files().read(path + ".more")->size()));
                    node.output("numbers", Numbers(std::move(all)));
                  })
                  .param("file", open_file(), "what to read")
                  .param("beside", list(open_file()), "more to read")
                  .output("numbers", "Numbers", "its bytes");
  read.companions = [](const Params& params, FileAccess& files) {
    std::vector<std::string> more;
    if (files.exists(params.text("file") + ".more")) more.push_back(params.text("file") + ".more");
    return more;
  };
  registry.add(std::move(read));

  registry.add(toy("Add", trace,
                   [](Compute& node) {
                     std::vector<double> sum{node.params().number("plus")};
                     for (const auto& term : node.values("terms")) sum.front() += numbers(term).front();
                     if (const auto* extra = node.optional_input<Numbers>("extra"))
                       sum.push_back(extra->all.front());
                     node.output("sum", Numbers(std::move(sum)));
                   })
                   .list_input("terms", {"Numbers"}, "what to add")
                   .optional_input("extra", {"Numbers"}, "stands behind the sum")
                   .param("plus", number(0), "added")
                   .output("sum", "Numbers", "the sum", "terms"));

  registry.add(
      toy("Total", trace, [](Compute& node) { node.output("total", Sum(node.input<Sum>("sum").total)); })
          .input("sum", {"Sum"}, "taken as one number")
          .output("total", "Sum", "the same"));

  registry.add(toy("Split", trace,
                   [](Compute& node) {
                     const auto& all = node.input<Numbers>("numbers").all;
                     if (node.wanted("whole")) node.output("whole", Numbers({std::floor(all.front())}));
                     if (node.wanted("rest"))
                       node.output("rest", Numbers({all.front() - std::floor(all.front())}));
                   })
                   .input("numbers", {"Numbers"}, "what to split")
                   .output("whole", "Numbers", "whole part")
                   .output("rest", "Numbers", "the rest")
                   .output("never", "Numbers", "can't be given"));

  registry.add(toy("Bad", trace,
                   [](Compute& node) {
                     const auto& how = node.params().text("how");
                     if (how == "failure")
                       throw Failure(
                           error("bad", "it went badly").at_joint("LeftFoot").at_frame(7).hinting("do else"));
                     if (how == "exception") throw std::runtime_error("an odd state");
                     if (how == "no memory") throw std::bad_alloc();
                     if (how == "number") throw 7;
                     if (how == "cancelled") throw Cancelled();
                     if (how == "reported") node.work().report(error("told", "told, not thrown"));
                     if (how == "not finite")
                       node.output("numbers", Numbers({1, std::numeric_limits<double>::quiet_NaN()}));
                     if (how == "type") node.output("numbers", Sum(1));
                     if (how == "port") node.output("nowhere", Sum(1));
                     if (how == "loop") {
                       node.work().parallel(1000, 1, [](std::size_t begin, std::size_t) {
                         if (begin % 100 == 17) throw Failure(error("piece", std::to_string(begin)));
                       });
                     }
                     if (how == "undeclared") node.files().read("/etc/hostname");
                   })
                   .optional_input("numbers", {"Numbers"}, "unused")
                   .param("how", text("failure"), "what goes wrong")
                   .output("numbers", "Numbers", "never comes"));

  // Runs until it is stopped.
  registry.add(toy("Spin", trace, [](Compute& node) {
                 for (double done = 0;; done += 1e-6) node.work().progress(done);
               }).output("numbers", "Numbers", "never comes"));
  registry.add(toy("SpinInLoop", trace, [](Compute& node) {
                 node.work().parallel(8, 1, [&](std::size_t, std::size_t) {
                   while (true) node.work().check();
                 });
               }).output("numbers", "Numbers", "never comes"));

  // Gives its number only if the node tagged `other` runs at the same time.
  registry.add(toy("Meet", trace,
                   [&trace](Compute& node) {
                     if (!trace.wait_for(node.params().text("other")))
                       throw Failure(error("alone", "the other one did not come"));
                     node.output("numbers", Numbers({1}));
                   })
                   .param("other", text("").outside_key(), "whom to meet")
                   .param("value", number(0), "tells keys apart")
                   .output("numbers", "Numbers", "one"));

  registry.add(toy("Loop", trace,
                   [](Compute& node) {
                     std::vector<double> all(20'000);
                     node.work().parallel(all.size(), 16, [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                         double x = static_cast<double>(i);
                         for (int k = 0; k < 200; ++k) x = x * 0.999 + 1 / (1 + x);
                         all[i] = x;
                         if (i % 5000 == 0) node.work().report(info("step", "at " + std::to_string(i)));
                       }
                     });
                     node.output("numbers", Numbers(std::move(all)));
                   })
                   .optional_input("numbers", {"Numbers"}, "unused")
                   .output("numbers", "Numbers", "many"));

  registry.add(toy("Hungry", trace,
                   [](Compute& node) {
                     auto held =
                         node.work().reserve(static_cast<std::size_t>(node.params().integer("mib")) << 20);
                     node.output("numbers", Numbers({node.params().number("value")}));
                   })
                   .param("value", number(0), "tells keys apart")
                   .param("mib", integer(1), "working memory")
                   .output("numbers", "Numbers", "one"));

  auto cpu = toy("Cpu", trace, [](Compute& node) {
               node.output("numbers", Numbers({1}));
             }).output("numbers", "Numbers", "one");
  cpu.same_on_every_cpu = false;
  registry.add(std::move(cpu));

  auto save = toy("Save", trace,
                  [](Compute& node) {
                    std::string text;
                    for (double one : node.input<Numbers>("numbers").all) text += std::to_string(one) + "\n";
                    node.write_file("file", text);
                    if (const auto& companion = node.params().text("companion"); !companion.empty())
                      node.write_file("file", "companion", companion);
                    if (node.params().boolean("fail")) throw Failure(error("bad", "after writing"));
                  })
                  .input("numbers", {"Numbers"}, "what to write")
                  .param("file", save_file(), "where to")
                  .param("companion", text(""), "a second file beside it")
                  .param("fail", boolean(false), "fails after writing");
  save.effect = Effect::writes;
  save.also_writes = [](const Params& params) {
    std::vector<std::string> more;
    if (const auto& name = params.text("companion"); !name.empty())
      more.push_back((std::filesystem::path(params.text("file")).parent_path() / name).string());
    return more;
  };
  registry.add(std::move(save));

  auto judge = toy("Judge", trace,
                   [](Compute& node) {
                     const double value = node.input<Numbers>("numbers").all.front();
                     const double limit = node.params().number("limit");
                     node.rule("number < limit", value, limit, value < limit);
                   })
                   .input("numbers", {"Numbers"}, "what to judge")
                   .param("limit", number(0), "must be under it");
  judge.effect = Effect::checks;
  registry.add(std::move(judge));
  return registry;
}

// A folder, a registry, caches, and runs of graphs in it.
class World : public testing::Test {
 protected:
  World() { options.out = folder / "out"; }

  Plan plan_of(const std::string& nodes, const std::vector<std::pair<std::string, std::string>>& sets = {}) {
    const std::string text = "{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {" + nodes + "}}";
    auto read = read_document(text, "test.kg.json", registry);
    for (const auto& problem : read.problems)
      EXPECT_NE(problem.severity, Severity::error) << to_text(problem);
    PlanOptions how;
    how.file = "test.kg.json";
    how.folder = folder.path;
    how.set_folder = folder.path;
    how.out = options.out;
    how.sets = sets;
    Diagnostics problems;
    auto plan = make_plan(read.document, registry, how, problems);
    for (const auto& problem : problems) EXPECT_NE(problem.severity, Severity::error) << to_text(problem);
    return plan;
  }
  Evaluator& evaluator() {
    if (!made) made.emplace(registry, files, memory ? &*memory : nullptr, disk ? &*disk : nullptr);
    return *made;
  }
  RunLog run(const Plan& plan, const std::vector<Target>& targets) {
    return evaluator().run(plan, targets, options, callbacks, &stop);
  }
  RunLog run(const std::string& nodes, const std::vector<Target>& targets) {
    return run(plan_of(nodes), targets);
  }
  // As a new process would find it.
  void forget() {
    made.reset();
    memory.reset();
    trace.counts.clear();
  }
  static std::string first_code(const RunLog& log, const std::string& node) {
    const auto& diagnostics = log.nodes.at(node).diagnostics;
    for (const auto& one : diagnostics)
      if (one.severity == Severity::error) return one.code;
    return diagnostics.empty() ? "" : diagnostics.front().code;
  }
  static NodeState state(const RunLog& log, const std::string& node) { return log.nodes.at(node).state; }

  Folder folder;
  Trace trace;
  Registry registry = toy_registry(trace);
  FileStore files;
  std::optional<MemoryCache> memory;
  std::optional<DiskCache> disk;
  std::optional<Evaluator> made;
  RunOptions options;
  RunCallbacks callbacks;
  StopToken stop;
};

inline std::ostream& operator<<(std::ostream& out, NodeState state) {
  return out << name_of(state);
}

}  // namespace kinegraph::toys
