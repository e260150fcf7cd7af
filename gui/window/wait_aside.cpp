#include "gui/window/wait_aside.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QEventLoop>
#include <QLabel>
#include <QMetaObject>
#include <QProgressBar>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

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
  QDialog dialog(over);
  dialog.setObjectName("wait_dialog");
  dialog.setWindowTitle(QObject::tr("Kinegraph"));
  dialog.setWindowModality(Qt::ApplicationModal);
  auto* column = new QVBoxLayout(&dialog);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(12);
  column->addWidget(new QLabel(what, &dialog));
  auto* bar = new QProgressBar(&dialog);
  bar->setRange(0, 0);
  bar->setTextVisible(false);
  bar->setFixedHeight(8);
  bar->setMinimumWidth(340);
  bar->setAccessibleName(what);
  column->addWidget(bar);
  auto* buttons = new QDialogButtonBox(&dialog);
  buttons->addButton(QObject::tr("Cancel"), QDialogButtonBox::RejectRole)->setFocus();
  column->addWidget(buttons);
  QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  QObject::connect(&dialog, &QDialog::rejected, &turns, [&] {
    cancelled = true;
    aside.stop();
  });
  dialog.show();
  while (!aside.wait(0)) turns.exec();
  return !cancelled;
}

}  // namespace kinegraph
