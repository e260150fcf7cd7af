#include "gui/window/changes_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QPushButton>
#include <QTreeWidget>
#include <algorithm>

#include "graph/json.h"
#include "gui/look/headed_column.h"

namespace kinegraph {
namespace {

constexpr int row_height = 26;

bool is_node(const Unit& unit) {
  return unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node;
}

}  // namespace

UnitWords unit_words(const Unit& unit) {
  const QString name = QString::fromStdString(unit.name), key = QString::fromStdString(unit.key);
  switch (unit.kind) {
    case Unit::Kind::node:
    case Unit::Kind::missing_node:
      return {name, QObject::tr("the node")};
    case Unit::Kind::node_type:
      return {name, QObject::tr("type")};
    case Unit::Kind::node_enabled:
      return {name, QObject::tr("enabled")};
    case Unit::Kind::node_note:
      return {name, QObject::tr("note")};
    case Unit::Kind::node_param:
    case Unit::Kind::node_input:
    case Unit::Kind::node_extra:
      return {name, key};
    case Unit::Kind::variable:
      return {{}, QObject::tr("variable %1").arg(name)};
    case Unit::Kind::publish_param:
    case Unit::Kind::publish_input:
    case Unit::Kind::publish_output:
      return {{}, QObject::tr("published %1").arg(name)};
    default:
      return {{}, QString::fromStdString(to_text(unit))};
  }
}

QString value_words(const std::optional<Json>& value, const Unit& unit) {
  if (!value) return QObject::tr("–");
  if (is_node(unit) && value->is_object())
    if (const Json* type = value->find("type"); type && type->is_string())
      return QString::fromStdString(type->string());
  if (value->is_string()) return QString::fromStdString(value->string());
  return QString::fromStdString(compact(*value));
}

QStringList changes_in_words(const Diff& diff) {
  QStringList words;
  for (const auto& [from, to] : diff.renames)
    words << QObject::tr("%1 is now %2").arg(QString::fromStdString(from), QString::fromStdString(to));
  for (const Change& change : diff.changes) {
    const QString name = QString::fromStdString(change.unit.name);
    if (is_node(change.unit))
      words << (change.after && change.before ? QObject::tr("another node %1").arg(name)
                : change.after                ? QObject::tr("new node %1").arg(name)
                                              : QObject::tr("%1 is gone").arg(name));
    else if (const auto [node, what] = unit_words(change.unit); node.isEmpty())
      words << what;
    else
      words << QObject::tr("%1 of %2").arg(what, node);
  }
  return words;
}

ChangesDialog::ChangesDialog(const QString& title, const Diff& diff, QWidget* parent) : QDialog(parent) {
  setObjectName("changes_dialog");
  setWindowTitle(tr("What changed"));
  QVBoxLayout* column = headed_column(*this, title);
  auto* list = new QTreeWidget(this);
  list->setAccessibleName(tr("Changes"));
  list->setHeaderLabels({tr("Node"), tr("What"), tr("Before"), tr("On disk now")});
  list->setRootIsDecorated(false);
  list->setAllColumnsShowFocus(true);
  list->setColumnWidth(0, 150);
  list->setColumnWidth(1, 150);
  list->setColumnWidth(2, 190);
  list->header()->setStretchLastSection(true);
  const auto add = [&](const QStringList& cells) {
    auto* item = new QTreeWidgetItem(list, cells);
    item->setSizeHint(0, QSize(0, row_height));
    for (int i = 0; i < int(cells.size()); ++i) item->setToolTip(i, cells[i]);
  };
  for (const auto& [from, to] : diff.renames)
    add({QString::fromStdString(from), tr("name"), QString::fromStdString(from), QString::fromStdString(to)});
  for (const Change& change : diff.changes) {
    const auto [node, what] = unit_words(change.unit);
    add({node.isEmpty() ? tr("the graph") : node, what, value_words(change.before, change.unit),
         value_words(change.after, change.unit)});
  }
  if (diff.empty()) add({tr("the graph"), tr("layout"), tr("–"), tr("moved")});
  list->setCurrentItem(list->topLevelItem(0));
  column->addWidget(list, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->addButton(tr("Merge it in"), QDialogButtonBox::AcceptRole)->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  resize(740, 170 + row_height * std::clamp(list->topLevelItemCount(), 3, 14));
}

}  // namespace kinegraph
