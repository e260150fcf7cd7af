// An editor that dies in the middle of its work: the graph's file is whole, and the next start offers the
// rest.
#include "tests/gui/kill_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/file/read.h"
#include "graph/file/write.h"
#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

std::string bytes_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

void put(const QString& path, const std::string& bytes) {
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(bytes.data(), qint64(bytes.size()));
}

// ---- the editor that is killed: a process of its own, in a window of its own ----

// Adds a node, waits for the word, and saves.
void edit_and_save(Editor& editor, const QDir& folder) {
  editor.add("gait");
  (void)QTest::qWaitFor([&] { return QFile::exists(editor.session().autosave_path()); }, 20000);
  put(folder.filePath("ready"), editor.session().text());
  (void)QTest::qWaitFor([&] { return folder.exists("go"); }, 60000);
  editor.key(Qt::Key_S, Qt::ControlModifier);
}

// The graphs that a victim had open, one a line: when, whether it was unsaved, and which it was.
struct Trail {
  struct Step {
    qint64 at = 0;  // ms of the clock
    bool unsaved = false;
    std::size_t text = 0;
  };
  static std::size_t mark(const std::string& text) { return std::hash<std::string>()(text); }
  static QString path(const QDir& folder) { return folder.filePath("trail"); }
  static void add(const Session& session, const QDir& folder) {
    QFile file(path(folder));
    if (!file.open(QIODevice::Append)) return;
    file.write(QString("%1 %2 %3\n")
                   .arg(QDateTime::currentMSecsSinceEpoch())
                   .arg(session.is_modified())
                   .arg(mark(session.text()))
                   .toUtf8());
  }
  static std::vector<Step> read(const QDir& folder) {
    std::vector<Step> steps;
    for (const QString& line : QString::fromStdString(bytes_of(path(folder))).split('\n')) {
      const QStringList words = line.split(' ');
      if (words.size() == 3)
        steps.push_back({words[0].toLongLong(), words[1] == "1", std::size_t(words[2].toULongLong())});
    }
    return steps;
  }
};

// Adds, moves, takes back, and where the seed is odd saves, until it is killed.
void edit_without_end(Editor& editor, const QDir& folder, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int end) { return std::uniform_int_distribution<int>(0, end - 1)(random); };
  // A node that is added is there before it is moved to its place.
  QObject::connect(&editor.session(), &Session::changed, &editor.window,
                   [&] { Trail::add(editor.session(), folder); });
  QObject::connect(&editor.session(), &Session::file_changed, &editor.window,
                   [&] { Trail::add(editor.session(), folder); });
  Trail::add(editor.session(), folder);
  put(folder.filePath("ready"), {});
  for (;;) {
    const int kind = below(10);
    if (kind < 4) {
      editor.add(below(2) ? "gait" : "trim");
    } else if (kind < 8 && !editor.document().nodes.empty()) {
      auto node = editor.document().nodes.begin();
      std::advance(node, below(int(editor.document().nodes.size())));
      editor.drag_node(node->first, QPointF(below(900), below(600)));
    } else {
      editor.canvas().setFocus();
      editor.key(kind == 8 || seed % 2 == 0 ? Qt::Key_Z : Qt::Key_S, Qt::ControlModifier);
    }
  }
}

// ---- the one that kills it ----

struct Victim {
  // HOW is "save" or a seed of endless editing.
  explicit Victim(const QString& how) {
    folder.setAutoRemove(true);
    graph = folder.filePath("main.kg.json");
    before = "{\n  \"format\": \"kinegraph\",\n  \"schema\": 1\n}\n";
    put(graph, before);
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("TMPDIR", folder.path());  // nobody clears up after it
    process.setProcessEnvironment(environment);
    process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    process.start(QCoreApplication::applicationFilePath(), {edit_until_killed, folder.path(), how});
  }
  ~Victim() {
    process.kill();
    process.waitForFinished();
  }
  bool is_ready() {
    return QTest::qWaitFor([&] { return QFile::exists(folder.filePath("ready")); }, 60000);
  }

  QTemporaryDir folder;
  QString graph;
  std::string before;
  QProcess process;
};

QPushButton* offer(Editor& editor) {
  for (QPushButton* button : editor.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
    if (button->text() == "Take it up" && button->isVisible()) return button;
  return nullptr;
}

// Every system call by which a save changes something on disk, and those beside it. A question mark: where
// the machine has it.
const QString write_calls =
    "?open,openat,?creat,write,?writev,pwrite64,?pwritev,?sendfile,?copy_file_range,?rename,?renameat,"
    "renameat2,?link,?linkat,?unlink,unlinkat,fsync,fdatasync,?sync_file_range,?truncate,ftruncate,"
    "?fallocate,?chmod,fchmod,?fchmodat,?fchown,?utimensat,?mkdir,?mkdirat,close";

// strace at a victim's main thread, which is the one that saves. Without a reason it looks on.
struct Strace {
  Strace(const Victim& victim, const QStringList& options) {
    process.start("strace", QStringList{"-p", QString::number(victim.process.processId())} + options);
    if (!process.waitForStarted()) {
      why_not = "strace is not installed: scripts/install test";
      return;
    }
    QByteArray said;
    (void)QTest::qWaitFor(
        [&] {
          said += process.readAllStandardError();
          return said.contains("attached") || process.state() == QProcess::NotRunning;
        },
        20000);
    if (!said.contains("attached"))
      why_not = "this machine doesn't let strace look at a process: " + said.toStdString();
  }
  QProcess process;
  std::string why_not;
};

struct Call {
  QString name;
  int nth = 0;  // of its name, from 1: so strace counts
};

// What a save that nobody disturbs calls, in order, up to the last that names something in the graph's
// folder.
std::vector<Call> calls_of_a_save(std::string& why_not) {
  Victim victim("save");
  EXPECT_TRUE(victim.is_ready());
  const QString log = victim.folder.filePath("calls");
  Strace strace(victim, {"-y", "-o", log, "-e", "trace=" + write_calls});
  why_not = strace.why_not;
  if (!why_not.empty()) return {};
  put(victim.folder.filePath("go"), {});
  EXPECT_TRUE(victim.process.waitForFinished(60000));
  strace.process.waitForFinished();
  std::map<QString, int> count;
  std::vector<Call> calls;
  std::size_t last = 0;
  for (const QString& line : QString::fromStdString(bytes_of(log)).split('\n')) {
    const qsizetype bracket = line.indexOf('(');
    if (bracket <= 0 || !line[0].isLetter()) continue;
    const QString name = line.left(bracket);
    calls.push_back({name, ++count[name]});
    if (line.contains(victim.folder.path())) last = calls.size();
  }
  calls.resize(last);
  return calls;
}

TEST(EditorKilled, AtEveryWriteOfASaveLeavesAWholeFileAndOffersTheRest) {
  std::string why_not;
  const std::vector<Call> calls = calls_of_a_save(why_not);
  if (!why_not.empty()) GTEST_SKIP() << why_not;
  // The file aside is made, given its permissions, written, synced, closed and renamed, then its folder
  // synced and the autosave removed.
  ASSERT_GE(calls.size(), 8u);
  int kept_old = 0, had_new = 0;
  constexpr std::size_t together = 6;  // windows, while they wait for their autosave
  for (std::size_t first = 0; first < calls.size(); first += together) {
    std::vector<std::unique_ptr<Victim>> victims;
    for (std::size_t i = first; i < std::min(first + together, calls.size()); ++i)
      victims.push_back(std::make_unique<Victim>("save"));
    for (std::size_t i = 0; i < victims.size(); ++i) {
      Victim& victim = *victims[i];
      const Call& call = calls[first + i];
      SCOPED_TRACE(call.name.toStdString() + " " + std::to_string(call.nth));
      ASSERT_TRUE(victim.is_ready());
      const std::string wanted = bytes_of(victim.folder.filePath("ready"));
      ASSERT_NE(wanted, victim.before);
      Strace strace(victim, {"-o", "/dev/null", "-e", "trace=" + write_calls, "-e",
                             QString("inject=%1:signal=KILL:when=%2").arg(call.name).arg(call.nth)});
      ASSERT_EQ(strace.why_not, "");
      put(victim.folder.filePath("go"), {});
      ASSERT_TRUE(victim.process.waitForFinished(60000));
      strace.process.waitForFinished();
      EXPECT_EQ(victim.process.exitStatus(), QProcess::CrashExit);

      const std::string left = bytes_of(victim.graph);
      ASSERT_TRUE(left == victim.before || left == wanted) << left;
      Editor next;
      ASSERT_TRUE(next.window.open(victim.graph));
      if (left == wanted) {
        ++had_new;
        continue;
      }
      ++kept_old;
      QPushButton* take = offer(next);
      ASSERT_TRUE(take) << "no autosave is offered";
      QTest::mouseClick(take, Qt::LeftButton);
      EXPECT_EQ(next.session().text(), wanted);
    }
  }
  EXPECT_GE(kept_old, 5);
  EXPECT_GE(had_new, 2);
}

TEST(EditorKilled, AtTwentyMomentsLeavesAWholeFileAndOffersTheRest) {
  std::mt19937 random(20);
  constexpr qint64 autosave_within = 4000;  // ms
  int offered = 0, must = 0;
  for (int group = 0; group < 4; ++group) {
    struct Run {
      std::unique_ptr<Victim> victim;
      int moment;  // ms after it was ready
      qint64 killed = 0;
    };
    std::vector<Run> runs;
    for (int one = 0; one < 5; ++one) {
      const int seed = 5 * group + one;
      const int moment = std::uniform_int_distribution<int>(100, 6000)(random);
      runs.push_back({std::make_unique<Victim>(QString::number(seed)), moment});
    }
    for (Run& run : runs) ASSERT_TRUE(run.victim->is_ready());
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.moment < b.moment; });
    int now = 0;
    for (Run& run : runs) {
      QTest::qWait(run.moment - now);
      now = run.moment;
      run.killed = QDateTime::currentMSecsSinceEpoch();
      run.victim->process.kill();
      ASSERT_TRUE(run.victim->process.waitForFinished());
    }
    for (Run& run : runs) {
      Editor next;
      const std::string left = bytes_of(run.victim->graph);
      const std::vector<Trail::Step> trail = Trail::read(run.victim->folder.path());
      ASSERT_FALSE(trail.empty());
      const auto was_there = [&](const std::string& text) {
        return std::any_of(trail.begin(), trail.end(),
                           [&](const Trail::Step& step) { return step.text == Trail::mark(text); });
      };
      EXPECT_TRUE(left == run.victim->before || was_there(left)) << left;
      const ReadResult read = read_document(left, "main.kg.json", next.registry);
      EXPECT_TRUE(read.problems.empty()) << left;
      EXPECT_EQ(write_document(read.document, next.registry), left);
      ASSERT_TRUE(next.window.open(run.victim->graph));
      QPushButton* take = offer(next);
      // An autosave is two seconds behind the work at most, and a busy machine's a little more.
      bool long_unsaved = false;
      for (const Trail::Step& step : trail)
        long_unsaved = step.unsaved && (long_unsaved || step.at < run.killed - autosave_within);
      must += long_unsaved;
      EXPECT_TRUE(take || !long_unsaved) << "unsaved for " << autosave_within << " ms and not offered";
      if (!take) continue;
      ++offered;
      QTest::mouseClick(take, Qt::LeftButton);
      EXPECT_TRUE(was_there(next.session().text())) << "nobody ever had this:\n" << next.session().text();
      EXPECT_NE(next.session().text(), left);
    }
  }
  EXPECT_GE(offered, 5);
  EXPECT_GE(must, 1) << "none of them was unsaved for long";
}

// Work that goes on without a pause is kept as well as work that rests.
TEST(EditorKilled, WhileWorkGoesOnWithoutAPauseHasAnAutosave) {
  Victim victim("2");
  ASSERT_TRUE(victim.is_ready());
  const QString autosave = victim.folder.filePath(".main.kg.json.autosave");
  EXPECT_TRUE(QTest::qWaitFor([&] { return QFile::exists(autosave); }, 15000));
}

// Whoever goes on working beside the offer still has what was found.
TEST(EditorKilled, WorkThatWasFoundOutlivesNewWork) {
  Victim victim("save");
  ASSERT_TRUE(victim.is_ready());
  const std::string found = bytes_of(victim.folder.filePath("ready"));
  victim.process.kill();
  ASSERT_TRUE(victim.process.waitForFinished());
  {
    Editor next;
    ASSERT_TRUE(next.window.open(victim.graph));
    ASSERT_TRUE(offer(next));
    next.add("trim");
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(next.session().autosave_path()); }, 15000));
    next.canvas().setFocus();
    next.key(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_EQ(next.session().text(), victim.before);
  }
  Editor later;
  ASSERT_TRUE(later.window.open(victim.graph));
  QPushButton* take = offer(later);
  ASSERT_TRUE(take);
  QTest::mouseClick(take, Qt::LeftButton);
  EXPECT_EQ(later.session().text(), found);
}

}  // namespace

int run_until_killed(const QString& folder, const QString& how) {
  // So that strace may look at it where only parents may.
  prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY, 0, 0, 0);
  Editor editor;
  if (!editor.window.open(QDir(folder).filePath("main.kg.json"))) return 1;
  bool is_seed = false;
  const unsigned seed = how.toUInt(&is_seed);
  if (is_seed)
    edit_without_end(editor, QDir(folder), seed);
  else
    edit_and_save(editor, QDir(folder));
  // What is counted ends with the save: closing the window is another test's.
  _exit(0);
}

}  // namespace kinegraph::editor_test
