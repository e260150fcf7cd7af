// A real editor window for a test, moved with mouse and keys as a person would.
#pragma once
#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QDialog>
#include <QLineEdit>
#include <QSlider>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <functional>
#include <string>

#include "gui/window/main_window.h"
#include "nodes/all_nodes.h"
#include "tests/gui/mouse.h"

namespace kinegraph::editor_test {

struct Editor {
  // `ask`: dialogs open as for a person, so that a test must answer them.
  explicit Editor(bool ask = false) : window(registry, {.remember = false, .ask = ask, .cache_folder = {}}) {
    window.resize(1280, 800);
    window.show();
    (void)QTest::qWaitForWindowExposed(&window);
    QApplication::setActiveWindow(&window);  // no window manager under Xvfb does it
    window.canvas().setFocus();
    settle();
  }
  GraphCanvas& canvas() { return window.canvas(); }
  Session& session() { return window.session(); }
  const Document& document() { return window.session().document(); }

  static void settle() { QTest::qWait(30); }
  // After a dialog the window is active again, which a window manager would see to.
  void come_back() {
    if (!QApplication::activeWindow() && !QApplication::activeModalWidget())
      QApplication::setActiveWindow(&window);
  }
  bool wait_for_evaluation(int ms = 30000) {
    return QTest::qWaitFor([&] { return !window.is_evaluating(); }, ms);
  }

  void key(int key, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    come_back();
    QWidget* widget = QApplication::focusWidget() ? QApplication::focusWidget() : &canvas();
    QTest::keyClick(widget, Qt::Key(key), keys);
    settle();
  }
  void type(const QString& text) {
    come_back();
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
    editor_test::drag(canvas(), from, to, {.keys = keys, .steps = 12});
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

  // The handle of a slider, dragged by so many pixels; `meanwhile` runs before the button is let go.
  void drag_slider(QSlider& slider, int pixels, const std::function<void()>& meanwhile = {}) {
    const QPoint from = handle_of(slider, slider.value());
    editor_test::drag(slider, from, from + QPoint(pixels, 0), {.meanwhile = meanwhile});
    settle();
  }

  // Keys for the dialog or menu that the next action opens: called once it is up. All must have been asked
  // by the end of the test.
  void when_asked(std::function<void(QWidget&)> answer) {
    auto* timer = new QTimer(&window);
    timer->setInterval(20);
    ++unasked;
    QObject::connect(timer, &QTimer::timeout, &window, [this, timer, answer = std::move(answer)] {
      QWidget* up = QApplication::activePopupWidget();
      if (!up) up = QApplication::activeModalWidget();
      if (!up || !up->isVisible()) return;
      timer->stop();
      timer->deleteLater();
      --unasked;
      answer(*up);
    });
    timer->start();
  }
  static void keys_to(QWidget& dialog, const QString& text, int last = Qt::Key_Return) {
    QWidget* widget = QApplication::focusWidget();
    if (!widget || (widget != &dialog && !dialog.isAncestorOf(widget))) widget = dialog.focusWidget();
    if (!widget) widget = &dialog;
    QTest::keyClicks(widget, text);
    QTest::keyClick(widget, Qt::Key(last));
  }
  // A file dialog gets a path, pasted, and Enter.
  void name_file(const QString& path) {
    when_asked([path](QWidget& dialog) {
      QApplication::clipboard()->setText(path);
      QWidget* line = dialog.focusWidget();
      QTest::keyClick(line, Qt::Key_A, Qt::ControlModifier);
      QTest::keyClick(line, Qt::Key_V, Qt::ControlModifier);
      QTest::keyClick(line, Qt::Key_Return);
    });
  }
  ~Editor() { EXPECT_EQ(unasked, 0) << "a dialog that should have come up never did"; }

  int unasked = 0;
  QTemporaryDir folder;
  Registry registry = all_nodes();
  MainWindow window;
};

}  // namespace kinegraph::editor_test
