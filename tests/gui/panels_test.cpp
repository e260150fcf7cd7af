#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QHelpEvent>
#include <QLabel>
#include <QScrollArea>
#include <QTableWidget>
#include <QToolTip>
#include <QTreeWidget>

#include "gui/canvas/fuzzy.h"
#include "gui/document/problem_text.h"
#include "gui/look/elided_line.h"
#include "gui/panels/arithmetic.h"
#include "gui/panels/typed_words.h"
#include "gui/panels/variants.h"
#include "tests/gui/editor.h"

namespace kinegraph::editor_test {
namespace {

TEST(EditorArithmetic, CalculatesWhatPeopleType) {
  EXPECT_EQ(calculated("1/4"), 0.25);
  EXPECT_EQ(calculated(" 2*(0.5+1) "), 3);
  EXPECT_EQ(calculated("-2^2"), -4);
  EXPECT_EQ(calculated("1e-3"), 0.001);
  EXPECT_EQ(calculated("24 * 60"), 1440);
  EXPECT_FALSE(calculated("1/0"));
  EXPECT_FALSE(calculated("walk"));
  EXPECT_FALSE(calculated("1 2"));
  EXPECT_FALSE(calculated(""));
}

TEST(EditorSearch, FindsByInitialsAndKeywords) {
  EXPECT_GT(fuzzy_score("st", "StyleTransfer", {}), 0);
  EXPECT_GT(fuzzy_score("sttr", "StyleTransfer", {}), 0);
  EXPECT_GT(fuzzy_score("save", "Export", {"save", "write"}), 0);
  EXPECT_EQ(fuzzy_score("xyz", "StyleTransfer", {"mood"}), 0);
  EXPECT_GT(fuzzy_score("trim", "Trim", {}), fuzzy_score("trim", "Resample", {"trim"}));
  // A node of the family before one that is only found by the word.
  EXPECT_GT(fuzzy_score("style", "QuatStats", {"style"}),
            fuzzy_score("style", "ICA", {"components", "style"}));
}

double number(Editor& editor, const std::string& node, const char* param) {
  const auto& params = editor.document().nodes.at(node).params;
  auto found = params.find(param);
  return found == params.end() ? -1 : found->second.number();
}

TEST(EditorParameters, ANumberFieldTakesArithmetic) {
  Editor editor;
  const std::string gait = editor.add("gait");
  auto* field = editor.window.findChild<QWidget*>("param_speed");
  ASSERT_TRUE(field);
  auto* line = field->findChild<QLineEdit*>();
  line->setFocus();
  line->selectAll();
  editor.type("3/2");
  editor.key(Qt::Key_Return);
  EXPECT_EQ(number(editor, gait, "speed"), 1.5);
}

TEST(EditorParameters, DraggingASliderAppliesLiveAndIsOneStep) {
  Editor editor;
  const std::string gait = editor.add("gait");
  auto* slider = editor.window.findChild<QWidget*>("param_bounce")->findChild<QSlider*>();
  ASSERT_TRUE(slider);
  const std::size_t steps = editor.session().history().position();
  const QPoint start(slider->width() / 2, slider->height() / 2);
  QTest::mousePress(slider, Qt::LeftButton, {}, start);
  double last = -2;
  int changes = 0;
  for (int x = 4; x <= 40; x += 4) {
    const QPoint at = start + QPoint(x, 0);
    QMouseEvent event(QEvent::MouseMove, at, slider->mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                      Qt::NoModifier);
    QApplication::sendEvent(slider, &event);
    if (number(editor, gait, "bounce") != last) ++changes;
    last = number(editor, gait, "bounce");
  }
  QTest::mouseRelease(slider, Qt::LeftButton, {}, start + QPoint(40, 0));
  EXPECT_GT(changes, 3);
  EXPECT_EQ(editor.session().history().position(), steps + 1);
  editor.session().undo();
  EXPECT_FALSE(editor.document().nodes.at(gait).params.count("bounce"));
}

TEST(EditorProblems, ADamagedClipIsToldWithItsLineAndWhatToDo) {
  const Diagnostic damaged =
      error("bad-number", "a number of OFFSET expected").in_file("takes/walk.bvh", {4, 12});
  EXPECT_EQ(problem_text(damaged), "walk.bvh, line 4: a number of OFFSET expected.");
  EXPECT_TRUE(advice_on(damaged).contains("Mend that line")) << qPrintable(advice_on(damaged));
  EXPECT_EQ(advice_on(error("x", "y").hinting("link it")), "Link it.");
  EXPECT_EQ(advice_on(error("x", "y")), "");
}

TEST(EditorProblems, QuotesAreTheSameInAllWords) {
  EXPECT_EQ(with_quotes("There is no file \"a b.bvh\"."), "There is no file “a b.bvh”.");
  EXPECT_EQ(with_quotes("Link the output `points`."), "Link the output “points”.");
  EXPECT_EQ(with_quotes("no file 'walk.bvh'"), "no file “walk.bvh”");
  EXPECT_EQ(with_quotes("the actor's and the dog's"), "the actor's and the dog's");
}

TEST(EditorProblems, LongAdviceIsWrappedAndNotCut) {
  Editor editor;
  editor.window.resize(1280, 800);
  QFile file(editor.folder.filePath("damaged.bvh"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n}\n");
  file.close();
  editor.canvas().add("Load", {0, 0}, {}, {{"file", Json(file.fileName().toStdString())}});
  editor.window.show_dock("Problems");
  ASSERT_TRUE(editor.wait_for_evaluation());
  auto* list = editor.window.findChild<QTreeWidget*>("problem_list");
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() > 0; }, 5000));
  QTest::qWait(100);
  const QRect row = list->visualItemRect(list->topLevelItem(0));
  EXPECT_GT(row.height(), 2 * list->fontMetrics().height());
}

TEST(EditorEvaluation, TheCurrentNodeIsEvaluatedAndAnEditAsksAgain) {
  Editor editor;
  const std::string gait = editor.add("gait");
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return editor.window.evaluation().value(gait, "motion") != nullptr; }, 30000));
  const ValuePtr first = editor.window.evaluation().value(gait, "motion");
  editor.session().perform(
      [&](const Document& d, const Registry& r) { return set_param(d, r, gait, "bounce", Json(1.5)); });
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return editor.window.evaluation().value(gait, "motion") != first; }, 30000));
}

TEST(EditorProblems, AnOpenRequiredInputIsListedAndAClickGoesToItsNode) {
  Editor editor;
  const std::string metrics = editor.add("metrics");
  editor.session().select({});
  auto* list = editor.window.findChild<QTreeWidget*>("problem_list");
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->topLevelItemCount() > 0; }, 5000));
  editor.window.show_dock("Problems");
  editor.settle();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                    list->visualItemRect(list->topLevelItem(0)).center());
  EXPECT_EQ(editor.session().current(), metrics);
}

TEST(EditorFiles, ListsTheClipsBesideTheGraphAsTheyAreNow) {
  Editor editor;
  QDir(editor.folder.path()).mkpath("takes/deep");
  const auto put = [&](const QString& name) {
    QFile file(editor.folder.filePath(name));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  };
  put("takes/deep/one.bvh");
  put("takes/readme.txt");
  editor.session().save_as(editor.folder.filePath("graph.kg.json"));
  auto* tree = editor.window.findChild<QTreeWidget*>("file_tree");
  const auto lists = [&](const QString& name) {
    return QTest::qWaitFor(
        [&] { return !tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive).isEmpty(); });
  };
  editor.window.show_dock("Files");
  EXPECT_TRUE(lists("takes/deep/one.bvh"));
  EXPECT_TRUE(tree->findItems("takes/readme.txt", Qt::MatchExactly | Qt::MatchRecursive).isEmpty());
  editor.window.show_dock("Parameters");
  put("takes/two.c3d");
  editor.window.show_dock("Files");
  EXPECT_TRUE(lists("takes/two.c3d"));
}

TEST(EditorDocument, WhatIsSavedOpensAgainTheSame) {
  Editor editor;
  editor.add("gait");
  editor.add("metrics");
  const QString path = editor.folder.filePath("two.kg.json");
  editor.session().save_as(path);
  const std::string text = editor.session().text();
  Editor again;
  EXPECT_TRUE(again.window.open(path));
  EXPECT_EQ(again.session().text(), text);
  EXPECT_FALSE(again.session().is_modified());
}

TEST(EditorVariants, AnEditIsAChoiceAndWordsAndBack) {
  const Registry registry = all_nodes();
  const Param& edits = *registry.find("ComponentEdit")->find_param("edits");
  const ParamType& type = edits.parts[0];
  ASSERT_TRUE(has_variants(type));
  for (const ParamType::Choice& choice : choice_of_variants(type).choices) {
    const QString key = QString::fromStdString(choice.key);
    QString why;
    const QString text = fresh_variant_text(type, key, Json(Json::Object{}));
    const auto value = variant_of(type, key, text, &why);
    ASSERT_TRUE(value) << choice.key << ": " << why.toStdString();
    EXPECT_EQ(variant_key(type, *value), key);
    EXPECT_EQ(variant_text(type, *value), text);
  }
  QString why;
  EXPECT_EQ(*variant_of(type, "scale", "component 3, factor 1/2", &why),
            Json(Json::Object{{"op", "scale"}, {"component", 3}, {"factor", 0.5}}));
  EXPECT_FALSE(variant_of(type, "scale", "component 3, farctor 2", &why));
  EXPECT_TRUE(why.contains("factor")) << why.toStdString();
  // What both forms have stays when another is chosen.
  EXPECT_EQ(
      *variant_of(type, "merge", "name swing, terms 1 → 1, 2 → 0.5", &why),
      Json(Json::Object{{"op", "merge"},
                        {"name", "swing"},
                        {"terms", Json(Json::Array{Json(Json::Array{1, 1}), Json(Json::Array{2, 0.5})})}}));
  EXPECT_EQ(fresh_variant_text(type, "translate", *variant_of(type, "scale", "component 3, factor 2", &why)),
            "component 3, value 1");
}

TEST(EditorWords, StructuredValuesAreReadAndTypedWithoutBrackets) {
  const ParamType range_of = range();
  const ParamType place = tuple({kinegraph::number(0), kinegraph::number(0), kinegraph::number(0)});
  const ParamType pairs =
      list(tuple({either({integer(1).between(1, 100), text("u1")}), kinegraph::number(1)}));
  const ParamType some = either({integer(1).between(1, 100), list(integer(1).between(1, 100))});
  const ParamType names = list(text(""));
  const auto array = [](std::initializer_list<Json> all) { return Json(Json::Array(all)); };
  const auto expect = [](const ParamType& type, const Json& value, const char* words,
                         const std::vector<const char*>& also) {
    EXPECT_EQ(typed_text(type, value), QString(words));
    QString why;
    EXPECT_EQ(typed_value(type, words, &why), value) << words << ": " << why.toStdString();
    for (const char* text : also)
      EXPECT_EQ(typed_value(type, text, &why), value) << text << ": " << why.toStdString();
  };
  expect(range_of, array({10, 50}), "10–50", {"10:50", "10 - 50", "10 to 50", "[10, 50]", "5*2–100/2"});
  expect(range_of, array({10, Json()}), "10–end", {"10:", "10–", "10 to end"});
  expect(place, array({0.45, 1.7, -0.1}), "0.45, 1.7, -0.1",
         {"0.45 1.7 -0.1", "[0.45,1.7,-0.1]", "0.9/2, 1.7, -0.1"});
  expect(pairs, array({array({1, 1}), array({"swing", 0.5})}), "1 → 1, swing → 0.5",
         {"1->1, swing × 1/2", "1 1, swing .5"});
  expect(some, array({1, 3}), "1, 3", {"[1,3]"});
  expect(some, 4, "4", {});
  expect(names, array({"u1", "joint:*Leg*"}), "u1, joint:*Leg*", {});
  expect(names, array({"a, b", "c"}), "\"a, b\", c", {});
  expect(boolean(true), true, "yes", {"true", "On"});
  for (const auto& [type, text] : {std::pair{&range_of, "soon"},
                                   {&range_of, "50–10"},
                                   {&place, "1, 2"},
                                   {&place, "1, 2, x"},
                                   {&pairs, "1 → "},
                                   {&some, "1, two"}}) {
    QString why;
    EXPECT_FALSE(typed_value(*type, text, &why)) << text;
    EXPECT_FALSE(why.isEmpty()) << text;
  }
}

TEST(EditorWords, EveryDefaultOfEveryNodeIsReadBackAsItIs) {
  const Registry registry = all_nodes();
  for (const std::string& name : registry.names())
    for (const Param& param : registry.find(name)->params) {
      QString why;
      const Json value = param.fallback.value_or(Json());
      if (value.is_string() && value.string().empty()) continue;
      const auto again = typed_value(param, typed_text(param, value), &why);
      if (param.kind == ParamType::Kind::list || param.kind == ParamType::Kind::table) continue;
      ASSERT_TRUE(again) << name << "." << param.name << ": " << why.toStdString();
      EXPECT_EQ(*again, value) << name << "." << param.name;
    }
}

TEST(EditorParameters, WhatIsTooLongEndsInAnEllipsisAndHasAToolTip) {
  Editor editor;
  editor.add("Filter");
  auto* note = editor.window.findChild<QDockWidget*>("dock_parameters")->findChild<QLineEdit*>("node_note");
  auto* cut = dynamic_cast<ElidedLine*>(note);
  ASSERT_TRUE(cut);
  QTest::mouseClick(note, Qt::LeftButton);
  editor.type(QString("As the director wants it. ").repeated(6));
  editor.key(Qt::Key_Return);
  const QString all = note->text();
  const QImage typed = note->grab().toImage();
  editor.canvas().setFocus();
  Editor::settle();
  EXPECT_TRUE(cut->is_cut());
  EXPECT_EQ(note->text(), all) << "what is cut is only how it looks";
  EXPECT_NE(note->grab().toImage(), typed);
  QHelpEvent help(QEvent::ToolTip, QPoint(20, 8), note->mapToGlobal(QPoint(20, 8)));
  QApplication::sendEvent(note, &help);
  EXPECT_TRUE(QToolTip::text().contains(all.trimmed())) << QToolTip::text().toStdString();
  QToolTip::hideText();
}

// Of every node type: no row is wider than the dock, no button's words are cut, and a label's have a tool
// tip.
TEST(EditorParameters, EveryRowOfEveryNodeFitsADockOfTheLeastWidth) {
  Editor editor;
  auto* dock = editor.window.findChild<QDockWidget*>("dock_parameters");
  dock->setFloating(true);
  dock->resize(300, 700);
  for (const std::string& name : editor.registry.names()) {
    SCOPED_TRACE(name);
    editor.canvas().add(name, {0, 0});
    editor.settle();
    auto* room = dock->findChild<QScrollArea*>("parameter_rows");
    ASSERT_TRUE(room);
    const QRect seen = room->viewport()->rect();
    for (QWidget* part : room->widget()->findChildren<QWidget*>()) {
      if (!part->isVisible()) continue;
      const QPoint left = part->mapTo(room->viewport(), QPoint(0, 0));
      EXPECT_GE(left.x(), 0) << part->metaObject()->className();
      EXPECT_LE(left.x() + part->width(), seen.width() + 1)
          << part->metaObject()->className() << " " << part->accessibleName().toStdString();
      if (auto* button = qobject_cast<QAbstractButton*>(part); button && !button->text().isEmpty()) {
        EXPECT_GE(button->width(), button->fontMetrics().horizontalAdvance(button->text()))
            << button->accessibleName().toStdString();
      }
      if (auto* label = qobject_cast<QLabel*>(part); label && label->text().endsWith("…")) {
        EXPECT_FALSE(label->toolTip().isEmpty()) << label->text().toStdString();
      }
    }
  }
}

TEST(EditorParameters, ANodeWithManyProblemsKeepsRoomForItsParameters) {
  Editor editor;
  const QString path = editor.folder.filePath("many.kg.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  QByteArray pins;
  for (int i = 0; i < 6; ++i)
    pins += QByteArray(i ? "," : "") + R"({"joint": "LeftHand", "position": [2e6, 0, 0]})";
  file.write(
      R"({"format": "kinegraph", "schema": 1, "nodes": {"walk": {"type": "Gait"}, "pin": {"type": "Pin",
    "inputs": {"motion": "walk.motion"}, "params": {"pins": [)" +
      pins + "]}}}}");
  file.close();
  ASSERT_TRUE(editor.window.open(path));
  editor.window.show_dock("Parameters");
  auto* state = editor.window.findChild<QLabel*>("node_state");
  editor.session().select({"pin"}, "pin");
  editor.settle();
  EXPECT_EQ(state->text().count("<div"), 4) << state->text().toStdString();
  EXPECT_TRUE(state->text().contains("and 3 more")) << state->text().toStdString();
  // The table that holds them is marked.
  auto* pinned = editor.window.findChild<QWidget*>("param_pins")->findChild<QTableWidget*>();
  EXPECT_TRUE(pinned->property("mistake").toBool());
}

TEST(EditorFiles, AFilterHidesWhatHasNothingAndSaysSoOnce) {
  Editor editor;
  editor.window.show_dock("Files");
  auto* dock = editor.window.findChild<QDockWidget*>("dock_files");
  auto* filter = dock->findChild<QLineEdit*>();
  auto* tree = dock->findChild<QTreeWidget*>("file_tree");
  QTest::mouseClick(filter, Qt::LeftButton);
  editor.type("quadrille");
  QStringList seen;
  for (int i = 0; i < tree->topLevelItemCount(); ++i)
    if (!tree->topLevelItem(i)->isHidden()) seen << tree->topLevelItem(i)->text(0);
  EXPECT_EQ(seen, QStringList{"No graph or clip is called “quadrille”"});
}

}  // namespace
}  // namespace kinegraph::editor_test
