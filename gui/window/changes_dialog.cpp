#include "gui/window/changes_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "graph/json.h"

namespace kinegraph {
namespace {

QString shown(const std::optional<Json>& value, const Unit& unit) {
  if (!value) return QObject::tr("–");
  if ((unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node) && value->is_object())
    if (const Json* type = value->find("type"); type && type->is_string())
      return QString::fromStdString(type->string());
  if (value->is_string()) return QString::fromStdString(value->string());
  return QString::fromStdString(compact(*value));
}

bool is_node(const Unit& unit) {
  return unit.kind == Unit::Kind::node || unit.kind == Unit::Kind::missing_node;
}

}  // namespace

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
    else
      words << QString::fromStdString(to_text(change.unit));
  }
  return words;
}

ChangesDialog::ChangesDialog(const QString& title, const Diff& diff, QWidget* parent) : QDialog(parent) {
  setObjectName("changes_dialog");
  setWindowTitle(tr("What changed"));
  resize(720, 360);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(10);
  auto* head = new QLabel(QString("<b>%1</b>").arg(title.toHtmlEscaped()), this);
  column->addWidget(head);
  auto* list = new QTreeWidget(this);
  list->setAccessibleName(tr("Changes"));
  list->setHeaderLabels({tr("What"), tr("Before"), tr("On disk now")});
  list->setRootIsDecorated(false);
  list->setColumnWidth(0, 260);
  list->setColumnWidth(1, 190);
  list->header()->setStretchLastSection(true);
  for (const auto& [from, to] : diff.renames)
    list->addTopLevelItem(new QTreeWidgetItem(
        {tr("name of a node"), QString::fromStdString(from), QString::fromStdString(to)}));
  for (const Change& change : diff.changes)
    list->addTopLevelItem(new QTreeWidgetItem(
        {is_node(change.unit) ? tr("node %1").arg(QString::fromStdString(change.unit.name))
                              : QString::fromStdString(to_text(change.unit)),
         shown(change.before, change.unit), shown(change.after, change.unit)}));
  if (diff.empty()) list->addTopLevelItem(new QTreeWidgetItem({tr("only the layout")}));
  for (int i = 0; i < list->topLevelItemCount(); ++i)
    list->topLevelItem(i)->setSizeHint(0, QSize(0, fontMetrics().height() + 10));
  column->addWidget(list, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->addButton(tr("Merge it in"), QDialogButtonBox::AcceptRole)->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
}

}  // namespace kinegraph
