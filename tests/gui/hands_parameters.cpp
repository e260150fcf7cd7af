// The gestures of the parameters' dock.
#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <cmath>

#include "graph/nested.h"
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
  auto* line = row->findChild<QLineEdit*>();
  hands.click(*line, line->rect().center());
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

bool boolean(Hands& hands) {
  QWidget* row = row_of(hands, Kind::boolean);
  auto* box = row ? row->findChild<QCheckBox*>() : nullptr;
  if (!box) return false;
  hands.click(*box, QPoint(8, box->height() / 2));
  return true;
}

// In the skeleton's tree, with arrow keys and Space; Escape closes it.
bool joints_in_tree(Hands& hands) {
  QWidget* row = row_of(hands, Kind::pattern);
  auto* button = row ? row->findChild<QToolButton*>() : nullptr;
  if (!button) return false;
  (void)QTest::qWaitFor([&] { return !hands.window.is_evaluating(); }, 5000);
  bool ticked = false;
  hands.when_asked([&](QWidget& menu) {
    auto* tree = menu.findChild<QTreeWidget*>();
    tree->setFocus();
    for (int i = hands.below(12); i >= 0; --i) QTest::keyClick(tree, Qt::Key_Down);
    ticked = tree->currentItem() && (tree->currentItem()->flags() & Qt::ItemIsUserCheckable);
    QTest::keyClick(tree, Qt::Key_Space);
    QTest::keyClick(tree, Qt::Key_Escape);
    if (menu.isVisible()) menu.close();
  });
  hands.click(*button, button->rect().center());
  return ticked;
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

bool press_tool(Hands& hands, const QString& what) {
  for (auto* button : hands.window.findChildren<QToolButton*>())
    if (button->accessibleName() == what) {
      hands.click(*button, button->rect().center());
      return true;
    }
  return false;
}

// With the button beside the field and the dialog that it opens.
bool file_by_dialog(Hands& hands) {
  if (!hands.choose("take")) return false;
  auto* row = hands.window.findChild<QWidget*>("param_file");
  auto* button = row ? row->findChild<QToolButton*>() : nullptr;
  if (!button) return false;
  const QString now = row->findChild<QLineEdit*>()->text();
  hands.answer_file_dialog(hands.folder + (now == "clips/walk.bvh" ? "/clips/sneak.bvh" : "/clips/walk.bvh"));
  hands.click(*button, button->rect().center());
  return true;
}

// A file that isn't there is named, and the dialog finds the one of its name.
bool relink(Hands& hands) {
  if (!hands.choose("take")) return false;
  auto* row = hands.window.findChild<QWidget*>("param_file");
  if (!row) return false;
  retype(hands, *row->findChild<QLineEdit*>(), QString("lost_%1/walk.bvh").arg(++hands.files));
  bool found = false;
  hands.when_asked([&](QWidget& dialog) {
    QPushButton* relink = nullptr;
    for (auto* button : dialog.findChildren<QPushButton*>())
      if (button->text() == "Relink") relink = button;
    found = relink && QTest::qWaitFor([&] { return relink->isEnabled(); }, 5000);
    QTest::keyClick(&dialog, found ? Qt::Key_Return : Qt::Key_Escape);
  });
  hands.canvas().setFocus();
  hands.key(Qt::Key_R, Qt::ControlModifier | Qt::ShiftModifier);
  return found;
}

// A table among the parameters of a node, which is chosen for it.
QTableWidget* table_of(Hands& hands, const std::string& node, const char* param) {
  if (!hands.choose(node)) return nullptr;
  hands.window.show_dock("Parameters");
  auto* row = hands.window.findChild<QWidget*>(QString("param_") + param);
  return row ? row->findChild<QTableWidget*>() : nullptr;
}

// Parameters that are tables, and what a person types into a new row of each, cell by cell.
struct Table {
  const char *node, *param;
  std::function<QStringList(Hands&)> row;
};
const Table rules{"check", "rules", [](Hands& hands) {
                    return QStringList{QString("skate < 0.%1").arg(100 + hands.below(800))};
                  }};
const Table weights{"bold", "weights", [](Hands& hands) {
                      const std::vector<QString> joints{"Head", "*Arm*", "*Leg*", "Spine>", "Hips", "*Foot"};
                      return QStringList{hands.one_of(joints), QString::number(hands.below(30) / 10.0)};
                    }};
const Table keys{"poses", "keys", [](Hands& hands) {
                   return QStringList{QString::number(hands.below(100)), "Head"};
                 }};

void choose_cell(Hands& hands, QTableWidget& table, int row, int column) {
  table.scrollToItem(table.item(row, column));
  hands.click(*table.viewport(), table.visualItemRect(table.item(row, column)).center());
}

void type_cells(Hands& hands, const QStringList& cells) {
  for (qsizetype i = 0; i < cells.size(); ++i) {
    hands.key(Qt::Key_A, Qt::ControlModifier);
    hands.type(cells[i]);
    hands.key(i + 1 < cells.size() ? Qt::Key_Tab : Qt::Key_Return);
  }
}

bool add_to(Hands& hands, const Table& into) {
  QTableWidget* table = table_of(hands, into.node, into.param);
  if (!table || table->rowCount() > 30 || !press_tool(hands, QString(into.param) + ": add a row"))
    return false;
  type_cells(hands, into.row(hands));
  return true;
}

bool add_rule(Hands& hands) {
  return add_to(hands, rules);
}
bool add_weight(Hands& hands) {
  return add_to(hands, weights);
}
bool add_key(Hands& hands) {
  return add_to(hands, keys);
}

// One of the tables with so many rows at least.
QTableWidget* some_table(Hands& hands, int least, const Table** which) {
  for (const Table* one : hands.shuffled(std::vector{&rules, &weights, &keys}))
    if (QTableWidget* table = table_of(hands, one->node, one->param); table && table->rowCount() >= least) {
      *which = one;
      return table;
    }
  return nullptr;
}

bool table_change(Hands& hands) {
  const Table* which = nullptr;
  QTableWidget* table = some_table(hands, 1, &which);
  if (!table) return false;
  choose_cell(hands, *table, hands.below(table->rowCount()), 0);
  hands.key(Qt::Key_F2);
  type_cells(hands, {which->row(hands).front()});
  return true;
}

bool table_remove(Hands& hands) {
  const Table* which = nullptr;
  QTableWidget* table = some_table(hands, 2, &which);
  if (!table) return false;
  choose_cell(hands, *table, hands.below(table->rowCount()), 0);
  return press_tool(hands, QString(which->param) + ": remove the chosen row");
}

bool table_move(Hands& hands) {
  for (const Table* one : {&rules, &keys}) {
    QTableWidget* table = table_of(hands, one->node, one->param);
    if (!table || table->rowCount() < 2) continue;
    choose_cell(hands, *table, 0, 0);
    return press_tool(hands, QString(one->param) + ": move the chosen row down");
  }
  return false;
}

// The list of edits of a node that the components' dock made.
QTableWidget* edits(Hands& hands) {
  for (const std::string& node : hands.shuffled(hands.own()))
    if (hands.document().nodes.at(node).type == "ComponentEdit")
      if (QTableWidget* table = table_of(hands, node, "edits")) return table;
  return nullptr;
}

bool add_edit(Hands& hands) {
  QTableWidget* table = edits(hands);
  return table && table->rowCount() < 12 && press_tool(hands, "edits: add a row");
}

bool change_edit(Hands& hands) {
  QTableWidget* table = edits(hands);
  if (!table) return false;
  for (int row = 0; row < table->rowCount(); ++row) {
    if (table->item(row, 0)->text() != "scale") continue;
    choose_cell(hands, *table, row, 1);
    hands.key(Qt::Key_F2);
    type_cells(hands,
               {QString("component %1, factor %2").arg(1 + hands.below(3)).arg(hands.below(400) / 100.0)});
    return true;
  }
  return false;
}

bool remove_edit(Hands& hands) {
  QTableWidget* table = edits(hands);
  if (!table || table->rowCount() < 2) return false;
  choose_cell(hands, *table, hands.below(table->rowCount()), 0);
  return press_tool(hands, "edits: remove the chosen row");
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

}  // namespace

std::vector<Gesture> parameter_gestures() {
  return {
      {"parameter by slider", slider},
      {"parameter by number", number},
      {"parameter by arrow key", number_by_arrow},
      {"parameter by variable", variable},
      {"parameter by choice", choice},
      {"parameter by switch", boolean},
      {"parameter by joint pattern", pattern},
      {"joints in the tree", joints_in_tree},
      {"parameter by range", range},
      {"parameter by file", file_name},
      {"parameter by file dialog", file_by_dialog},
      {"find a missing file", relink, 2},
      {"add a rule", add_rule},
      {"add a weight of joints", add_weight},
      {"add a key", add_key},
      {"change a row", table_change},
      {"remove a row", table_remove},
      {"move a row", table_move},
      {"reset a parameter", reset},
      {"publish a parameter", publish},
      {"enable in the panel", enabled_box},
      {"note in the panel", note_line},
      {"name in the panel", name_line},
      {"add an edit", add_edit},
      {"change an edit", change_edit},
      {"remove an edit", remove_edit},
  };
}

}  // namespace kinegraph::editor_test
