// Undo covers everything: five hundred random gestures, those that came seldom first, taken back and done
// again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>

#include "nodes/all_nodes.h"
#include "tests/gui/hands.h"

namespace kinegraph::editor_test {
namespace {

constexpr int wanted_gestures = 500;

QString picture_of(QWidget& window) {
  const QString path = QDir::tempPath() + "/kinegraph_gestures.png";
  window.grab().save(path);
  return path;
}

std::string bytes_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

TEST(EditorUndo, TakesBackFiveHundredRandomGestures) {
  QTemporaryDir folder;
  const QString path = graph_for_hands(folder.path());
  const std::string first = bytes_of(path);
  const Registry registry = all_nodes();
  MainWindow window(registry, {.remember = false, .ask = true, .cache_folder = {}});
  window.resize(1280, 800);
  window.show();
  (void)QTest::qWaitForWindowExposed(&window);
  ASSERT_TRUE(window.open(path));
  Session& session = window.session();
  ASSERT_EQ(session.text(), first) << "the graph for hands isn't in canonical form";
  Hands hands(window, 7, folder.path());

  const std::vector<Gesture> gestures = all_gestures();
  std::vector<int> done(gestures.size()), tried(gestures.size());
  std::vector<qint64> took(gestures.size());
  int all = 0;
  QElapsedTimer clock;
  clock.start();
  const auto missing = [&] {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < gestures.size(); ++i)
      if (done[i] <= all / int(gestures.size())) left.push_back(i);
    return left;
  };
  const auto named = [&](const std::string& name) {
    std::size_t i = 0;
    while (gestures[i].name != name) ++i;
    return i;
  };
  bool in_the_way = false;  // what was wanted last had no room
  int in_vain = 0;
  for (int turn = 0; turn < 20000 && clock.elapsed() < 240000; ++turn) {
    const std::vector<std::size_t> left = missing();
    if (all >= wanted_gestures) break;
    std::size_t which = left.empty() || hands.below(4) == 0 ? std::size_t(hands.below(int(gestures.size())))
                                                            : hands.one_of(left);
    if (in_the_way) {
      const std::vector<const char*> tidying{"delete", "delete a note or frame", "arrange"};
      which = named(hands.one_of(tidying));
    }
    const Gesture& gesture = gestures[which];
    hands.look_at_all();
    const std::size_t steps = session.history().position();
    const qint64 started = clock.elapsed();
    ++tried[which];
    const bool acted = gesture.act(hands);
    took[which] += clock.elapsed() - started;
    ASSERT_FALSE(QApplication::activeModalWidget()) << gesture.name;
    for (const std::string& node : hands.given)
      ASSERT_TRUE(hands.document().nodes.count(node)) << node << " went with " << gesture.name;
    const std::size_t made = session.history().position() - steps;
    EXPECT_TRUE(gesture.steps == 0 || made <= std::size_t(gesture.steps))
        << gesture.name << " made " << made << " steps";
    if (acted && made == std::size_t(gesture.steps)) {
      ++done[which];
      ++all;
    }
    in_the_way = !acted && !in_the_way;
    in_vain = acted ? 0 : in_vain + 1;
    ASSERT_LT(in_vain, 150) << "nothing can be done any more; see " << picture_of(window).toStdString();
    if (testing::Test::HasFailure()) break;
  }
  for (std::size_t i = 0; i < gestures.size(); ++i) {
    std::printf("%4d of %4d, %5lld ms  %s\n", done[i], tried[i], static_cast<long long>(took[i]),
                gestures[i].name);
  }
  EXPECT_GE(all, wanted_gestures);

  hands.look_at_all();
  const std::string last = session.text();
  EXPECT_NE(last, first);
  std::size_t steps = 0;
  for (; session.can_undo() && steps < 5000; ++steps) hands.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(session.text(), first);
  hands.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bytes_of(path), first);
  for (; session.can_redo() && steps > 0; --steps)
    hands.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(session.text(), last);
  hands.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bytes_of(path), last);
  std::printf("%d gestures, undone and done again in %.1f s\n", all, double(clock.elapsed()) / 1000);
}

}  // namespace
}  // namespace kinegraph::editor_test
