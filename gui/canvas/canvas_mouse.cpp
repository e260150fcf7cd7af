// What mouse, wheel and dropped files begin on the canvas.
#include <QDir>
#include <QFileInfo>
#include <QHelpEvent>
#include <QMenu>
#include <QMimeData>
#include <QMouseEvent>
#include <QTimer>
#include <QToolTip>
#include <QUrl>
#include <cmath>

#include "graph/nested.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/canvas/graph_canvas.h"
#include "gui/look/actions.h"

namespace kinegraph {
namespace {

constexpr double port_reach = 12;  // pixels
constexpr int hint_ms = 4000;

}  // namespace

void GraphCanvas::press_left(QMouseEvent* event, QPointF at) {
  const QPointF view = event->position();
  const Qt::KeyboardModifiers keys = event->modifiers();
  if (const QRectF map = mini_map_rect(); !map.isNull() && map.contains(view)) {
    pan_ += QRectF(rect()).center() - to_view(mini_map_to_graph(view));
    moving();
    return;
  }
  if (space_) return begin(pan_gesture(*this, view));
  const double reach = port_reach / std::max(zoom_, 0.4);
  const auto port = scene_.port_at(at, reach);
  const SceneNode* node = scene_.node_at(at);
  // A small dot is all port: its middle moves it, its right edge starts a wire.
  const bool on_dot = node && node->dot && std::abs(at.x() - node->rect.center().x()) < 6;
  if (port && !on_dot && !(keys & (Qt::ControlModifier | Qt::AltModifier)))
    return begin(wire_gesture(*this, *port));
  if (node) {
    if (node->expandable && zoom_ >= 0.6 && node->more.contains(at - node->rect.topLeft()) && !keys) {
      if (!expanded_.erase(node->name)) expanded_.insert(node->name);
      rebuild();
      return;
    }
    std::set<std::string> chosen = session_.selected();
    const std::string name = node->name;
    if (keys & (Qt::ShiftModifier | Qt::ControlModifier)) {
      if (chosen.erase(name) == 0) chosen.insert(name);
      session_.select(chosen, chosen.count(name) ? name : std::string());
      return;
    }
    const bool take_out = keys & Qt::AltModifier;
    if (take_out || !chosen.count(name)) chosen = {name};
    session_.select(chosen, name);
    if (chosen.size() == 1) select_decor({}, {});
    begin(move_gesture(*this, view, chosen, take_out ? std::set<std::string>() : selected_notes_, take_out));
    return;
  }
  if (const SceneNote* note = scene_.note_at(at)) {
    const std::string name = note->name;
    const QPointF corner = note->rect.bottomRight() - at;
    if (!selected_notes_.count(name)) {
      session_.select({});
      select_decor({}, {name});
    }
    if (corner.x() < 14 && corner.y() < 14) return begin(resize_note_gesture(*this, view, name));
    return begin(move_gesture(*this, view, session_.selected(), selected_notes_, false));
  }
  if (const SceneWire* wire = scene_.wire_at(at, 6 / zoom_); wire && (keys & Qt::ControlModifier)) {
    put_dot(*wire, at);
    return;
  }
  if (keys & Qt::ControlModifier) return begin(cut_gesture(*this, view));
  if (const SceneFrame* frame = scene_.frame_title_at(at)) {
    std::set<std::string> inside(frame->nodes.begin(), frame->nodes.end());
    const std::string name = frame->name;
    session_.select(inside);
    select_decor({name}, {});
    return begin(move_gesture(*this, view, inside, {}, false));
  }
  begin(box_select_gesture(*this, view, keys & Qt::ShiftModifier));
}

void GraphCanvas::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  search_->cancel();
  if (gesture_) return;
  hover_.reset();
  held_ = event->button();
  if (event->button() == Qt::MiddleButton)
    begin(pan_gesture(*this, event->position()));
  else if (event->button() == Qt::LeftButton)
    press_left(event, to_graph(event->position()));
}

void GraphCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (gesture_) {
    gesture_->move(event->position());
    setCursor(gesture_->cursor());
    return;
  }
  if ((event->buttons() & Qt::LeftButton) && !mini_map_rect().isNull() &&
      mini_map_rect().contains(event->position())) {
    pan_ += QRectF(rect()).center() - to_view(mini_map_to_graph(event->position()));
    moving();
    return;
  }
  hover(event->position());
}

void GraphCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (!gesture_ || event->button() != held_) return;
  const auto gesture = std::move(gesture_);
  gesture->release(event->position());
  unsetCursor();
  hover(event->position());
  update();
}

void GraphCanvas::hover(QPointF view) {
  const QPointF at = to_graph(view);
  const auto port = scene_.port_at(at, port_reach / std::max(zoom_, 0.4));
  const SceneNode* node = port ? nullptr : scene_.node_at(at);
  const SceneWire* wire = port || node ? nullptr : scene_.wire_at(at, 6 / zoom_);
  const std::string over = node ? node->name : std::string();
  const auto end = wire ? std::optional(PortAt{wire->to, wire->to_port, true}) : std::nullopt;
  const std::size_t index = wire ? wire->index : 0;
  if (port != hover_ || over != hover_node_ || end != hover_wire_ || index != hover_index_) {
    hover_ = port;
    hover_node_ = over;
    hover_wire_ = end;
    hover_index_ = index;
    setCursor(space_ ? Qt::OpenHandCursor : hover_ ? Qt::CrossCursor : Qt::ArrowCursor);
    update();
  }
  emit hovered_text(hover_ ? port_words(*hover_) : wire ? wire_words(*wire) : QString());
}

bool GraphCanvas::is_hovered(const SceneWire& wire) const {
  return hover_wire_ && !gesture_ && wire.to == hover_wire_->node && wire.to_port == hover_wire_->port &&
         wire.index == hover_index_;
}

void GraphCanvas::put_dot(const SceneWire& wire, QPointF at) {
  const SceneWire on = wire;
  session_.perform([&](const Document& document, const Registry& registry) {
    std::string name;
    std::vector<EditStep> steps{[&](const Document& d, const Registry& r) {
                                  return add_new_node(d, r, {"Dot", at - QPointF(10, 10), {}, {}}, &name);
                                },
                                [&](const Document& d, const Registry& r) {
                                  return insert_on_link(d, r, name, on.to, on.to_port, on.index);
                                }};
    return one_after_another(document, registry, "Add a dot", steps);
  });
}

void GraphCanvas::cut_wire(const SceneWire& wire) {
  const SceneWire on = wire;
  session_.perform([&](const Document& d, const Registry& r) {
    return kinegraph::disconnect(d, r, on.to, on.to_port, on.index);
  });
}

void GraphCanvas::leaveEvent(QEvent*) {
  hover_.reset();
  hover_node_.clear();
  hover_wire_.reset();
  emit hovered_text({});
  update();
}

void GraphCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  gesture_.reset();
  unsetCursor();
  const QPointF at = to_graph(event->position());
  if (const SceneNode* node = scene_.node_at(at)) {
    const std::string name = node->name;
    session_.select({name}, name);
    if (session_.document().nodes.at(name).nested)
      emit opened_inside(QString::fromStdString(name));
    else
      rename_selected();
    return;
  }
  if (const SceneNote* note = scene_.note_at(at)) {
    const std::string name = note->name;
    edit_text(note->rect, note->text, [this, name](const QString& text) {
      session_.perform([&](const Document& d, const Registry&) { return set_note_text(d, name, text); });
    });
    return;
  }
  if (const SceneFrame* frame = scene_.frame_title_at(at)) {
    const std::string name = frame->name;
    edit_text(frame->title_bar, frame->title, [this, name](const QString& text) {
      session_.perform([&](const Document& d, const Registry&) { return set_frame_title(d, name, text); });
    });
    return;
  }
  search_to_add(at);
}

void GraphCanvas::wheelEvent(QWheelEvent* event) {
  search_->cancel();
  if (event->modifiers() & Qt::ShiftModifier) {
    pan_by(QPointF(event->angleDelta().y() + event->angleDelta().x(), 0) * 0.5);
    return;
  }
  wheel_left_ += event->angleDelta().y() / 120.0;
  const int steps = int(wheel_left_);
  wheel_left_ -= steps;
  if (steps) zoom_at(event->position(), steps);
  event->accept();
}

void GraphCanvas::contextMenuEvent(QContextMenuEvent* event) {
  if (gesture_) return;
  const QPointF at =
      to_graph(event->reason() == QContextMenuEvent::Mouse ? QPointF(event->pos()) : QRectF(rect()).center());
  const SceneNode* node =
      event->reason() == QContextMenuEvent::Mouse ? scene_.node_at(at) : scene_.node(session_.current());
  const bool by_mouse = event->reason() == QContextMenuEvent::Mouse;
  const SceneNote* note = node || !by_mouse ? nullptr : scene_.note_at(at);
  const SceneWire* wire = node || note || !by_mouse ? nullptr : scene_.wire_at(at, 6 / zoom_);
  const SceneFrame* frame = node || note || wire || !by_mouse ? nullptr : scene_.frame_title_at(at);
  QMenu menu(this);
  if (node) {
    fill_menu_of_node(menu, *node);
  } else if (note) {
    session_.select({});
    select_decor({}, {note->name});
    menu.addAction(menu_text("delete"), this, &GraphCanvas::remove_selected);
  } else if (wire) {
    const SceneWire on = *wire;
    menu.addAction(tr("Put a dot here") + "\t" + tr("Ctrl+click"), this, [this, on, at] { put_dot(on, at); });
    menu.addAction(tr("Cut this link") + "\t" + tr("Ctrl+drag"), this, [this, on] { cut_wire(on); });
  } else if (frame) {
    const std::string name = frame->name;
    session_.select({});
    select_decor({name}, {});
    menu.addAction(tr("Remove the frame"), this, &GraphCanvas::remove_selected);
  } else {
    menu.addAction(tr("Add a node…") + "\t" + tr("Tab"), this, [this, at] { search_to_add(at); });
    menu.addAction(tr("Add a note") + "\t" + tr("N"), this, &GraphCanvas::add_note);
    menu.addAction(menu_text("paste"), this, &GraphCanvas::paste);
    menu.addSeparator();
    menu.addAction(menu_text("arrange"), this, &GraphCanvas::arrange);
    menu.addAction(menu_text("frame_all"), this, &GraphCanvas::frame_all);
  }
  menu.exec(event->globalPos());
}

void GraphCanvas::fill_menu_of_node(QMenu& menu, const SceneNode& node) {
  const std::string name = node.name;
  if (!session_.selected().count(name)) session_.select({name}, name);
  menu.addAction((node.enabled ? tr("Disable") : tr("Enable")) + "\t" + tr("D"), this,
                 &GraphCanvas::toggle_enabled);
  menu.addAction(menu_text("rename"), this, &GraphCanvas::rename_selected);
  menu.addAction(menu_text("color"), this, &GraphCanvas::choose_color);
  menu.addAction(tr("Link from here…") + "\t" + tr("L"), this, &GraphCanvas::link_by_search);
  menu.addAction(menu_text("take_out"), this, &GraphCanvas::take_out_selected);
  menu.addAction(menu_text("group"), this, &GraphCanvas::group_in_frame);
  if (session_.document().nodes.at(name).nested)
    menu.addAction(tr("Open its graph") + "\t" + tr("Ctrl+Return"), this,
                   [this, name] { emit opened_inside(QString::fromStdString(name)); });
  menu.addSeparator();
  menu.addAction(menu_text("cut"), this, &GraphCanvas::cut_selected);
  menu.addAction(menu_text("copy"), this, &GraphCanvas::copy_selected);
  menu.addAction(menu_text("duplicate"), this, &GraphCanvas::duplicate);
  menu.addAction(menu_text("delete"), this, &GraphCanvas::remove_selected);
}

void GraphCanvas::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

// Says what letting go would do.
void GraphCanvas::dragMoveEvent(QDragMoveEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (urls.isEmpty()) return;
  event->acceptProposedAction();
  const QFileInfo first(urls.first().toLocalFile());
  const bool folder = first.isDir();
  set_hint(folder                                  ? tr("A folder is no clip: drop files.")
           : first.fileName().endsWith(".kg.json") ? tr("Opens %1").arg(first.fileName())
           : urls.size() > 1                       ? tr("Adds a Load for each of %1 files").arg(urls.size())
                                                   : tr("Adds a Load of %1").arg(first.fileName()),
           event->position(), folder);
}

void GraphCanvas::dragLeaveEvent(QDragLeaveEvent*) {
  set_hint({}, {}, false);
}

void GraphCanvas::dropEvent(QDropEvent* event) {
  set_hint({}, {}, false);
  QPointF at = to_graph(event->position());
  for (const QUrl& url : event->mimeData()->urls()) {
    const QString path = url.toLocalFile();
    if (path.isEmpty()) continue;
    if (path.endsWith(".kg.json")) {
      emit file_dropped(path);
      return;
    }
    if (QFileInfo(path).isDir()) {
      set_hint(tr("A folder is no clip: drop files, or add the folder in the Files dock."), event->position(),
               true);
      QTimer::singleShot(hint_ms, this, [this] { set_hint({}, {}, false); });
      continue;
    }
    add("Load", at, {}, {{"file", Json(session_.written_path(path).toStdString())}});
    at += QPointF(0, 140);
  }
  event->acceptProposedAction();
}

bool GraphCanvas::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), tool_tip(help->pos()), this);
    return true;
  }
  // Tab adds a node here and doesn't leave the canvas; Ctrl+Tab and Shift+Tab do.
  if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Tab &&
      static_cast<QKeyEvent*>(event)->modifiers() == Qt::NoModifier) {
    add_by_search();
    return true;
  }
  return QWidget::event(event);
}

void GraphCanvas::keyPressEvent(QKeyEvent* event) {
  const bool control = event->modifiers() & Qt::ControlModifier;
  switch (event->key()) {
    case Qt::Key_Escape:
      if (!give_up_gesture()) {
        session_.select({});
        select_decor({}, {});
      }
      return;
    case Qt::Key_Space:
      if (event->isAutoRepeat()) return;
      space_ = true;
      setCursor(Qt::OpenHandCursor);
      return;
    case Qt::Key_Left:
      return control ? nudge(-1, 0) : walk(-1, 0);
    case Qt::Key_Right:
      return control ? nudge(1, 0) : walk(1, 0);
    case Qt::Key_Up:
      return control ? nudge(0, -1) : walk(0, -1);
    case Qt::Key_Down:
      return control ? nudge(0, 1) : walk(0, 1);
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoom_at(QRectF(rect()).center(), 1);
    case Qt::Key_Minus:
      return zoom_at(QRectF(rect()).center(), -1);
    default:
      QWidget::keyPressEvent(event);
  }
}

void GraphCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) {
    space_ = false;
    unsetCursor();
  }
  QWidget::keyReleaseEvent(event);
}

}  // namespace kinegraph
