// All actions with their keys, and what the mouse does: a list that a few letters make shorter.
#pragma once
#include <QDialog>

#include "gui/look/theme.h"

class QLabel;
class QLineEdit;
class QTreeWidget;

namespace kinegraph {

class KeysDialog : public QDialog {
  Q_OBJECT

 public:
  KeysDialog(const Theme& theme, QWidget* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  void filter(const QString& letters);
  void show_whole_rows();

  QLineEdit* letters_;
  QTreeWidget* list_;
  QLabel* nothing_;
};

}  // namespace kinegraph
