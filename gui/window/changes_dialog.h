// What a colleague changed in the file, unit by unit, in a table, before it is merged in.
#pragma once
#include <QDialog>
#include <QStringList>

#include "graph/file/diff.h"

namespace kinegraph {

QStringList changes_in_words(const Diff& diff);  // "amount of transfer", "new node feet"

// A unit's node and what of it: "transfer", "amount"; of the graph as a whole the node is empty.
struct UnitWords {
  QString node, what;
};
UnitWords unit_words(const Unit& unit);
// A unit's value as a table shows it.
QString value_words(const std::optional<Json>& value, const Unit& unit);

class ChangesDialog : public QDialog {
  Q_OBJECT

 public:
  ChangesDialog(const QString& title, const Diff& diff, QWidget* parent = nullptr);
};

}  // namespace kinegraph
