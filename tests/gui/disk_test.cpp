// What happens to files: a colleague's changes, files that are gone or damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QRadioButton>
#include <QToolButton>
#include <QTreeWidget>
#include <fstream>

#include "graph/file/write.h"
#include "gui/window/relink_dialog.h"
#include "tests/gui/on_disk.h"

namespace kinegraph::editor_test {
namespace {

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

TEST(EditorOnDisk, WhereBothSidesChangedTheSameAPersonChoosesAndUndoGivesBackTheirs) {
  OnDisk editor;
  editor.set_note("mine");
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  editor.rewrite(write_document(theirs, editor.registry));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  ASSERT_TRUE(editor.answer("Merge it in"));
  EXPECT_EQ(editor.note(), "mine");
  editor.when_asked([&](QWidget& dialog) {
    const auto sides = dialog.findChildren<QRadioButton*>();
    ASSERT_EQ(sides.size(), 2);
    EXPECT_EQ(sides[0]->text(), "mine");
    EXPECT_TRUE(sides[0]->isChecked());
    QTest::mouseClick(sides[1], Qt::LeftButton, {}, QPoint(10, sides[1]->height() / 2));
    EXPECT_TRUE(sides[1]->isChecked());
    QTest::keyClick(&dialog, Qt::Key_Return);
  });
  ASSERT_TRUE(editor.answer("Choose…"));
  EXPECT_EQ(editor.note(), "theirs");
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.note(), "mine");
}

// Another branch is checked out: the file goes, is there without a byte, and is whole only later.
TEST(EditorOnDisk, AFileThatIsWrittenAnewByAndByIsOfferedOnceItIsWhole) {
  OnDisk editor;
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  const std::string whole = write_document(theirs, editor.registry);
  ASSERT_TRUE(QFile::remove(editor.path));
  QTest::qWait(20);
  editor.rewrite("");
  QTest::qWait(180);
  editor.rewrite(whole.substr(0, whole.size() / 2));
  QTest::qWait(60);
  editor.rewrite(whole);
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  QTest::qWait(700);
  ASSERT_TRUE(editor.answer("Merge it in"));
  EXPECT_EQ(editor.note(), "theirs");
}

TEST(EditorOnDisk, WhatIsSaidOfTheFileGoesOnceItIsSettled) {
  OnDisk editor;
  const std::string before = editor.session().text();
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  editor.rewrite(write_document(theirs, editor.registry));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  editor.rewrite(before);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !editor.notice()->isVisible(); }, 5000));
  ASSERT_TRUE(QFile::remove(editor.path));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  editor.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(editor.notice()->isVisible());
  EXPECT_TRUE(QFile::exists(editor.path));
}

TEST(EditorOnDisk, ANewerFileOfAColleagueIsNotWrittenOver) {
  OnDisk editor;
  editor.set_note("mine");
  const std::string newer = R"({"format": "kinegraph", "schema": 99, "nodes": {}})";
  editor.rewrite(newer);
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  editor.key(Qt::Key_S, Qt::ControlModifier);
  QFile file(editor.path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().toStdString(), newer);
  EXPECT_TRUE(editor.session().is_modified());
  EXPECT_TRUE(editor.notice()->isVisible());
}

TEST(EditorOnDisk, AGraphWhoseFolderIsGoneIsSavedElsewhere) {
  OnDisk editor(true);
  editor.set_note("mine");
  QDir(editor.folder.path()).removeRecursively();
  QTemporaryDir elsewhere;
  const QString path = elsewhere.filePath("kept.kg.json");
  editor.when_asked([&](QWidget& question) {
    auto* box = qobject_cast<QMessageBox*>(&question);
    ASSERT_TRUE(box);
    EXPECT_TRUE(box->informativeText().contains("isn't there")) << box->informativeText().toStdString();
    EXPECT_FALSE(box->informativeText().contains("No such file"));
    editor.when_asked([&](QWidget& dialog) {
      auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
      ASSERT_TRUE(name);
      name->setText(path);
      QTest::keyClick(name, Qt::Key_Return);
    });
    QTest::keyClick(&question, Qt::Key_Return);
  });
  editor.key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(QFile::exists(path));
  EXPECT_EQ(editor.session().path(), path);
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorOnDisk, SeveralUnsavedGraphsAreOneQuestion) {
  OnDisk editor(true);
  editor.set_note("mine");
  ASSERT_TRUE(QFile::copy(example_graphs() + "feet.kg.json", editor.folder.filePath("second.kg.json")));
  ASSERT_TRUE(editor.window.open(editor.folder.filePath("second.kg.json")));
  editor.set_note("mine too");
  int questions = 0;
  editor.when_asked([&](QWidget& question) {
    ++questions;
    auto* box = qobject_cast<QMessageBox*>(&question);
    ASSERT_TRUE(box);
    EXPECT_TRUE(box->informativeText().contains("main.kg.json\nsecond.kg.json"));
    QTest::keyClick(&question, Qt::Key_Return);
  });
  editor.window.close();
  EXPECT_EQ(questions, 1);
  EXPECT_FALSE(editor.window.isVisible());
  for (const char* name : {"main.kg.json", "second.kg.json"}) {
    QFile file(editor.folder.filePath(name));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_TRUE(file.readAll().contains("\"mine")) << name;
  }
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

TEST(EditorOnDisk, OfManyFilesThoseMetLastAreKnown) {
  QTemporaryDir folder;
  const QString clip = folder.filePath("clip.bvh");
  QFile file(clip);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly) && file.write("HIERARCHY") > 0);
  file.close();
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
  QDir().mkpath(data);
  QFile store(QDir(data).filePath("known_files"));
  ASSERT_TRUE(store.open(QIODevice::WriteOnly));
  for (int i = 0; i < 5000; ++i) store.write(QString("9 1 ab /clips/%1.bvh\n").arg(i).toUtf8());
  store.close();
  {
    KnownFiles known;
    known.learn({clip});
    ASSERT_TRUE(QTest::qWaitFor([&] { return known.find(clip).has_value(); }, 5000));
    ASSERT_TRUE(QThreadPool::globalInstance()->waitForDone(5000));
  }
  const KnownFiles later;
  EXPECT_TRUE(later.find(clip).has_value());
  EXPECT_TRUE(later.find("/clips/4999.bvh").has_value());
  EXPECT_FALSE(later.find("/clips/0.bvh").has_value());
  store.remove();
}

TEST(EditorOnDisk, AMissingFileIsSaidWithAButtonThatFindsIt) {
  Editor editor;
  const QString path = editor.folder.filePath("main.kg.json");
  ASSERT_TRUE(QFile::copy(example_graphs() + "sneaky_walk.kg.json", path));
  ASSERT_TRUE(editor.window.open(path));
  QWidget* notice = editor.window.findChild<QWidget*>("notice_bar");
  EXPECT_TRUE(notice->isVisible());
  bool offered = false;
  for (QPushButton* button : notice->findChildren<QPushButton*>())
    offered |= button->text().startsWith("Find ");
  EXPECT_TRUE(offered);
}

TEST(EditorOnDisk, ANewerFileIsForReadingOnly) {
  Editor editor;
  const QString path = editor.folder.filePath("newer.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(
      R"({"format": "kinegraph", "schema": 99, "nodes": {"walk": {"type": "Gait", "gait": ["new"]}}})");
  file.close();
  ASSERT_TRUE(editor.window.open(path));
  EXPECT_TRUE(editor.session().is_read_only());
  for (const char* edit : {"save", "run", "add", "arrange", "paste"})
    EXPECT_FALSE(editor.window.action(edit)->isEnabled()) << edit;
  EXPECT_NE(editor.canvas().scene().node("walk"), nullptr) << "what is understood is shown";
  editor.add("gait");
  editor.canvas().setFocus();
  editor.key(Qt::Key_A, Qt::ControlModifier);
  editor.key(Qt::Key_Delete);
  EXPECT_EQ(editor.document().nodes.size(), 1u);
}

TEST(EditorOnDisk, SavingDoesNotWriteOverWhatAColleagueSaved) {
  OnDisk editor;
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  editor.add("gait");
  const std::string text = write_document(theirs, editor.registry);
  editor.rewrite(text);
  editor.canvas().setFocus();
  editor.key(Qt::Key_S, Qt::ControlModifier);
  QFile file(editor.path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().toStdString(), text);
  file.close();
  ASSERT_TRUE(editor.notice()->isVisible());
  ASSERT_TRUE(editor.answer("Merge it in"));
  editor.canvas().setFocus();
  editor.key(Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().toStdString(), editor.session().text());
  EXPECT_EQ(editor.document().nodes.at(theirs.nodes.begin()->first).note, "theirs");
  EXPECT_EQ(editor.document().nodes.size(), theirs.nodes.size() + 1);
}

TEST(EditorOnDisk, ANodeOfAnUnknownTypeIsKeptAndSaid) {
  Editor editor;
  const QString path = editor.folder.filePath("future.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "dream": {
      "type": "DreamUp",
      "params": {
        "depth": [1, {"of": "sleep"}]
      }
    }
  }
}
)");
  file.close();
  ASSERT_TRUE(editor.window.open(path));
  EXPECT_TRUE(editor.canvas().scene().node("dream")->missing);
  editor.session().select({"dream"}, "dream");
  Editor::settle();
  bool told = false;
  for (QLabel* label : editor.window.findChildren<QLabel*>())
    told = told || (label->isVisible() && label->text().contains("Install the Kinegraph that made it"));
  EXPECT_TRUE(told);
  editor.add("gait");
  editor.key(Qt::Key_S, Qt::ControlModifier);
  ASSERT_FALSE(editor.session().is_modified());
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains(R"("depth": [1, {"of": "sleep"}])"));
}

struct NotSavedYet : Editor {
  NotSavedYet() : Editor(true) {
    for (const char* name : {"clips", "graphs", "elsewhere"}) QDir(folder.path()).mkpath(name);
    for (const char* name : {"walk.bvh", "sneak.bvh"})
      QFile::copy(example_graphs() + "clips/" + name, folder.filePath(QString("clips/") + name));
    load = add("load");
    choose("clips/walk.bvh");
  }
  void choose(const QString& file) {
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, middle(load));
    auto* row = window.findChild<QWidget*>("param_file");
    ASSERT_TRUE(row);
    name_file(folder.filePath(file));
    QTest::mouseClick(row->findChild<QToolButton*>(), Qt::LeftButton);
    settle();
  }
  void save_as(const QString& file) {
    name_file(folder.filePath(file));
    key(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  }
  std::string written() { return document().nodes.at(load).params.find("file")->second.string(); }
  bool all_found() { return !has_error(session().problems()); }
  std::string load;
};

TEST(EditorOnDisk, AClipChosenBeforeTheFirstSaveIsWrittenRelativeToTheGraph) {
  NotSavedYet editor;
  EXPECT_TRUE(QDir::isAbsolutePath(QString::fromStdString(editor.written())));
  editor.save_as("graphs/new.kg.json");
  EXPECT_EQ(editor.written(), "../clips/walk.bvh");
  EXPECT_TRUE(editor.all_found());
  EXPECT_FALSE(editor.session().is_modified());
  QFile file(editor.folder.filePath("graphs/new.kg.json"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().toStdString(), editor.session().text());
  EXPECT_FALSE(editor.session().text().find(editor.folder.path().toStdString()) != std::string::npos);
}

TEST(EditorOnDisk, SavedElsewhereAGraphStillFindsItsClipsAndSoDoesWhatIsUndone) {
  NotSavedYet editor;
  editor.save_as("graphs/new.kg.json");
  editor.choose("clips/sneak.bvh");
  EXPECT_EQ(editor.written(), "../clips/sneak.bvh");
  QDir(editor.folder.path()).mkpath("elsewhere/deep");
  editor.save_as("elsewhere/deep/new.kg.json");
  EXPECT_EQ(editor.written(), "../../clips/sneak.bvh");
  EXPECT_TRUE(editor.all_found());
  const std::string saved = editor.session().text();
  editor.canvas().setFocus();
  editor.key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(editor.written(), "../../clips/walk.bvh");
  EXPECT_TRUE(editor.all_found());
  EXPECT_TRUE(editor.session().is_modified());
  editor.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(editor.session().text(), saved);
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorOnDisk, AGraphWhoseFileIsDeletedIsSavedAgain) {
  OnDisk editor;
  const std::string text = editor.session().text();
  ASSERT_TRUE(QFile::remove(editor.path));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.notice()->isVisible(); }, 5000));
  EXPECT_FALSE(editor.session().is_modified());
  ASSERT_TRUE(editor.answer("Save it again"));
  QFile file(editor.path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().toStdString(), text);
}

TEST(EditorOnDisk, ClosingAGraphWhoseFileIsDeletedAsks) {
  Editor editor(true);
  const QString path = editor.folder.filePath("main.kg.json");
  ASSERT_TRUE(QFile::copy(example_graphs() + "feet.kg.json", path));
  ASSERT_TRUE(editor.window.open(path));
  ASSERT_TRUE(QFile::remove(path));
  editor.when_asked([](QWidget& dialog) { Editor::keys_to(dialog, {}, Qt::Key_Return); });
  editor.canvas().setFocus();
  editor.key(Qt::Key_Q, Qt::ControlModifier);
  EXPECT_TRUE(QFile::exists(path));
  EXPECT_FALSE(editor.window.isVisible());
}

TEST(EditorOnDisk, AFileThatIsDeletedAndWrittenAnewIsMerged) {
  OnDisk editor;
  Document theirs = editor.document();
  theirs.nodes.begin()->second.note = "theirs";
  ASSERT_TRUE(QFile::remove(editor.path));
  QTest::qWait(600);
  editor.rewrite(write_document(theirs, editor.registry));
  ASSERT_TRUE(QTest::qWaitFor([&] { return editor.answer("Merge it in"); }, 5000));
  EXPECT_EQ(editor.document().nodes.begin()->second.note, "theirs");
}

TEST(EditorOnDisk, AnUnknownTypeStandsAmongTheProblems) {
  OnDisk editor;
  std::string text = editor.session().text();
  const std::size_t at = text.find("\"Footskate\"");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 11, "\"Footskaet\"");
  editor.rewrite(text);
  Editor second;
  ASSERT_TRUE(second.window.open(editor.path));
  auto* list = second.window.findChild<QTreeWidget*>("problem_list");
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() > 0; }));
  const auto* item = list->topLevelItem(0);
  EXPECT_TRUE(item->text(1).contains("Footskaet")) << item->text(1).toStdString();
  EXPECT_TRUE(item->text(2).contains("Footskate")) << item->text(2).toStdString();
  EXPECT_EQ(second.session().text(), text);
}

TEST(EditorOnDisk, ADamagedClipFailsItsNodeWithWhatToDo) {
  OnDisk editor;
  for (const QFileInfo& clip : QDir(editor.folder.filePath("clips")).entryInfoList(QDir::Files)) {
    QFile file(clip.absoluteFilePath());
    ASSERT_TRUE(file.resize(file.size() / 3));
  }
  std::string load;
  for (const auto& [name, node] : editor.document().nodes)
    if (node.type == "Load") load = name;
  editor.session().select({load}, load);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const NodeStatus* status = editor.window.evaluation().status(load);
        return status && status->state == NodeStatus::State::failed;
      },
      20000));
  const Diagnostics& said = editor.window.evaluation().status(load)->diagnostics;
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const Diagnostic& d) {
    return d.severity == Severity::error && !d.hint.empty() && !d.file.empty();
  }));
  EXPECT_FALSE(editor.session().is_modified());
}

TEST(EditorOnDisk, ADamagedGraphIsRefusedWithADialogAndWhatIsOpenStays) {
  Editor editor(true);
  ASSERT_TRUE(editor.window.open(example_graphs() + "feet.kg.json"));
  const std::string before = editor.session().text();
  const QString path = editor.folder.filePath("torn.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(before.data(), qint64(before.size() / 2));
  file.close();
  QString told;
  editor.when_asked([&](QWidget& dialog) {
    for (QLabel* label : dialog.findChildren<QLabel*>()) told += label->text() + "\n";
    Editor::keys_to(dialog, {}, Qt::Key_Escape);
  });
  EXPECT_FALSE(editor.window.open(path));
  EXPECT_TRUE(told.contains("torn.kg.json can't be opened")) << told.toStdString();
  EXPECT_EQ(editor.session().text(), before);
  EXPECT_EQ(editor.session().pages(), 1);
}

TEST(EditorOnDisk, ABrokenGraphIsToldWholeInTheDialogAndInTheProblemsDock) {
  Editor editor(true);
  const QString path = editor.folder.filePath("broken.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(R"({"format": "kinegraph", "schema": 1, "nodes": {
  "walk": {"type": "Gait", "params": {"speed": 1, "speed": 2}},
  "soft": {"type": "Filter", "inputs": {"motion": "wolk.motion"}},
  "feet": {"type": "Footskate", "inputs": {"motion": "walk.motoin"}}}})");
  file.close();
  QString told, tip;
  editor.when_asked([&](QWidget& dialog) {
    for (QLabel* label : dialog.findChildren<QLabel*>()) {
      told += label->text() + "\n";
      if (!label->toolTip().isEmpty()) tip = label->toolTip();
    }
    Editor::keys_to(dialog, {}, Qt::Key_Escape);
  });
  EXPECT_FALSE(editor.window.open(path));
  for (const char* slip :
       {"line 2", "“speed”", "soft.motion, line 3", "wolk", "feet.motion, line 4", "motoin"})
    EXPECT_TRUE(told.contains(slip)) << slip << "\n" << told.toStdString();
  EXPECT_FALSE(told.contains(editor.folder.path())) << told.toStdString();
  EXPECT_EQ(tip, path);
  auto* list = editor.window.findChild<QTreeWidget*>("problem_list");
  const auto rows = [&] {
    QStringList found;
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      if (list->topLevelItem(i)->toolTip(0) == path) found << list->topLevelItem(i)->text(0);
    return found;
  };
  EXPECT_TRUE(QTest::qWaitFor([&] { return rows().size() == 3; }, 5000)) << rows().join("; ").toStdString();
  EXPECT_TRUE(list->isVisible());
  EXPECT_TRUE(rows().contains("broken.kg.json: soft.motion, line 3")) << rows().join("; ").toStdString();
  // Once a graph opens, they are of no interest any more.
  ASSERT_TRUE(editor.window.open(example_graphs() + "feet.kg.json"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return rows().isEmpty(); }, 5000));
}

TEST(EditorOnDisk, RunAsksToSaveTheGraphInside) {
  Editor editor(true);
  QDir(editor.folder.path()).mkpath("pipelines");
  for (const char* name : {"reuse.kg.json", "pipelines/sneakify.kg.json", "pipelines/restyle.kg.json",
                           "pipelines/clean_feet.kg.json"})
    ASSERT_TRUE(QFile::copy(example_graphs() + name, editor.folder.filePath(name)));
  ASSERT_TRUE(editor.window.open(editor.folder.filePath("reuse.kg.json")));
  editor.session().select({"sneaky"}, "sneaky");
  editor.canvas().setFocus();
  editor.key(Qt::Key_Return, Qt::ControlModifier);
  ASSERT_EQ(editor.session().title(), "sneakify.kg.json");
  editor.add("gait");
  editor.key(Qt::Key_PageUp, Qt::ControlModifier);
  ASSERT_EQ(editor.session().modified_inside().size(), 1u);
  bool ran = false;
  QObject::connect(&editor.window.evaluation(), &Evaluation::finished, &editor.window,
                   [&](bool effects) { ran = ran || effects; });
  // Escape: nothing is run and nothing saved.
  editor.when_asked([&](QWidget& dialog) { Editor::keys_to(dialog, {}, Qt::Key_Escape); });
  editor.key(Qt::Key_F5);
  QTest::qWait(300);
  EXPECT_FALSE(ran);
  EXPECT_EQ(editor.session().modified_inside().size(), 1u);
  // Enter: it is saved, then run.
  editor.when_asked([&](QWidget& dialog) { Editor::keys_to(dialog, {}, Qt::Key_Return); });
  editor.key(Qt::Key_F5);
  EXPECT_TRUE(QTest::qWaitFor([&] { return ran; }, 60000));
  EXPECT_TRUE(editor.session().modified_inside().empty());
}

TEST(EditorEvaluation, AnEditCancelsTheOldWorkAndClosingDoesToo) {
  const std::string long_warp = R"({"format": "kinegraph", "schema": 1, "nodes": {
    "a": {"type": "Gait", "params": {"seconds": 120}},
    "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 120}},
    "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}}}})";
  int cancelled = 0;
  {
    Editor editor;
    editor.session().open_text(long_warp, {});
    editor.session().select({"warp"}, "warp");
    const auto runs = [&] {
      const NodeStatus* status = editor.window.evaluation().status("warp");
      return status && status->state == NodeStatus::State::running;
    };
    ASSERT_TRUE(QTest::qWaitFor(runs, 60000));
    QObject::connect(&editor.window.evaluation(), &Evaluation::finished, &editor.window,
                     [&] { cancelled += editor.window.evaluation().log().stopped; });
    editor.session().select({"a"}, "a");
    editor.canvas().setFocus();
    editor.key(Qt::Key_D);
    EXPECT_TRUE(QTest::qWaitFor([&] { return cancelled > 0; }, 20000));
    editor.key(Qt::Key_Z, Qt::ControlModifier);
    editor.session().select({"warp"}, "warp");
    ASSERT_TRUE(QTest::qWaitFor(runs, 60000));
    editor.key(Qt::Key_Q, Qt::ControlModifier);
    EXPECT_FALSE(editor.window.isVisible());
  }
  EXPECT_GE(cancelled, 1);
}

}  // namespace
}  // namespace kinegraph::editor_test
