// How the editor's dialogs begin.
#pragma once
#include <QDialog>
#include <QVBoxLayout>

namespace kinegraph {

// A dialog's column with its margins, and in bold what the dialog is about.
QVBoxLayout* headed_column(QDialog& dialog, const QString& about);

}  // namespace kinegraph
