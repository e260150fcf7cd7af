// The node canvas: shows a session's graph and edits it by mouse and keyboard. Pans and zooms by drawing
// pictures of nodes; evaluates nothing.
#pragma once
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "gui/canvas/canvas_gesture.h"
#include "gui/canvas/graph_scene.h"
#include "gui/canvas/node_pixmaps.h"
#include "gui/canvas/search_box.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"

class QMenu;
class QPlainTextEdit;

namespace kinegraph {

class GraphCanvas : public QWidget {
  Q_OBJECT

 public:
  GraphCanvas(Session& session, Evaluation& evaluation, QWidget* parent = nullptr);
  ~GraphCanvas() override;

  void set_theme(const Theme& theme);
  const Theme& theme() const { return *theme_; }
  Session& session() { return session_; }
  const Evaluation& evaluation() const { return evaluation_; }
  const GraphScene& scene() const { return scene_; }
  GraphScene& scene() { return scene_; }

  // The view. Graph units to pixels of the widget and back.
  double zoom() const { return zoom_; }
  QPointF to_view(QPointF graph) const { return graph * zoom_ + pan_; }
  QPointF to_graph(QPointF view) const { return (view - pan_) / zoom_; }
  void pan_by(QPointF pixels);
  void zoom_at(QPointF view, int steps);
  void show_rect(QRectF graph);  // as large as fits, at most at zoom 1
  void make_visible(const std::string& node);

  // Selected frames and notes; nodes are selected in the session.
  const std::set<std::string>& selected_frames() const { return selected_frames_; }
  const std::set<std::string>& selected_notes() const { return selected_notes_; }
  void select_decor(std::set<std::string> frames, std::set<std::string> notes);

  // What a gesture shows of itself.
  std::optional<PortAt> hovered_port() const { return hover_; }
  void set_hint(const QString& text, QPointF view, bool refused);  // "" = none
  void begin(std::unique_ptr<CanvasGesture> gesture);
  bool give_up_gesture();  // false: none was under way
  void rebuild();

  // Search-to-add at a place; with a port only what fits it, and it is linked.
  void search_to_add(QPointF graph, std::optional<PortAt> port = {});
  std::string add(const std::string& type, QPointF graph, std::optional<PortAt> port = {},
                  std::map<std::string, Json> params = {});

 public slots:
  // What the menus and keys do. Each works on the selection.
  void add_by_search();
  void find_node();
  void remove_selected();
  void copy_selected();
  void cut_selected();
  void paste();
  void duplicate();
  void toggle_enabled();
  void choose_color();
  void add_note();
  void group_in_frame();
  void arrange();
  void frame_selected();
  void frame_all();
  void rename_selected();
  void link_by_search();  // from the current node's outputs
  void select_all();
  void take_out_selected();
  void walk(int dx, int dy);   // to a neighbour along wires, or up and down among siblings
  void nudge(int dx, int dy);  // moves the selection by steps

 signals:
  void hovered_text(const QString& text);   // for the status bar
  void opened_inside(const QString& node);  // a Graph node was double-clicked
  void file_dropped(const QString& path);   // a graph: to be opened

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QPointF free_place(QPointF graph) const;
  void moving();  // the view moves: draw coarsely until it rests
  void paint_grid(QPainter& painter);
  void paint_frames(QPainter& painter);
  void paint_wires(QPainter& painter, const QRectF& seen);
  void paint_nodes(QPainter& painter, const QRectF& seen);
  void paint_mini_map(QPainter& painter);
  void paint_hint(QPainter& painter);
  QRectF mini_map_rect() const;  // null when there is nothing to overlook
  QPointF mini_map_to_graph(QPointF view) const;
  std::optional<Severity> problem_of(const std::string& node) const;
  void find_problems();
  void hover(QPointF view);
  QPointF pointer() const;  // in the graph; the middle of the view where the mouse is elsewhere
  std::vector<std::string> selection() const;
  void edit_text(QRectF graph, const QString& text, std::function<void(const QString&)> done);
  bool is_hovered(const SceneWire& wire) const;
  void cut_wire(const SceneWire& wire);
  void put_dot(const SceneWire& wire, QPointF at);
  void fill_menu_of_node(QMenu& menu, const SceneNode& node);
  QString tool_tip(QPointF view) const;
  QString port_words(const PortAt& port) const;
  QString wire_words(const SceneWire& wire) const;
  QString port_tip(const PortAt& port) const;
  QString wire_tip(const SceneWire& wire) const;
  QString node_tip(const SceneNode& node) const;
  void press_left(QMouseEvent* event, QPointF at);

  Session& session_;
  Evaluation& evaluation_;
  const Theme* theme_;
  GraphScene scene_;
  NodePixmaps pixmaps_;
  std::set<std::string> expanded_;
  std::map<std::string, Severity> problems_;
  QPointF pan_;
  double zoom_ = 1;
  int zoom_step_ = 0;
  double wheel_left_ = 0;
  bool resting_ = true, space_ = false, framed_once_ = false;
  QTimer rest_, states_due_;
  std::unique_ptr<CanvasGesture> gesture_;
  Qt::MouseButton held_ = Qt::NoButton;  // by the gesture
  std::optional<PortAt> hover_;
  std::string hover_node_;
  std::optional<PortAt> hover_wire_;  // by the input that it ends at
  std::size_t hover_index_ = 0;       // among the links of that input
  std::set<std::string> selected_frames_, selected_notes_;
  QString hint_;
  QPointF hint_at_;
  bool hint_refused_ = false;
  SearchBox* search_;
  QPointer<QPlainTextEdit> text_edit_;
};

}  // namespace kinegraph
