// The open graph of the editor: its document with undo, its file, what is selected. Every dock reads and
// edits the graph through this and hears of changes from it; none knows another. Several graphs can be open,
// each a page of its own with its own undo; the session speaks for the one that is shown. Lives in the GUI
// thread and never computes.
#pragma once
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "graph/edit.h"
#include "graph/registry.h"
#include "gui/document/graph_file.h"

namespace kinegraph {

class Aside;
class AutosaveSlot;

class Session : public QObject {
  Q_OBJECT

 public:
  // The registry outlives the session.
  explicit Session(const Registry& registry, QObject* parent = nullptr);
  ~Session() override;

  const Registry& registry() const { return registry_; }
  const Document& document() const { return page_->document; }
  const History& history() const { return page_->history; }
  bool is_read_only() const { return page_->document.read_only; }
  bool is_modified() const { return is_page_modified(page()); }

  // The file, absolute; "" for a graph that was never saved. folder(): where its relative paths start.
  QString path() const { return page_->path; }
  QString folder() const;
  QString title() const;  // "sneaky_walk.kg.json", "untitled"
  // How the graph writes down a file: relative to its folder, but absolute where it lies in another tree.
  QString written_path(const QString& absolute) const;

  // Reading and writing. Problems that keep a file from opening leave the session as it was and are returned;
  // warnings of a file that opened are returned too. Saving throws Failure when it can't; into another folder
  // it rewrites relative paths, and absolute ones that lie near, so that they name the same files from there.
  // A path is read here and now: who mustn't wait reads the file elsewhere (gui/document/graph_file.h) and
  // gives what was read.
  Diagnostics open(const QString& path);
  Diagnostics open(GraphFile file);
  Diagnostics open_text(const std::string& text, const QString& path);
  void clear();
  void save();
  void save_as(const QString& path);
  std::string text() const;  // canonical
  // The file's text when it was last read or saved here; merging starts from it.
  const std::string& text_on_disk() const { return page_->text_on_disk; }
  void set_text_on_disk(std::string text) { page_->text_on_disk = std::move(text); }

  // Pages, in the order of their tabs. open_page() shows a file's page, and makes one where it has none.
  int pages() const { return int(pages_.size()); }
  int page() const;
  QString page_path(int page) const { return pages_[std::size_t(page)]->path; }
  QString page_title(int page) const;
  bool is_page_modified(int page) const;
  Diagnostics open_page(const QString& path);
  Diagnostics open_page(GraphFile file);
  bool show_page_of(const QString& path);  // false: it has none
  void new_page();                         // empty; the shown one where nothing was begun in it
  void show_page(int page);
  void close_page(int page);  // the last one becomes an empty graph
  // Files of open pages with unsaved changes that the shown graph uses, directly or deeper. Until they are
  // saved it is evaluated with what is open.
  std::vector<int> modified_inside() const;
  OpenGraphs modified_pages() const;
  // Graph files inside the shown graph, absolute. Those that changed on disk are read again by
  // reopen_inside(). They are read on another thread. What isn't there within a moment comes later, with
  // changed() and meaning_changed(); until then Graph nodes keep what they had.
  QStringList files_inside() const;
  void reopen_inside();
  bool is_reading_inside() const { return reading_ != nullptr; }
  void stop_reading_inside();

  // Autosave: beside the file as .NAME.kg.json.autosave, in the state folder where that can't be written; at
  // most two seconds behind the work. One newer than the file is what an ended session left: autosave_found()
  // tells of it, keep_found() puts it aside so that this session's own can't take its place, recover() takes
  // it up as one undo step, discard_found() throws it away.
  // Where another editor, or page, has the same graph open, each has an autosave of its own.
  QString autosave_path() const;
  bool is_open_elsewhere() const;
  bool autosave_found() const;
  void keep_found();
  Diagnostics recover();
  void discard_found();
  void discard_autosave();

  // Editing. `perform` runs a function that makes an Edit (graph/edit.h), applies it and keeps it for undo; a
  // Failure becomes refused(). Between begin_gesture and end_gesture all edits are one step (a drag).
  bool perform(const std::function<Edit(const Document&, const Registry&)>& make);
  void begin_gesture();
  // The same, but what follows belongs to the newest step: what was put there is now given its words.
  void continue_gesture();
  void end_gesture();
  bool in_gesture() const { return gesture_; }
  bool can_undo() const { return history().can_undo() && !is_read_only(); }
  bool can_redo() const { return history().can_redo() && !is_read_only(); }
  void undo();
  void redo();

  // The structure's problems (graph/validate.h), kept up to date.
  const Diagnostics& problems() const { return page_->problems; }

  // The file that was asked for last, if it can't be opened: all that is wrong with it. Forgotten once a
  // graph is opened.
  struct Refused {
    QString path;
    Diagnostics problems;
  };
  const Refused& refused_file() const { return refused_file_; }
  void refuse(const GraphFile& file);
  void forget_refused();

  // Selection: names of nodes; the current one is what the parameter panel and viewer show.
  const std::set<std::string>& selected() const { return page_->selected; }
  const std::string& current() const { return page_->current; }
  void select(std::set<std::string> nodes, std::string current = {});

 signals:
  void changed();          // after every edit, undo, redo, open
  void meaning_changed();  // when more than `ui` changed: evaluation is due
  void file_changed();     // path or modified state, or the pages
  void page_changed();     // another graph is shown: nothing known of the one before holds
  void selection_changed();
  void problems_changed();
  void reading_changed();                                     // is_reading_inside() is another
  void refused(const QString& message, const QString& hint);  // an edit was not possible

 private:
  struct Page {
    Page();
    ~Page();
    Document document;
    History history;
    QString path;
    std::string text_on_disk;
    std::unique_ptr<AutosaveSlot> slot;  // made when it is first asked for
    QString found;  // the autosave of an ended session, put aside; empty where there is none
    Diagnostics problems;
    std::set<std::string> selected;
    std::string current;
  };
  void after(const Edit& edit);
  void show(std::unique_ptr<Page> page);  // instead of the shown one
  void tell_of_page(bool inside_too = true);
  void check_meaning(bool inside_too = true);  // reads the graph files inside again, or leaves them
  void check_structure();
  void read_inside();
  void take_inside(const Document& read);
  void end_reading();
  void keep_selection_valid();
  bool write_autosave();
  AutosaveSlot& slot() const;

  const Registry& registry_;
  std::vector<std::unique_ptr<Page>> pages_;
  Page* page_;  // the shown one
  Refused refused_file_;
  bool gesture_ = false, gesture_started_ = false;
  QTimer autosave_;
  std::unique_ptr<Aside> reading_;               // of the graphs inside the shown one
  std::vector<std::unique_ptr<Aside>> stopped_;  // readings on their way to their end
  int readings_ = 0;
};

}  // namespace kinegraph
