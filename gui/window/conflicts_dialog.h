// Where two people changed the same: each side's value in a table, and a choice of one for each row.
#pragma once
#include <QDialog>
#include <vector>

#include "graph/file/merge.h"

class QRadioButton;

namespace kinegraph {

class ConflictsDialog : public QDialog {
  Q_OBJECT

 public:
  // `ours` and `theirs`: the merged graph with one or the other side's wherever they conflict.
  ConflictsDialog(const QString& title, const std::vector<MergeConflict>& conflicts, const Document& ours,
                  const Document& theirs, QWidget* parent = nullptr);
  // Units of which theirs was chosen.
  std::vector<Unit> chosen() const;

 private:
  std::vector<std::pair<Unit, QRadioButton*>> rows_;
};

}  // namespace kinegraph
