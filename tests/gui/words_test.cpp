// What docks say where there is nothing to see, and that it is no "Evaluating" that never ends.
#include <gtest/gtest.h>

#include <QFile>
#include <QLabel>

#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

struct Unfinished : Editor {
  Unfinished() {
    QFile file(folder.filePath("half.kg.json"));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"format": "kinegraph", "schema": 1, "nodes": {
      "gone": {"type": "Load", "params": {"file": "nowhere.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "gone.motion"}},
      "feet": {"type": "Footskate"}}})");
    file.close();
    EXPECT_TRUE(window.open(file.fileName()));
  }
  bool says(const QString& dock, const QString& words) {
    window.show_dock(dock);
    auto* room = window.findChild<QWidget*>("dock_" + dock.toLower());
    return QTest::qWaitFor(
        [&] {
          for (QLabel* label : room->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words)) return true;
          return false;
        },
        20000);
  }
};

TEST(EditorWords, OfAFileThatIsMissing) {
  Unfinished editor;
  editor.session().select({"gone"}, "gone");
  EXPECT_TRUE(editor.says("Viewer", "gone failed."));
  EXPECT_TRUE(editor.says("Curves", "gone failed."));
  EXPECT_TRUE(editor.says("Parameters", "nowhere.bvh"));
}

TEST(EditorWords, OfANodeBehindAFailedOne) {
  Unfinished editor;
  editor.session().select({"soft"}, "soft");
  EXPECT_TRUE(editor.says("Viewer", "soft waits for"));
  EXPECT_TRUE(editor.says("Curves", "soft waits for"));
}

TEST(EditorWords, OfANodeThatIsNotLinkedYet) {
  Unfinished editor;
  editor.session().select({"feet"}, "feet");
  EXPECT_TRUE(editor.says("Viewer", "feet isn't linked yet."));
  EXPECT_TRUE(editor.says("Curves", "feet isn't linked yet."));
}

}  // namespace
}  // namespace kinegraph::editor_test
