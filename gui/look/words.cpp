#include "gui/look/words.h"

#include <QGridLayout>
#include <QLabel>
#include <QMessageBox>
#include <algorithm>

namespace kinegraph {
namespace {

constexpr int widest_message = 420, narrowest_message = 300;

QSize taken(const QFontMetrics& metrics, const QString& text, int width) {
  return metrics.boundingRect(QRect(0, 0, width, 1 << 20), Qt::TextWordWrap, text).size();
}

}  // namespace

int balanced_width(const QFontMetrics& metrics, const QString& text, int widest) {
  const int high = taken(metrics, text, widest).height();
  int too_narrow = 0, wide_enough = widest;
  while (wide_enough - too_narrow > 1) {
    const int middle = (too_narrow + wide_enough) / 2;
    const QSize size = taken(metrics, text, middle);
    (size.height() > high || size.width() > middle ? too_narrow : wide_enough) = middle;
  }
  return wide_enough;
}

int ask(QMessageBox& box) {
  for (QLabel* label : box.findChildren<QLabel*>()) label->setTextFormat(Qt::PlainText);
  if (auto* words = box.findChild<QLabel*>("qt_msgbox_informativelabel")) {
    words->ensurePolished();
    const QFontMetrics metrics = words->fontMetrics();
    QStringList lines = words->text().split('\n');
    int width = narrowest_message;
    for (const QString& line : lines) width = std::max(width, balanced_width(metrics, line, widest_message));
    // A shorter paragraph isn't set by its own width: its last two words stay together.
    for (QString& line : lines)
      if (const qsizetype space = line.lastIndexOf(' '); space > 0 && metrics.horizontalAdvance(line) > width)
        line[space] = QChar::Nbsp;
    words->setText(lines.join('\n'));
    words->setFixedWidth(width + 4);
    if (auto* grid = qobject_cast<QGridLayout*>(box.layout())) {
      grid->setAlignment(words, Qt::AlignLeft);
      grid->setContentsMargins(16, 14, 16, 14);
    }
  }
  return box.exec();
}

}  // namespace kinegraph
