// One open graph in the editor: its document with undo, its file, what is selected. Every dock reads and
// edits the graph through this and hears of changes from it; none knows another. Lives in the GUI thread and
// never computes.
#pragma once
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "graph/edit.h"
#include "graph/registry.h"

namespace kinegraph {

class Session : public QObject {
  Q_OBJECT

 public:
  // The registry outlives the session.
  explicit Session(const Registry& registry, QObject* parent = nullptr);
  ~Session() override;

  const Registry& registry() const { return registry_; }
  const Document& document() const { return document_; }
  const History& history() const { return history_; }
  bool is_read_only() const { return document_.read_only; }
  bool is_modified() const { return !history_.is_saved() || recovered_; }

  // The file, absolute; "" for a graph that was never saved. folder(): where its relative paths start.
  QString path() const { return path_; }
  QString folder() const;
  QString title() const;  // "sneaky_walk.kg.json", "untitled"
  // How the graph writes down a file: relative to its folder, but absolute where it lies in another tree.
  QString written_path(const QString& absolute) const;

  // Reading and writing. Problems that keep a file from opening leave the session as it was and are returned;
  // warnings of a file that opened are returned too. Saving throws Failure when it can't.
  Diagnostics open(const QString& path);
  Diagnostics open_text(const std::string& text, const QString& path);
  void clear();
  void save();
  void save_as(const QString& path);
  std::string text() const;  // canonical

  // Autosave: beside the file as .NAME.kg.json.autosave, in the state folder where that can't be written. An
  // autosave newer than the file is offered by autosave_found(); recover() takes it up as one undo step.
  QString autosave_path() const;
  bool autosave_found() const;
  Diagnostics recover();
  void discard_autosave();

  // Editing. `perform` runs a function that makes an Edit (graph/edit.h), applies it and keeps it for undo; a
  // Failure becomes refused(). Between begin_gesture and end_gesture all edits are one step (a drag).
  bool perform(const std::function<Edit(const Document&, const Registry&)>& make);
  void begin_gesture();
  void end_gesture();
  bool in_gesture() const { return gesture_; }
  bool can_undo() const { return history_.can_undo() && !is_read_only(); }
  bool can_redo() const { return history_.can_redo() && !is_read_only(); }
  void undo();
  void redo();

  // The structure's problems (graph/validate.h), kept up to date.
  const Diagnostics& problems() const { return problems_; }

  // Selection: names of nodes; the current one is what the parameter panel and viewer show.
  const std::set<std::string>& selected() const { return selected_; }
  const std::string& current() const { return current_; }
  void select(std::set<std::string> nodes, std::string current = {});

 signals:
  void changed();          // after every edit, undo, redo, open
  void meaning_changed();  // when more than `ui` changed: evaluation is due
  void file_changed();     // path or modified state
  void selection_changed();
  void problems_changed();
  void refused(const QString& message, const QString& hint);  // an edit was not possible

 private:
  void after(const Edit& edit);
  void check_meaning();
  void keep_selection_valid();
  void write_autosave();

  const Registry& registry_;
  Document document_;
  History history_;
  QString path_;
  bool gesture_ = false, gesture_started_ = false, recovered_ = false;
  Diagnostics problems_;
  std::set<std::string> selected_;
  std::string current_;
  QTimer autosave_;
};

}  // namespace kinegraph
