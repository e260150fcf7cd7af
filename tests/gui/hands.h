// A person's hands on the editor's window for long tests: random but fitting gestures with mouse and keys,
// each drawn from a table. Nodes of the opened graph stay; those that the hands add come and go.
#pragma once
#include <QPointer>
#include <QTemporaryDir>
#include <QTimer>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gui/window/main_window.h"

class QAbstractButton;
class QSlider;
class QTableWidget;

namespace kinegraph::editor_test {

struct Hands {
  Hands(MainWindow& the_window, unsigned seed, QString the_folder);

  // Chance.
  int below(int count) { return int(random() % unsigned(count)); }
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[std::size_t(below(int(all.size())))];
  }
  // In an order of chance.
  template <class T>
  std::vector<T> shuffled(std::vector<T> all) {
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[std::size_t(below(int(i)))]);
    return all;
  }

  // Looking.
  Session& session() { return window.session(); }
  const Document& document() { return window.session().document(); }
  GraphCanvas& canvas() { return window.canvas(); }
  std::vector<std::string> own();  // nodes that the hands added
  std::vector<std::string> all();
  bool few() { return own().size() < 9; }
  QPoint title(const std::string& node);
  bool reaches(const std::string& node);  // nothing lies over its title
  bool reaches(const PortAt& port);
  bool is_empty(QPoint view);
  QPoint empty_place();
  std::vector<SceneWire> wires();

  // Doing.
  static void settle();
  void look_at_all();
  void give_clips();  // to the components again, where gestures took one away
  void key(int key, Qt::KeyboardModifiers keys = {});
  void type(const QString& text);
  void click(QWidget& widget, QPoint at, Qt::KeyboardModifiers keys = {});
  void double_click(QPoint view);
  void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = {});
  void drag_slider(QSlider& slider);
  bool choose(const std::string& node);  // by a click; false: it can't be reached
  bool choose_some(int least);           // own nodes, by Shift
  // Answers the dialog or menu that this gesture opens.
  void when_asked(std::function<void(QWidget&)> answer);
  void answer_file_dialog(const QString& path);
  bool choose_in_menu(QWidget& menu, const QString& starts_with);
  QString new_file(const char* ending);

  MainWindow& window;
  std::mt19937 random;
  std::set<std::string> given;  // nodes that were there at first
  QString folder;
  int files = 0;
  QPointer<QTimer> asking;
};

struct Gesture {
  const char* name;
  bool (*act)(Hands&);  // false: it had nothing to act on
  int steps = 1;        // of undo that it makes
};
std::vector<Gesture> canvas_gestures();
std::vector<Gesture> parameter_gestures();
std::vector<Gesture> dock_gestures();
std::vector<Gesture> all_gestures();

// A graph that has something for every gesture, with its clips, in a folder; gives the file's path.
QString graph_for_hands(const QString& folder);

}  // namespace kinegraph::editor_test
