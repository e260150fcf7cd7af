#include "gui/window/screenshot.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QThread>

#include "gui/viewer/picture_maker.h"
#include "gui/viewer/viewer.h"

namespace kinegraph {
namespace {

constexpr int patience_ms = 60000, rest_ms = 2;

}  // namespace

void wait_until_drawn(MainWindow& window, int settle_ms) {
  QElapsedTimer all, quiet;
  all.start();
  quiet.start();
  // Evaluation has the lower priority: a loop without rest would take its time away.
  const auto pass = [&] {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    QThread::msleep(rest_ms);
  };
  const QList<Viewer*> viewers = window.findChildren<Viewer*>();
  while (all.elapsed() < patience_ms && quiet.elapsed() < settle_ms) {
    pass();
    bool busy = window.is_evaluating();
    for (Viewer* viewer : viewers) busy |= viewer->motions().is_busy();
    if (busy) quiet.restart();
  }
  // What plays by itself is never at rest: two more pictures of it are enough.
  for (const PictureMaker* maker : window.findChildren<PictureMaker*>()) {
    const int before = maker->drawn();
    while (all.elapsed() < patience_ms && maker->is_busy() && maker->drawn() < before + 2) pass();
  }
  pass();
}

bool take_screenshot(MainWindow& window, const QString& file, QSize size) {
  window.resize(size);
  window.show();
  window.canvas().frame_all();
  window.evaluate();
  wait_until_drawn(window);
  if (!window.session().current().empty()) window.canvas().make_visible(window.session().current());
  wait_until_drawn(window, 250);
  return window.grab().save(file);
}

}  // namespace kinegraph
