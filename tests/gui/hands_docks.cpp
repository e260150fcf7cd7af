// The gestures of the docks: parameters, components, files, and a colleague who saves the same file.
#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDropEvent>
#include <QFile>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QScrollBar>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/nested.h"
#include "gui/components/components_grid.h"
#include "gui/panels/param_field.h"
#include "tests/gui/hands.h"

namespace kinegraph::editor_test {
namespace {

using Kind = ParamType::Kind;

// Chooses a node that has a parameter of a kind, and gives its row in the panel. `fits` may refuse it.
QWidget* row_of(Hands& hands, Kind kind, const std::function<bool(const Param&)>& fits = {}) {
  const std::vector<std::string> given(hands.given.begin(), hands.given.end());
  for (const std::string& node : hands.shuffled(given)) {
    // What the components come from stays as it is.
    if (node == "ica" || node == "walk" || node == "sneak") continue;
    const auto& one = hands.document().nodes.at(node);
    const NodeType* type = known_type(hands.session().registry(), one);
    for (const Param& param : hands.shuffled(type->params)) {
      if (param.kind != kind || (fits && !fits(param)) || !hands.choose(node)) continue;
      hands.window.show_dock("Parameters");
      Hands::settle();
      return hands.window.findChild<QWidget*>("param_" + QString::fromStdString(param.name));
    }
  }
  return nullptr;
}

void retype(Hands& hands, QLineEdit& line, const QString& text) {
  hands.click(line, line.rect().center());
  line.setFocus();
  hands.key(Qt::Key_A, Qt::ControlModifier);
  hands.type(text);
  hands.key(Qt::Key_Return);
}

bool has_soft_range(const Param& param) {
  return !std::isnan(param.soft_min) && !std::isnan(param.soft_max);
}

bool slider(Hands& hands) {
  QWidget* row = row_of(hands, Kind::number, has_soft_range);
  auto* found = row ? row->findChild<QSlider*>() : nullptr;
  if (!found || !found->isEnabled()) return false;
  hands.drag_slider(*found);
  return true;
}

bool number(Hands& hands) {
  const Param* chosen = nullptr;
  QWidget* row = row_of(hands, Kind::number, [&](const Param& param) {
    chosen = &param;
    return has_soft_range(param);
  });
  if (!row) return false;
  const double value = chosen->soft_min + (chosen->soft_max - chosen->soft_min) * hands.below(100) / 100;
  retype(hands, *row->findChild<QLineEdit*>(), QString("%1/2").arg(2 * value));
  return true;
}

bool number_by_arrow(Hands& hands) {
  QWidget* row = row_of(hands, Kind::number, has_soft_range);
  if (!row) return false;
  row->findChild<QLineEdit*>()->setFocus();
  hands.key(hands.below(2) ? Qt::Key_Up : Qt::Key_Down);
  return true;
}

bool variable(Hands& hands) {
  QWidget* row = row_of(hands, Kind::number, has_soft_range);
  if (!row) return false;
  retype(hands, *row->findChild<QLineEdit*>(), "${lively}");
  return true;
}

bool choice(Hands& hands) {
  QWidget* row = row_of(hands, Kind::choice);
  auto* box = row ? row->findChild<QComboBox*>() : nullptr;
  if (!box) return false;
  box->setFocus();
  hands.key(box->currentIndex() > 0 ? Qt::Key_Up : Qt::Key_Down);
  return true;
}

bool pattern(Hands& hands) {
  QWidget* row = row_of(hands, Kind::pattern);
  if (!row) return false;
  const std::vector<QString> some{"*", "Spine>", "*Arm*", "-Head", "*Leg*, Hips"};
  retype(hands, *row->findChild<QLineEdit*>(), hands.one_of(some));
  return true;
}

bool range(Hands& hands) {
  QWidget* row = row_of(hands, Kind::range);
  if (!row) return false;
  retype(hands, *row->findChild<QLineEdit*>(), QString::number(hands.below(40)));
  return true;
}

bool file_name(Hands& hands) {
  if (!hands.choose("take")) return false;
  auto* row = hands.window.findChild<QWidget*>("param_file");
  if (!row) return false;
  const std::vector<QString> some{"clips/walk.bvh", "./clips/walk.bvh", "clips/../clips/walk.bvh",
                                  "clips/gone.bvh"};
  retype(hands, *row->findChild<QLineEdit*>(), hands.one_of(some));
  return true;
}

QTableWidget* rules(Hands& hands) {
  if (!hands.choose("check")) return nullptr;
  auto* row = hands.window.findChild<QWidget*>("param_rules");
  return row ? row->findChild<QTableWidget*>() : nullptr;
}

bool press_tool(Hands& hands, const QString& what) {
  for (auto* button : hands.window.findChildren<QToolButton*>())
    if (button->accessibleName() == what) {
      button->click();
      Hands::settle();
      return true;
    }
  return false;
}

QString rule(Hands& hands) {
  return QString("skate < 0.%1").arg(100 + hands.below(800));
}

bool table_add(Hands& hands) {
  QTableWidget* table = rules(hands);
  if (!table || table->rowCount() > 5 || !press_tool(hands, "rules: add a row")) return false;
  hands.type(rule(hands));
  hands.key(Qt::Key_Return);
  return true;
}

bool table_change(Hands& hands) {
  QTableWidget* table = rules(hands);
  if (!table || table->rowCount() == 0) return false;
  table->setFocus();
  table->setCurrentCell(hands.below(table->rowCount()), 0);
  hands.key(Qt::Key_F2);
  hands.key(Qt::Key_A, Qt::ControlModifier);
  hands.type(rule(hands));
  hands.key(Qt::Key_Return);
  return true;
}

bool table_remove(Hands& hands) {
  QTableWidget* table = rules(hands);
  if (!table || table->rowCount() < 2) return false;
  table->setCurrentCell(hands.below(table->rowCount()), 0);
  return press_tool(hands, "rules: remove the chosen row");
}

bool table_move(Hands& hands) {
  QTableWidget* table = rules(hands);
  if (!table || table->rowCount() < 2) return false;
  table->setCurrentCell(0, 0);
  return press_tool(hands, "rules: move the chosen row down");
}

bool row_menu(Hands& hands, const QString& what, const std::function<bool(const Param&)>& fits) {
  for (Kind kind : {Kind::number, Kind::choice, Kind::pattern, Kind::range}) {
    QWidget* row = row_of(hands, kind, fits);
    if (!row) continue;
    auto* button = row->parentWidget()->findChild<QToolButton*>("row_menu");
    bool chosen = false;
    hands.when_asked([&](QWidget& menu) { chosen = hands.choose_in_menu(menu, what); });
    hands.click(*button, button->rect().center());
    if (chosen) return true;
  }
  return false;
}

bool reset(Hands& hands) {
  return row_menu(hands, "Reset", [&](const Param& param) {
    for (const std::string& name : hands.given)
      if (hands.document().nodes.at(name).params.count(param.name) &&
          (name == "made" || name == "transfer" || name == "take"))
        return true;
    return false;
  });
}

bool publish(Hands& hands) {
  return row_menu(hands, hands.below(2) ? "Publish" : "Unpublish", {});
}

bool enabled_box(Hands& hands) {
  const std::vector<std::string> some = hands.own();
  if (some.empty() || !hands.choose(hands.one_of(some))) return false;
  for (auto* box : hands.window.findChildren<QCheckBox*>())
    if (box->accessibleName() == "Enabled" && box->isVisible()) {
      hands.click(*box, QPoint(8, box->height() / 2));
      return true;
    }
  return false;
}

bool note_line(Hands& hands) {
  const std::string node = hands.one_of(hands.all());
  if (node == "judge" || !hands.choose(node)) return false;  // a colleague writes there
  for (auto* line : hands.window.findChildren<QLineEdit*>())
    if (line->accessibleName() == "Note") {
      retype(hands, *line, "said " + QString::number(hands.below(10000)));
      return true;
    }
  return false;
}

bool name_line(Hands& hands) {
  const std::vector<std::string> some = hands.own();
  if (some.empty() || !hands.choose(hands.one_of(some))) return false;
  retype(hands, *hands.window.findChild<QLineEdit*>("node_name"),
         "called_" + QString::number(hands.below(100000)));
  return true;
}

// The components of the ICA, with so many chosen; null: they aren't there.
ComponentsGrid* components(Hands& hands, int count) {
  if (!hands.choose("ica")) return nullptr;
  hands.window.show_dock("Components");
  auto* grid = hands.window.findChild<ComponentsGrid*>();
  if (!QTest::qWaitFor([&] { return grid->isVisible() && !grid->visibleRegion().isEmpty(); }, 15000))
    return nullptr;
  const int first = hands.below(3);
  for (int i = 0; i < count; ++i)
    hands.click(*grid, grid->tile((first + i) % 3).center(), i ? Qt::ControlModifier : Qt::NoModifier);
  return grid;
}

bool press(Hands& hands, const char* text) {
  for (auto* button : hands.window.findChildren<QPushButton*>())
    if (button->text() == text && button->isVisible() && button->isEnabled()) {
      hands.click(*button, button->rect().center());
      return true;
    }
  return false;
}

bool take_component_away(Hands& hands) {
  return components(hands, 1) && press(hands, "Take away");
}

bool component_slider(Hands& hands, const char* name) {
  if (!components(hands, 1)) return false;
  for (auto* slider : hands.window.findChildren<QSlider*>())
    if (slider->accessibleName() == name && slider->isEnabled()) {
      hands.drag_slider(*slider);
      return true;
    }
  return false;
}

bool scale_component(Hands& hands) {
  return component_slider(hands, "Scale");
}
bool translate_component(Hands& hands) {
  return component_slider(hands, "Translate");
}
bool merge_components(Hands& hands) {
  return components(hands, 2) && press(hands, "Merge");
}
bool transfer_component(Hands& hands) {
  return components(hands, 1) && press(hands, "Transfer");
}

bool add_clip(Hands& hands) {
  if (!hands.few()) return false;
  hands.window.show_dock("Files");
  Hands::settle();
  auto* tree = hands.window.findChild<QTreeWidget*>("file_tree");
  const auto found = tree->findItems("clips/walk.bvh", Qt::MatchExactly | Qt::MatchRecursive);
  if (found.isEmpty()) return false;
  tree->setCurrentItem(found.front());
  tree->setFocus();
  hands.key(Qt::Key_Return);
  return true;
}

bool drop_clip(Hands& hands) {
  const QPoint at = hands.empty_place();
  if (!hands.few() || at.isNull()) return false;
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QDir(hands.folder).filePath("clips/walk.bvh"))});
  QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(&hands.canvas(), &enter);
  QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(&hands.canvas(), &drop);
  Hands::settle();
  return true;
}

// Somebody else saves the file with another note on a node, and it is merged in.
bool merge_from_disk(Hands& hands) {
  const Session& session = hands.session();
  ReadResult theirs = read_document(session.text_on_disk(), session.path().toStdString(), session.registry());
  theirs.document.nodes.at("judge").note = "theirs " + std::to_string(hands.below(100000));
  const std::string text = write_document(theirs.document, session.registry());
  QFile file(session.path());
  if (!file.open(QIODevice::WriteOnly)) return false;
  file.write(text.data(), qint64(text.size()));
  file.close();
  auto* notice = hands.window.findChild<QWidget*>("notice_bar");
  QPushButton* merge = nullptr;
  const bool offered = QTest::qWaitFor(
      [&] {
        for (auto* button : notice->findChildren<QPushButton*>())
          if (button->text() == "Merge it in" && button->isVisible()) merge = button;
        return merge != nullptr;
      },
      5000);
  if (!offered) return false;
  hands.click(*merge, merge->rect().center());
  const bool merged = QTest::qWaitFor([&] { return session.text_on_disk() == text; }, 1000);
  QTest::qWait(210);  // until the file is watched again
  return merged;
}

}  // namespace

std::vector<Gesture> dock_gestures() {
  return {
      {"parameter by slider", slider},
      {"parameter by number", number},
      {"parameter by arrow key", number_by_arrow},
      {"parameter by variable", variable},
      {"parameter by choice", choice},
      {"parameter by joint pattern", pattern},
      {"parameter by range", range},
      {"parameter by file", file_name},
      {"add a row", table_add},
      {"change a row", table_change},
      {"remove a row", table_remove},
      {"move a row", table_move},
      {"reset a parameter", reset},
      {"publish a parameter", publish},
      {"enable in the panel", enabled_box},
      {"note in the panel", note_line},
      {"name in the panel", name_line},
      {"take a component away", take_component_away},
      {"scale a component", scale_component},
      {"translate a component", translate_component},
      {"merge components", merge_components},
      {"transfer a component", transfer_component},
      {"add a clip of the files", add_clip},
      {"drop a clip", drop_clip},
      {"merge what changed on disk", merge_from_disk},
  };
}

}  // namespace kinegraph::editor_test
