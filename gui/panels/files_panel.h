// The Files dock: graphs opened before, examples, and the clips beside the graph. A graph opens, a clip
// becomes a Load by dragging it onto the canvas or by Enter.
#pragma once
#include <QTreeWidget>
#include <QWidget>
#include <map>

#include "gui/document/session.h"
#include "gui/look/theme.h"
#include "gui/panels/clip_walk.h"

class QLineEdit;

namespace kinegraph {

class FilesPanel : public QWidget {
  Q_OBJECT

 public:
  explicit FilesPanel(Session& session, QWidget* parent = nullptr);
  void set_theme(const Theme& theme);
  // Looks for clips again, on a thread of its own; the list shows what was found so far.
  void look();

 signals:
  void open_graph(const QString& path);
  void add_clip(const QString& path);

 private:
  void fill();
  QString clip_folder() const;
  Session& session_;
  const Theme* theme_;
  QLineEdit* filter_;
  QTreeWidget* tree_;
  ClipWalk* walk_;
  QString folder_;
  std::map<QString, QStringList> clips_;  // by folder, of those looked through
};

// Where the examples lie: beside the program or in its source tree; "" = nowhere.
QString examples_folder();

}  // namespace kinegraph
