// Finds files that a graph reads and that aren't there, by name and content, and links the nodes to what was
// found, as one undo step.
#pragma once
#include <QDialog>
#include <memory>
#include <string>
#include <vector>

#include "gui/document/known_files.h"
#include "gui/document/session.h"
#include "gui/window/file_search.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace kinegraph {

struct MissingFile {
  std::string node, param;
  QString path;  // absolute
};
// Of the shown graph's own nodes.
std::vector<MissingFile> missing_files(const Session& session);

class RelinkDialog : public QDialog {
  Q_OBJECT

 public:
  RelinkDialog(Session& session, const KnownFiles& known, std::vector<MissingFile> missing,
               QWidget* parent = nullptr);

  void accept() override;
  void search(const QStringList& folders);  // instead of what is looked through now

 private:
  void add_found(int row, const QString& path, bool same);
  void update_state();

  Session& session_;
  const KnownFiles& known_;
  std::vector<MissingFile> missing_;
  std::unique_ptr<FileSearch> search_;
  QTableWidget* table_;
  std::vector<QComboBox*> choices_;
  QLabel* state_;
  int files_ = 0;  // looked at so far
  QProgressBar* progress_;
  QPushButton *stop_, *relink_;
};

}  // namespace kinegraph
