// The Problems dock: everything that is wrong or worth knowing, of the graph's structure and of its
// evaluation. A click goes to the node; the hint says what to do.
#pragma once
#include <QTreeWidget>
#include <QWidget>

#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"

class QLabel;

namespace kinegraph {

class ProblemsPanel : public QWidget {
  Q_OBJECT

 public:
  ProblemsPanel(Session& session, Evaluation& evaluation, QWidget* parent = nullptr);
  void set_theme(const Theme& theme);

 signals:
  void go_to(const QString& node);
  void counted(int errors, int warnings);

 private:
  struct Row {
    Severity severity = Severity::error;
    QString where, what, advice, file, node;  // `file`: the whole path of one that can't be opened
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> rows() const;
  void fill();
  Session& session_;
  Evaluation& evaluation_;
  const Theme* theme_;
  QTreeWidget* list_;
  QLabel* none_;
  QTimer due_;
  std::vector<Row> shown_;
};

}  // namespace kinegraph
