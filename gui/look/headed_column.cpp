#include "gui/look/headed_column.h"

#include <QLabel>

namespace kinegraph {

QVBoxLayout* headed_column(QDialog& dialog, const QString& about) {
  auto* column = new QVBoxLayout(&dialog);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(10);
  auto* head = new QLabel(about, &dialog);
  QFont bold = head->font();
  bold.setBold(true);
  head->setFont(bold);
  column->addWidget(head);
  return column;
}

}  // namespace kinegraph
