// How sentences of several lines are set: all of its lines about as long, so that no last word stands alone.
#pragma once
#include <QFontMetrics>
#include <QString>

class QMessageBox;

namespace kinegraph {

// The narrowest width at which `text` has as few lines as at `widest`.
int balanced_width(const QFontMetrics& metrics, const QString& text, int widest);

// Shows a question with its words set so; what was answered is asked of the box.
int ask(QMessageBox& box);

}  // namespace kinegraph
