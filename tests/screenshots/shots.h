// A window of the editor that pictures are taken of: opened on a graph, waited for, written as PNG.
#pragma once
#include <QApplication>
#include <QContextMenuEvent>
#include <QDialog>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <functional>

#include "gui/viewer/viewer.h"
#include "gui/window/main_window.h"
#include "gui/window/screenshot.h"
#include "nodes/all_nodes.h"
#include "tests/places.h"

namespace kinegraph::shots {

struct Shot {
  Shot(const Theme& theme, const QDir& into, QSize size = {1280, 800}, bool remember = false)
      : window(registry, {.remember = remember, .ask = true, .cache_folder = {}}), into_(into) {
    window.set_theme(theme);
    window.resize(size);
    window.show();
    if (!QTest::qWaitForWindowExposed(&window)) qFatal("the window is not shown");
    QApplication::setActiveWindow(&window);
    window.resize(size);
    window.canvas().setFocus();
    wait();
  }
  ~Shot() { window.session().discard_autosave(); }

  Session& session() { return window.session(); }
  GraphCanvas& canvas() { return window.canvas(); }
  Viewer& viewer() { return *window.findChild<Viewer*>(); }

  static QString example(const QString& name) {
    return QString::fromStdString(source_folder()) + "/graphs/" + name + ".kg.json";
  }
  void open(const QString& name) {
    window.open(example(name));
    wait();
  }
  // Two folders deep, so that what looks around doesn't find all of the system's scratch files.
  QString in_shot(const QString& name) {
    QDir(folder.path()).mkpath("show/shot");
    return folder.filePath("show/shot/" + name);
  }
  // A graph written down here, in a folder of its own beside the sample clips.
  QString text(const QByteArray& nodes, const QByteArray& rest = {}) {
    for (const char* beside : {"clips", "characters"})
      QFile::link(QString::fromStdString(source_folder()) + "/graphs/" + beside, in_shot(beside));
    const QString path = in_shot("example.kg.json");
    QFile file(path);
    if (file.open(QIODevice::WriteOnly))
      file.write("{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {" + nodes + "}" + rest + "}\n");
    file.close();
    window.open(path);
    wait();
    return path;
  }
  void select(const std::string& node) {
    session().select({node}, node);
    wait();
  }
  void dock(const QString& name) {
    window.show_dock(name);
    wait();
  }
  void wait(int quiet_ms = 400) { wait_until_drawn(window, quiet_ms); }
  void take(const QString& name) { take_widget(name, &window); }
  void take_dock(const QString& name, const QString& title) {
    dock(title);
    take_widget(name, window.findChild<QWidget*>("dock_" + title.toLower()));
  }
  void take_canvas(const QString& name) {
    canvas().frame_all();
    wait(250);
    take_widget(name, &canvas());
  }
  void take_widget(const QString& name, QWidget* widget) {
    const QString path = into_.filePath(name + ".png");
    if (!widget || !widget->grab().save(path)) qFatal("can't write %s", qPrintable(path));
    std::printf("%s\n", qPrintable(name));
    std::fflush(stdout);
  }
  // Of the dialog or menu that `open` brings up, which is closed again.
  void take_popup(const QString& name, const std::function<void()>& open, int after_ms = 700) {
    bool taken = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
      QWidget* popup = QApplication::activePopupWidget();
      QWidget* shown = popup ? popup : QApplication::activeModalWidget();
      if (!shown) return;
      if (!taken) take_widget(name, shown);
      taken = true;
      if (auto* dialog = qobject_cast<QDialog*>(shown))
        dialog->reject();
      else
        shown->close();
    });
    timer.start(after_ms);
    open();
    QElapsedTimer clock;
    for (clock.start(); !taken && clock.elapsed() < after_ms + 3000;)
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    if (!taken) qWarning("nothing came up for %s", qPrintable(name));
    wait(100);
  }
  void take_menu_at(const QString& name, QPoint view) {
    take_popup(name, [&] {
      QContextMenuEvent event(QContextMenuEvent::Mouse, view, canvas().mapToGlobal(view));
      QApplication::sendEvent(&canvas(), &event);
    });
  }
  QPoint view_of(const std::string& node) {
    const QRectF box = canvas().scene().node(node)->rect;
    return canvas().to_view(QPointF(box.center().x(), box.top() + 14)).toPoint();
  }
  void press(Qt::Key key, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QWidget* at = QApplication::focusWidget() ? QApplication::focusWidget() : &canvas();
    QTest::keyClick(at, key, keys);
    wait(150);
  }
  void type(const QString& letters) {
    if (QApplication::focusWidget()) QTest::keyClicks(QApplication::focusWidget(), letters);
    wait(150);
  }
  QPoint port(const std::string& node, const std::string& name, bool input) {
    return canvas().to_view(canvas().scene().port_position({node, name, input})).toPoint();
  }
  // Presses at one place of the canvas and moves to another, without letting go.
  void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QTest::mousePress(&canvas(), Qt::LeftButton, keys, from);
    for (int i = 1; i <= 10; ++i) {
      const QPoint at = from + (to - from) * i / 10;
      QMouseEvent event(QEvent::MouseMove, at, canvas().mapToGlobal(at), Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(&canvas(), &event);
    }
    wait(150);
  }

  QTemporaryDir folder;
  Registry registry = all_nodes();
  MainWindow window;

 private:
  QDir into_;
};

// Into the folder, with names that end in `end`.
void graph_pictures(const Theme& theme, const QDir& into, const QString& end);
void viewer_pictures(const Theme& theme, const QDir& into, const QString& end);
void stage_pictures(const Theme& theme, const QDir& into, const QString& end);
void dock_pictures(const Theme& theme, const QDir& into, const QString& end);
void menu_pictures(const Theme& theme, const QDir& into, const QString& end);
void message_pictures(const Theme& theme, const QDir& into, const QString& end);
void file_pictures(const Theme& theme, const QDir& into, const QString& end);

}  // namespace kinegraph::shots
