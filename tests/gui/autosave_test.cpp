// What happens to unsaved work: autosaves, and several editors of one graph.
#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QFile>
#include <QPushButton>
#include <QStandardPaths>
#include <fstream>

#include "graph/file/write.h"
#include "tests/gui/on_disk.h"

namespace kinegraph::editor_test {
namespace {

// A session with unsaved work that ended without a word.
struct Ended {
  Ended() {
    OnDisk editor;
    editor.add("gait");
    text = editor.session().text();
    EXPECT_TRUE(QTest::qWaitFor([&] { return QFile::exists(editor.session().autosave_path()); }, 5000));
    for (const char* file : {"main.kg.json", ".main.kg.json.autosave"})
      EXPECT_TRUE(QFile::copy(editor.folder.filePath(file), folder.filePath(file)));
  }
  QString path() const { return folder.filePath("main.kg.json"); }
  QTemporaryDir folder;
  std::string text;
};

TEST(EditorOnDisk, AnAutosaveIsOfferedAndTakenUpAsOneStep) {
  Ended first;
  const std::string& wanted = first.text;
  Editor second;
  ASSERT_TRUE(second.window.open(first.path()));
  EXPECT_NE(second.session().text(), wanted);
  QPushButton* take = nullptr;
  for (QPushButton* button : second.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
    if (button->text() == "Take it up") take = button;
  ASSERT_TRUE(take);
  const std::string before = second.session().text();
  QTest::mouseClick(take, Qt::LeftButton);
  EXPECT_EQ(second.session().text(), wanted);
  second.canvas().setFocus();
  second.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(second.session().text(), before);
  EXPECT_FALSE(second.session().can_undo());
}

TEST(EditorOnDisk, WhereNoAutosaveFitsBesideTheGraphItLiesWithTheUser) {
  {
    OnDisk editor;
    ASSERT_TRUE(QDir(editor.folder.path()).mkpath(".main.kg.json.autosave"));  // in its way
    editor.set_note("mine");
    QTest::qWait(2600);
    bool kept = false;
    const QDir state(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation));
    for (const QString& name : state.entryList({"*main.kg.json.autosave"}, QDir::Files | QDir::Hidden)) {
      QFile file(state.filePath(name));
      kept |= file.open(QIODevice::ReadOnly) && file.readAll().contains("mine");
    }
    EXPECT_TRUE(kept);
    editor.key(Qt::Key_S, Qt::ControlModifier);
    EXPECT_TRUE(state.entryList({"*main.kg.json.autosave"}, QDir::Files | QDir::Hidden).isEmpty());
  }
}

TEST(EditorOnDisk, WhoNeverRestsIsAutosavedToo) {
  OnDisk editor;
  QElapsedTimer clock;
  clock.start();
  bool saved = false;
  for (int i = 0; clock.elapsed() < 6000 && !saved; ++i) {
    editor.session().select({editor.document().nodes.begin()->first});
    editor.canvas().setFocus();
    editor.key(i % 2 ? Qt::Key_Left : Qt::Key_Right, Qt::ControlModifier);
    QTest::qWait(200);
    saved = QFile::exists(editor.session().autosave_path());
  }
  EXPECT_TRUE(saved);
}

TEST(EditorOnDisk, NewWorkDoesNotOverwriteTheAutosaveThatIsOffered) {
  Ended first;
  const auto is_offered = [](Editor& editor) {
    for (auto* one : editor.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
      if (one->text() == "Take it up") return true;
    return false;
  };
  {
    Editor second;
    ASSERT_TRUE(second.window.open(first.path()));
    EXPECT_TRUE(is_offered(second));
    second.add("metrics");
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(second.session().autosave_path()); }, 5000));
    ASSERT_TRUE(QFile::remove(second.session().autosave_path()));
  }
  // Not answered: a third start still offers the first work.
  Editor third;
  ASSERT_TRUE(third.window.open(first.path()));
  EXPECT_TRUE(is_offered(third));
  QFile kept(third.session().autosave_path() + ".found");
  ASSERT_TRUE(kept.open(QIODevice::ReadOnly));
  EXPECT_EQ(kept.readAll().toStdString(), first.text);
}

TEST(EditorOnDisk, WorkOfSeveralEndedSessionsIsOfferedOneAfterAnother) {
  OnDisk first;
  const QString second = first.folder.filePath("second.kg.json");
  ASSERT_TRUE(QFile::copy(first.path, second));
  Document work = first.document();
  for (const char* end : {"", ".found"}) {
    work.nodes.begin()->second.note = *end ? "older" : "fresher";
    std::ofstream(first.folder.filePath(QString(".second.kg.json.autosave") + end).toStdString())
        << write_document(work, first.registry);
  }
  ASSERT_TRUE(first.window.open(second));
  ASSERT_TRUE(first.notice()->isVisible());
  ASSERT_TRUE(first.answer("Throw it away"));
  ASSERT_TRUE(first.notice()->isVisible());
  ASSERT_TRUE(first.answer("Take it up"));
  EXPECT_EQ(first.note(), "older");
}

TEST(EditorOnDisk, TwoEditorsOfOneGraphKeepTheirOwnUnsavedWork) {
  OnDisk first;
  first.add("gait");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(first.session().autosave_path()); }, 5000));
  {
    Editor second;
    ASSERT_TRUE(second.window.open(first.path));
    // It is told of the other, and isn't given what that one is at.
    auto* notice = second.window.findChild<QWidget*>("notice_bar");
    EXPECT_TRUE(notice->isVisible());
    EXPECT_FALSE(second.session().autosave_found());
    second.add("metrics");
    ASSERT_NE(second.session().autosave_path(), first.session().autosave_path());
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(second.session().autosave_path()); }, 5000));
    // The one that saves throws away its own alone.
    QApplication::setActiveWindow(&first.window);
    first.canvas().setFocus();
    first.key(Qt::Key_S, Qt::ControlModifier);
    EXPECT_FALSE(QFile::exists(first.session().autosave_path()));
    EXPECT_TRUE(QFile::exists(second.session().autosave_path()));
  }
  Editor third;
  ASSERT_TRUE(third.window.open(first.path));
  EXPECT_TRUE(third.session().autosave_found());
  third.session().keep_found();
  EXPECT_FALSE(has_error(third.session().recover()));
  third.session().discard_autosave();
}

TEST(EditorOnDisk, GraphsThatWereNeverSavedKeepTheirWorkApart) {
  Editor editor;
  editor.add("gait");
  const QString one = editor.session().autosave_path();
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(one); }, 5000));
  editor.session().new_page();
  editor.canvas().setFocus();
  editor.add("metrics");
  const QString two = editor.session().autosave_path();
  EXPECT_NE(one, two);
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(two); }, 5000));
  QFile file(one);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains("Gait"));
  for (int page : {1, 0}) {
    editor.session().show_page(page);
    editor.session().discard_autosave();
  }
  EXPECT_FALSE(QFile::exists(one) || QFile::exists(two));
}

}  // namespace
}  // namespace kinegraph::editor_test
