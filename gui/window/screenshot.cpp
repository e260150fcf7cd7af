#include "gui/window/screenshot.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>

namespace kinegraph {
namespace {

constexpr int settle_ms = 700;  // quiet time after which nothing more is expected
constexpr int patience_ms = 60000;

}  // namespace

bool take_screenshot(MainWindow& window, const QString& file, QSize size) {
  window.resize(size);
  window.show();
  window.canvas().frame_all();
  window.evaluate();
  QElapsedTimer all, quiet;
  all.start();
  quiet.start();
  while (all.elapsed() < patience_ms && quiet.elapsed() < settle_ms) {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    if (window.is_evaluating()) quiet.restart();
  }
  if (!window.session().current().empty()) window.canvas().make_visible(window.session().current());
  QApplication::processEvents(QEventLoop::AllEvents, 200);
  return window.grab().save(file);
}

}  // namespace kinegraph
