// What happens to files: autosaves, a colleague's changes, files that are gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QFile>
#include <QPushButton>
#include <QTimer>

#include "graph/file/write.h"
#include "gui/window/relink_dialog.h"
#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

const QString graphs = QString(KINEGRAPH_SOURCE_DIR) + "/graphs/";

struct OnDisk : Editor {
  OnDisk() : path(folder.filePath("main.kg.json")) {
    QDir(folder.path()).mkpath("clips");
    EXPECT_TRUE(QFile::copy(graphs + "sneaky_walk.kg.json", path));
    for (const QFileInfo& clip : QDir(graphs + "clips").entryInfoList(QDir::Files))
      QFile::copy(clip.absoluteFilePath(), folder.filePath("clips/" + clip.fileName()));
    EXPECT_TRUE(window.open(path));
    canvas().setFocus();
    settle();
  }
  void rewrite(const std::string& text) {
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(text.data(), qint64(text.size()));
  }
  QWidget* notice() { return window.findChild<QWidget*>("notice_bar"); }
  bool answer(const QString& text) {
    for (QPushButton* button : notice()->findChildren<QPushButton*>())
      if (button->text() == text && button->isVisible()) {
        QTest::mouseClick(button, Qt::LeftButton);
        settle();
        return true;
      }
    return false;
  }
  QString path;
};

TEST(EditorOnDisk, AnAutosaveIsOfferedAndTakenUpAsOneStep) {
  QString path;
  std::string wanted;
  OnDisk first;
  first.add("gait");
  wanted = first.session().text();
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(first.session().autosave_path()); }, 5000));
  // Another start of the editor, as after a crash of the first.
  Editor second;
  ASSERT_TRUE(second.window.open(first.path));
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

TEST(EditorOnDisk, AColleaguesChangeIsMergedAsOneStep) {
  OnDisk editor;
  const std::string base = editor.session().text();
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  editor.add("gait");
  const std::string mine = editor.session().text();
  editor.rewrite(write_document(theirs, editor.registry));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  ASSERT_TRUE(editor.answer("Merge it in"));
  EXPECT_EQ(editor.document().nodes.at(theirs.nodes.begin()->first).note, "theirs");
  EXPECT_EQ(editor.document().nodes.size(), theirs.nodes.size() + 1);
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.session().text(), mine);
}

TEST(EditorOnDisk, AMovedAndRenamedClipIsFoundByItsContent) {
  OnDisk editor;
  const auto load = [&]() -> std::pair<std::string, QString> {
    for (const auto& [name, node] : editor.document().nodes)
      if (node.type == "Load") return {name, QString::fromStdString(node.params.at("file").string())};
    return {};
  };
  const auto [node, file] = load();
  ASSERT_FALSE(node.empty());
  const QString old = editor.folder.filePath(file);
  KnownFiles known;
  known.learn({old});
  ASSERT_TRUE(QTest::qWaitFor([&] { return known.find(old).has_value(); }, 5000));
  QDir(editor.folder.path()).mkpath("archive");
  ASSERT_TRUE(QFile::rename(old, editor.folder.filePath("archive/take_7.bvh")));
  const auto missing = missing_files(editor.session());
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing.front().node, node);
  RelinkDialog dialog(editor.session(), known, missing, &editor.window);
  dialog.show();
  auto* choice = dialog.findChild<QComboBox*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return choice->currentIndex() > 0; }, 10000));
  EXPECT_TRUE(choice->currentText().contains("archive/take_7.bvh"));
  const std::string before = editor.session().text();
  QTest::keyClick(&dialog, Qt::Key_Return);
  EXPECT_EQ(editor.document().nodes.at(node).params.at("file"), Json("archive/take_7.bvh"));
  EXPECT_FALSE(has_error(editor.session().problems()));
  editor.session().undo();
  EXPECT_EQ(editor.session().text(), before);
}

TEST(EditorOnDisk, AMissingFileIsSaidWithAButtonThatFindsIt) {
  Editor editor;
  const QString path = editor.folder.filePath("main.kg.json");
  ASSERT_TRUE(QFile::copy(graphs + "sneaky_walk.kg.json", path));
  ASSERT_TRUE(editor.window.open(path));
  QWidget* notice = editor.window.findChild<QWidget*>("notice_bar");
  EXPECT_TRUE(notice->isVisible());
  bool offered = false;
  for (QPushButton* button : notice->findChildren<QPushButton*>()) offered |= button->text() == "Find them…";
  EXPECT_TRUE(offered);
}

TEST(EditorOnDisk, ANewerFileIsForReadingOnly) {
  Editor editor;
  const QString path = editor.folder.filePath("newer.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"format\": \"kinegraph\", \"schema\": 99, \"nodes\": {}}\n");
  file.close();
  ASSERT_TRUE(editor.window.open(path));
  EXPECT_TRUE(editor.session().is_read_only());
  EXPECT_FALSE(editor.window.action("save")->isEnabled());
  editor.add("gait");
  EXPECT_TRUE(editor.document().nodes.empty());
}

}  // namespace
}  // namespace kinegraph::editor_test
