#include "gui/window/conflicts_dialog.h"

#include <QButtonGroup>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QTableWidget>
#include <algorithm>

#include "gui/document/problem_text.h"
#include "gui/look/headed_column.h"
#include "gui/window/changes_dialog.h"

namespace kinegraph {
namespace {

enum Column { node_column, what_column, ours_column, theirs_column, columns };
constexpr int row_height = 32;

}  // namespace

ConflictsDialog::ConflictsDialog(const QString& title, const std::vector<MergeConflict>& conflicts,
                                 const Document& ours, const Document& theirs, QWidget* parent)
    : QDialog(parent) {
  setObjectName("conflicts_dialog");
  setWindowTitle(tr("Changed by both"));
  QVBoxLayout* column = headed_column(*this, title);
  column->addWidget(
      new QLabel(tr("Choose what to keep. All else of both sides is in the graph already."), this));
  auto* table = new QTableWidget(0, columns, this);
  table->setAccessibleName(tr("Changed by both"));
  table->setHorizontalHeaderLabels({tr("Node"), tr("What"), tr("Yours"), tr("On disk")});
  table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table->horizontalHeader()->setStretchLastSection(true);
  table->setColumnWidth(node_column, 140);
  table->setColumnWidth(what_column, 120);
  table->setColumnWidth(ours_column, 220);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(row_height);
  table->setShowGrid(false);
  table->setSelectionMode(QAbstractItemView::NoSelection);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setFocusPolicy(Qt::NoFocus);
  for (const MergeConflict& conflict : conflicts) {
    const int row = table->rowCount();
    table->insertRow(row);
    if (!conflict.unit) {
      table->setSpan(row, node_column, 1, columns);
      table->setItem(row, node_column,
                     new QTableWidgetItem(with_quotes(QString::fromStdString(conflict.what))));
      continue;
    }
    const Unit& unit = *conflict.unit;
    const auto [node, what] = unit_words(unit);
    table->setItem(row, node_column, new QTableWidgetItem(node.isEmpty() ? tr("the graph") : node));
    table->setItem(row, what_column, new QTableWidgetItem(what));
    auto* sides = new QButtonGroup(table);
    const auto side = [&](int at, const Document& from, const QString& whose) {
      auto* choice = new QRadioButton(value_words(get(from, unit), unit), table);
      choice->setToolTip(choice->text());
      choice->setAccessibleName(tr("%1 of %2, %3: %4").arg(what, node, whose, choice->text()));
      sides->addButton(choice);
      table->setCellWidget(row, at, choice);
      return choice;
    };
    side(ours_column, ours, tr("yours"))->setChecked(true);
    rows_.emplace_back(unit, side(theirs_column, theirs, tr("on disk")));
  }
  column->addWidget(table, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->addButton(tr("Keep these"), QDialogButtonBox::AcceptRole)->setDefault(true);
  auto* all = buttons->addButton(tr("All from disk"), QDialogButtonBox::ResetRole);
  all->setAutoDefault(false);
  connect(all, &QPushButton::clicked, this, [this] {
    for (const auto& [unit, choice] : rows_) choice->setChecked(true);
  });
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  resize(760, 176 + row_height * std::clamp(table->rowCount(), 3, 12));
}

std::vector<Unit> ConflictsDialog::chosen() const {
  std::vector<Unit> units;
  for (const auto& [unit, theirs] : rows_)
    if (theirs->isChecked()) units.push_back(unit);
  return units;
}

}  // namespace kinegraph
