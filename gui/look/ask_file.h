// File dialogs: the system's own where there is one, else Qt's, wide enough to read names and dates.
#pragma once
#include <QString>

class QWidget;

namespace kinegraph {

// Each gives an empty path where nothing was chosen. `start`: a folder, or a file that is chosen at first.
QString ask_to_open(QWidget* parent, const QString& title, const QString& start, const QString& filter = {});
QString ask_where_to_save(QWidget* parent, const QString& title, const QString& start,
                          const QString& filter = {});
QString ask_for_folder(QWidget* parent, const QString& title, const QString& start);

}  // namespace kinegraph
