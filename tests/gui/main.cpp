// The editor's tests run inside one application with a real window, as its users do.
#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>

#include "gui/look/editor_style.h"
#include "tests/gui/kill_test.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  const bool is_child = argc == 4 && argv[1] == kinegraph::editor_test::edit_until_killed;
  // What the editor remembers of earlier tests, or of the user's own work, must not decide one.
  QTemporaryDir home;
  if (!is_child)
    for (const char* place : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"})
      qputenv(place, home.path().toUtf8());
  QApplication application(argc, argv);
  QApplication::setStyle(new kinegraph::EditorStyle);
  const QStringList words = QApplication::arguments();
  if (is_child) return kinegraph::editor_test::run_until_killed(words[2], words[3]);
  return RUN_ALL_TESTS();
}
