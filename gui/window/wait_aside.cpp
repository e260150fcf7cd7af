#include "gui/window/wait_aside.h"

#include <QEventLoop>
#include <QMetaObject>
#include <QProgressDialog>
#include <QTimer>

#include "gui/document/aside.h"

namespace kinegraph {
namespace {

constexpr int unseen_ms = 25;   // so long the window may stand still
constexpr int unsaid_ms = 500;  // and so long nothing needs saying

}  // namespace

bool wait_aside(QWidget* over, const QString& what, const std::function<void(const StopToken&)>& work) {
  QEventLoop turns;
  bool cancelled = false;
  Aside aside(work, [&turns] { QMetaObject::invokeMethod(&turns, &QEventLoop::quit, Qt::QueuedConnection); });
  if (aside.wait(unseen_ms)) return true;
  QTimer::singleShot(unsaid_ms, &turns, &QEventLoop::quit);
  while (!aside.wait(0) && turns.exec(QEventLoop::ExcludeUserInputEvents) == 0)
    if (over) break;
  if (aside.wait(0)) return true;
  QProgressDialog dialog(what, QObject::tr("Cancel"), 0, 0, over);
  dialog.setWindowTitle(QObject::tr("Kinegraph"));
  dialog.setWindowModality(Qt::ApplicationModal);
  dialog.setMinimumSize(340, 104);
  dialog.setMinimumDuration(0);
  dialog.setAutoReset(false);
  QObject::connect(&dialog, &QProgressDialog::canceled, &turns, [&] {
    cancelled = true;
    aside.stop();
  });
  dialog.show();
  while (!aside.wait(0)) turns.exec();
  return !cancelled;
}

}  // namespace kinegraph
