// The editor's tests run inside one application with a real window, as its users do.
#include <gtest/gtest.h>

#include <QApplication>
#include <QStandardPaths>

#include "gui/look/editor_style.h"
#include "tests/gui/kill_test.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QApplication::setStyle(new kinegraph::EditorStyle);
  const QStringList words = QApplication::arguments();
  if (words.size() == 4 && words[1] == kinegraph::editor_test::edit_until_killed)
    return kinegraph::editor_test::run_until_killed(words[2], words[3]);
  return RUN_ALL_TESTS();
}
