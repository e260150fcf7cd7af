#include "tests/screenshots/panels.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDragMoveEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QPainter>
#include <QSlider>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>

#include "gui/components/components_grid.h"
#include "gui/look/settings.h"
#include "gui/panels/param_field.h"

namespace kinegraph::shots {
namespace {

// The Parameters dock in a window of its own, as high as all it holds.
struct Tall {
  Tall(Shot& shot, int height) : dock(shot.window.findChild<QDockWidget*>("dock_parameters")) {
    shot.dock("Parameters");
    dock->setFloating(true);
    dock->resize(435, height);
    QApplication::setActiveWindow(dock);
    shot.wait();
  }
  QDockWidget* dock;
};

QWidget* field(Shot& shot, const char* param) {
  auto* found = shot.window.findChild<QDockWidget*>("dock_parameters")->findChild<QWidget*>(QString("param_") + param);
  if (!found) qFatal("no field %s", param);
  return found;
}

void retype(Shot& shot, QLineEdit* line, const QString& text, bool enter = true) {
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, text);
  if (enter) QTest::keyClick(line, Qt::Key_Return);
  shot.wait(250);
}

void every_node(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}})");
  Tall tall(shot, 900);
  for (const std::string& name : shot.registry.names()) {
    shot.canvas().add(name, {0, 0});
    shot.select(shot.session().current());
    shot.take_widget("node_" + QString::fromStdString(name) + end, tall.dock);
  }
}

}  // namespace

void panel_pictures(const Theme& theme, const QDir& into, const QString& end) {
  if (qEnvironmentVariableIsSet("ALL_NODES")) return every_node(theme, into, end);
}

}  // namespace kinegraph::shots
