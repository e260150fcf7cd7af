// Undo covers everything: random gestures, every kind of them often, taken back and done again. By hand with
// KINEGRAPH_HANDS_SEEDS="1 2 3" in the environment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <sstream>

#include "nodes/all_nodes.h"
#include "tests/gui/hands.h"

namespace kinegraph::editor_test {
namespace {

constexpr int least_gestures = 500, least_of_each = 20;
constexpr int most_turns = 8000;

QString picture_of(QWidget& window) {
  const QString path = QDir::tempPath() + "/kinegraph_gestures.png";
  window.grab().save(path);
  return path;
}

std::string bytes_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

double cpu_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

// Gestures of chance until there are enough of every kind; those that came seldom come first.
struct GestureRun {
  GestureRun(MainWindow& the_window, Hands& the_hands) : window(the_window), hands(the_hands) {}

  bool is_enough() const {
    return all >= least_gestures && *std::min_element(done.begin(), done.end()) >= least_of_each;
  }
  std::size_t named(const std::string& name) const {
    std::size_t i = 0;
    while (gestures[i].name != name) ++i;
    return i;
  }
  std::size_t next() {
    if (in_the_way) {  // what was wanted last had no room, or nothing to act on
      const std::vector<const char*> tidying{"delete", "delete a note or frame", "move a note", "arrange"};
      return named(hands.one_of(tidying));
    }
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < gestures.size(); ++i)
      if (done[i] < least_of_each || hands.below(8) == 0) left.push_back(i);
    if (left.empty()) return std::size_t(hands.below(int(gestures.size())));
    // Mostly those that came seldom; what they need is made by the others.
    if (hands.below(3)) {
      const int least = *std::min_element(done.begin(), done.end());
      std::erase_if(left, [&](std::size_t i) { return done[i] > least + 2; });
    }
    return hands.one_of(left);
  }

  void go() {
    for (int turn = 0; turn < most_turns && !is_enough(); ++turn) {
      const std::size_t which = next();
      do_one(which);
      if (testing::Test::HasFailure()) return;
      ASSERT_LT(in_vain, 150) << "nothing can be done any more; see " << picture_of(window).toStdString();
    }
  }
  void do_one(std::size_t which) {
    const Gesture& gesture = gestures[which];
    hands.look_at_all();
    hands.give_clips();
    const std::size_t before = hands.session().history().position();
    ++tried[which];
    const double started = cpu_seconds();
    const bool acted = gesture.act(hands);
    took[which] += cpu_seconds() - started;
    ASSERT_FALSE(QApplication::activeModalWidget()) << gesture.name;
    ASSERT_FALSE(QApplication::activePopupWidget()) << gesture.name;
    for (const std::string& node : hands.given)
      ASSERT_TRUE(hands.document().nodes.count(node)) << node << " went with " << gesture.name;
    const std::size_t made = hands.session().history().position() - before;
    EXPECT_TRUE(gesture.steps == 0 || made <= std::size_t(gesture.steps))
        << gesture.name << " made " << made << " steps";
    if (acted && made == std::size_t(gesture.steps)) {
      ++done[which];
      ++all;
    }
    in_the_way = !acted && !in_the_way;
    in_vain = acted ? 0 : in_vain + 1;
  }
  std::string told() const {
    std::ostringstream text;
    for (std::size_t i = 0; i < gestures.size(); ++i)
      text << done[i] << " of " << tried[i] << ", " << int(took[i] * 1000) << " ms  " << gestures[i].name
           << "\n";
    return text.str();
  }

  MainWindow& window;
  Hands& hands;
  const std::vector<Gesture> gestures = all_gestures();
  std::vector<int> done = std::vector<int>(gestures.size()), tried = done;
  std::vector<double> took = std::vector<double>(gestures.size());
  int all = 0, in_vain = 0;
  bool in_the_way = false;
};

void undo_all_that_hands_do(unsigned seed) {
  QTemporaryDir folder;
  const QString path = graph_for_hands(folder.filePath("work"));
  const std::string first = bytes_of(path);
  const Registry registry = all_nodes();
  MainWindow window(registry, {.remember = false, .ask = true, .cache_folder = {}});
  window.resize(1280, 800);
  window.show();
  (void)QTest::qWaitForWindowExposed(&window);
  // Pictures of bodies are other tests' and cost most of the time.
  window.findChild<QDockWidget*>("dock_viewer")->close();
  ASSERT_TRUE(window.open(path));
  Session& session = window.session();
  ASSERT_EQ(session.text(), first) << "the graph for hands isn't in canonical form";
  Hands hands(window, seed, QFileInfo(path).path());
  const double started = cpu_seconds();

  GestureRun run(window, hands);
  run.go();
  testing::Test::RecordProperty("gestures", run.all);
  std::printf("%s", run.told().c_str());
  EXPECT_TRUE(run.is_enough()) << run.told() << "see " << picture_of(window).toStdString();
  if (testing::Test::HasFailure()) return;

  hands.look_at_all();
  const std::string last = session.text();
  EXPECT_NE(last, first);
  std::size_t steps = 0;
  for (; session.can_undo() && steps < 10000; ++steps) hands.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(session.text(), first);
  hands.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bytes_of(path), first);
  for (; session.can_redo() && steps > 0; --steps)
    hands.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(session.text(), last);
  hands.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bytes_of(path), last);
  std::printf("seed %u: %d gestures undone and done again, %.1f s of CPU\n", seed, run.all,
              cpu_seconds() - started);
}

TEST(EditorUndo, TakesBackTwentyRandomGesturesOfEveryKind) {
  const QByteArray asked = qgetenv("KINEGRAPH_HANDS_SEEDS");
  for (const QByteArray& seed : (asked.isEmpty() ? QByteArray("7") : asked).split(' ')) {
    SCOPED_TRACE("seed " + seed.toStdString());
    undo_all_that_hands_do(seed.toUInt());
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace kinegraph::editor_test
