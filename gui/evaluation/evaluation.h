// Evaluates what the editor shows, on other threads at lower priority. The GUI thread only asks and is told.
#pragma once
#include <QObject>
#include <QTimer>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "graph/document.h"
#include "graph/evaluate/evaluator.h"
#include "gui/evaluation/still_cache.h"

namespace kinegraph {

// How a node stands, as its body on the canvas shows it.
struct NodeStatus {
  // missing: of a type that is unknown here. incomplete: an input that it needs is not linked yet.
  enum class State {
    idle,
    waiting,
    running,
    done,
    failed,
    blocked,
    cancelled,
    disabled,
    missing,
    incomplete
  };
  State state = State::idle;
  double progress = 0;  // 0 to 1 while running
  double seconds = 0;
  std::string cached;                  // "memory", "disk", "no", "" = not known
  std::shared_ptr<const Still> still;  // of a node that gives a motion, once it is there
  std::string blocked_by;              // where it is blocked: the node before it that can't give anything
  int broken_rules = 0;                // of a Check that has run: then it has failed
  Diagnostics diagnostics;
};

// What to evaluate: a copy of the graph and what is looked at.
struct EvaluationRequest {
  Document document;
  std::string file, folder;
  std::vector<Target> targets;
  std::uint64_t graph = 0;  // filled in by request()
  bool effects = false;     // the Run button: Exports and Checks as well, into `folder`
};

class Evaluation : public QObject {
  Q_OBJECT

 public:
  // cache_folder "" = no disk cache. The registry outlives this.
  Evaluation(const Registry& registry, std::string cache_folder, QObject* parent = nullptr);
  ~Evaluation() override;  // stops what runs, waits for it

  // Replaces what runs and what waits: the old work is told to stop at once, but for nodes that the new
  // request needs just as they are: those run on, and it takes what they give. Values that stay the same come
  // from the cache. A run with effects is not replaced by one without; the latter waits.
  void request(EvaluationRequest request);
  void cancel();
  // Another graph is asked about from now on: nothing known of the nodes of the one before holds.
  void forget();
  bool is_busy() const;

  // The newest results; valid in the GUI thread.
  const NodeStatus* status(const std::string& node) const;
  ValuePtr value(const std::string& node, const std::string& port) const;  // null: none yet

 signals:
  void status_changed(const QString& node);
  void values_changed();  // some value() is new; emitted as nodes finish, at most some 30 times a second
  void finished(bool with_effects);  // log() is new
  void busy_changed(bool busy);

 public:
  const RunLog& log() const { return log_; }
  const Diagnostics& problems() const {
    return problems_;
  }  // of the graph as a whole, which keep it from running

 private:
  struct Result;
  struct Run;
  struct Unasked;
  void work();  // the thread that plans, and begins and stops runs
  bool may_begin(const std::optional<EvaluationRequest>& request) const;  // with the lock held
  void begin(EvaluationRequest request);
  std::shared_ptr<Run> planned(EvaluationRequest request);
  void replace_by(Run& fresh);  // what runs: it is stopped, or what is still wanted of it is set aside
  void run(Run& run);           // on its own thread
  void finish(Run& run);
  // States and stills of nodes that the caches know though nothing asked for them, and of those that were
  // `done` for an older graph and aren't any more; gives way to any request.
  void look_around(Run& run, const std::set<std::string>& done);
  void deliver_stills(const Run& run, const std::vector<std::string>& nodes);
  bool gives_way(const Run& run) const;  // something newer waits
  void deliver(std::shared_ptr<Result> result);
  void find_outdated(const Document& document, Result& result);
  void tell_of_unasked(const Run& run);
  void take_unasked(const Unasked& told);
  void take_broken_rules(const RunLog& log);
  void take_stills(const std::map<std::string, std::shared_ptr<const Still>>& stills);
  void sum_up_graph_nodes();
  void sum_up_soon(const std::string& inner);  // the Graph node that this one lies in
  void deliver_waiting(const Run& run, std::vector<std::string> nodes);
  void deliver_status(const Run& run, const std::string& node, NodeStatus status);

  const Registry& registry_;
  FileStore files_;
  MemoryCache memory_;
  std::unique_ptr<DiskCache> disk_;
  Evaluator evaluator_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<EvaluationRequest> next_;
  std::optional<EvaluationRequest> next_effects_;
  std::shared_ptr<Run> running_;             // the newest; null where nothing runs
  std::vector<std::shared_ptr<Run>> aside_;  // older ones, on their way to their end
  bool quitting_ = false, busy_ = false;
  std::uint64_t generation_ = 0, graph_ = 0;  // counts requests, and graphs forgotten

  // Of the run that finishes.
  std::mutex finishing_;
  StillCache stills_;

  // Of nodes that could not run, what they and all before them looked like then.
  std::map<std::string, std::string> failed_as_;
  std::map<std::string, std::string> ran_as_;  // likewise of Exports and Checks that ran
  std::set<std::string> lost_;                 // nodes whose file isn't there, asked for or not

  // GUI thread only.
  std::uint64_t delivered_ = 0;  // generation of the newest result
  std::map<std::string, NodeStatus> statuses_;
  std::map<std::string, std::string> stands_as_;  // a Switch or a Dot, and whose value it passes on
  std::set<std::string> unsummed_;                // Graph nodes, of which inner ones told of themselves since
  QTimer summing_;
  std::map<std::string, ValuePtr> values_;
  RunLog log_;
  Diagnostics problems_;

  std::thread thread_;
};

}  // namespace kinegraph
