// What changed between two states of a graph, in words and as a table, for a person who decides on a merge.
#pragma once
#include <QDialog>
#include <QStringList>

#include "graph/file/diff.h"

namespace kinegraph {

QStringList changes_in_words(const Diff& diff);  // "amount of transfer", "new node feet"

class ChangesDialog : public QDialog {
  Q_OBJECT

 public:
  ChangesDialog(const QString& title, const Diff& diff, QWidget* parent = nullptr);
};

}  // namespace kinegraph
