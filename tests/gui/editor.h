// A real editor window for a test, moved with mouse and keys as a person would.
#pragma once
#include <QApplication>
#include <QLineEdit>
#include <QSlider>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <gtest/gtest.h>

#include <string>

#include "gui/window/main_window.h"
#include "nodes/all_nodes.h"

namespace kinegraph::editor_test {

struct Editor {
  Editor() {
    window.resize(1280, 800);
    window.show();
    QTest::qWaitForWindowExposed(&window);
    QApplication::setActiveWindow(&window);  // no window manager under Xvfb does it
    window.canvas().setFocus();
    settle();
  }
  GraphCanvas& canvas() { return window.canvas(); }
  Session& session() { return window.session(); }
  const Document& document() { return window.session().document(); }

  static void settle() { QTest::qWait(30); }
  bool wait_for_evaluation(int ms = 30000) {
    return QTest::qWaitFor([&] { return !window.is_evaluating(); }, ms);
  }

  void key(int key, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QWidget* widget = QApplication::focusWidget() ? QApplication::focusWidget() : &canvas();
    QTest::keyClick(widget, Qt::Key(key), keys);
    settle();
  }
  void type(const QString& text) {
    QWidget* popup = QApplication::activePopupWidget();
    QWidget* widget = QApplication::focusWidget();
    if (!widget && popup) widget = popup->focusWidget();
    ASSERT_TRUE(widget) << "nothing has the keyboard's focus";
    QTest::keyClicks(widget, text);
    settle();
  }
  // Tab, a few letters, Enter: the name of the node that came to be.
  std::string add(const QString& typed) {
    canvas().setFocus();
    key(Qt::Key_Tab);
    type(typed);
    key(Qt::Key_Return);
    return session().current();
  }
  QPoint port(const std::string& node, const std::string& name, bool input) {
    return canvas().to_view(canvas().scene().port_position({node, name, input})).toPoint();
  }
  QPoint middle(const std::string& node) {
    const QRectF box = canvas().scene().node(node)->rect;
    return canvas().to_view(QPointF(box.center().x(), box.top() + 14)).toPoint();
  }
  void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QTest::mousePress(&canvas(), Qt::LeftButton, keys, from);
    for (int i = 1; i <= 12; ++i) {
      const QPoint at = from + (to - from) * i / 12;
      QMouseEvent event(QEvent::MouseMove, at, canvas().mapToGlobal(at), Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(&canvas(), &event);
    }
    QTest::mouseRelease(&canvas(), Qt::LeftButton, keys, to);
    settle();
  }
  // Moves a node to a place of the graph by dragging its title.
  void drag_node(const std::string& node, QPointF to) {
    const QPointF by = to - canvas().scene().node(node)->rect.topLeft();
    drag(middle(node), middle(node) + (by * canvas().zoom()).toPoint());
  }
  std::size_t links(const std::string& node, const std::string& input) {
    const auto& inputs = document().nodes.at(node).inputs;
    auto found = inputs.find(input);
    return found == inputs.end() ? 0 : found->second.links.size();
  }

  QTemporaryDir folder;
  Registry registry = all_nodes();
  MainWindow window{registry, {.remember = false, .ask = false, .cache_folder = {}}};
};

}  // namespace kinegraph::editor_test
