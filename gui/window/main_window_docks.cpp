// The docks and where they stand when nobody has moved them.
#include <QDockWidget>

#include "gui/components/components_panel.h"
#include "gui/curves/curves_panel.h"
#include "gui/panels/files_panel.h"
#include "gui/panels/parameter_panel.h"
#include "gui/panels/problems_panel.h"
#include "gui/timeline/timeline.h"
#include "gui/viewer/viewer.h"
#include "gui/window/main_window.h"

namespace kinegraph {

QDockWidget* MainWindow::add_dock(QWidget* widget, const QString& title, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName("dock_" + title.toLower());
  dock->setAccessibleName(title);
  dock->setWidget(widget);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable |
                    QDockWidget::DockWidgetFloatable);
  addDockWidget(area, dock);
  docks_.push_back(dock);
  return dock;
}

template <class Room>
QDockWidget* MainWindow::add_room(Room* room, const QString& title, Qt::DockWidgetArea area) {
  if constexpr (requires { room->set_theme(*theme_); })
    themed_.push_back([room](const Theme& theme) { room->set_theme(theme); });
  if constexpr (requires { room->wanted(); }) {
    wants_.push_back([room] { return room->wanted(); });
    connect(room, &Room::wanted_changed, this, [this] {
      if (evaluation_due_) return;
      evaluation_due_ = true;
      QMetaObject::invokeMethod(this, &MainWindow::evaluate, Qt::QueuedConnection);
    });
  }
  return add_dock(room, title, area);
}

void MainWindow::make_docks() {
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  auto* viewer = new Viewer(session_, evaluation_, playback_);
  auto* timeline = new Timeline(session_, evaluation_, playback_, *viewer);
  auto* curves = new CurvesPanel(session_, evaluation_, playback_, *viewer);
  auto* components = new ComponentsPanel(session_, evaluation_, playback_);
  auto* parameters = new ParameterPanel(session_, evaluation_);
  auto* files = new FilesPanel(session_);
  auto* problems = new ProblemsPanel(session_, evaluation_);
  QDockWidget* viewer_dock = add_room(viewer, tr("Viewer"), Qt::RightDockWidgetArea);
  QDockWidget* parameter_dock = add_room(parameters, tr("Parameters"), Qt::RightDockWidgetArea);
  QDockWidget* files_dock = add_room(files, tr("Files"), Qt::RightDockWidgetArea);
  tabifyDockWidget(parameter_dock, files_dock);
  parameter_dock->raise();
  QDockWidget* timeline_dock = add_room(timeline, tr("Timeline"), Qt::BottomDockWidgetArea);
  QDockWidget* problems_dock = add_room(problems, tr("Problems"), Qt::BottomDockWidgetArea);
  QDockWidget* curves_dock = add_room(curves, tr("Curves"), Qt::BottomDockWidgetArea);
  QDockWidget* components_dock = add_room(components, tr("Components"), Qt::BottomDockWidgetArea);
  tabifyDockWidget(timeline_dock, problems_dock);
  tabifyDockWidget(timeline_dock, curves_dock);
  tabifyDockWidget(timeline_dock, components_dock);
  timeline_dock->raise();
  resizeDocks({viewer_dock, timeline_dock}, {460, 820}, Qt::Horizontal);
  resizeDocks({viewer_dock, parameter_dock}, {370, 380}, Qt::Vertical);
  resizeDocks({timeline_dock}, {190}, Qt::Vertical);
  connect(files, &FilesPanel::open_graph, this, [this](const QString& path) {
    if (may_discard()) open(path);
  });
  connect(files, &FilesPanel::add_clip, this, [this](const QString& path) {
    canvas_->add("Load", canvas_->to_graph(QRectF(canvas_->rect()).center() - QPointF(90, 40)), {},
                 {{"file", Json(session_.written_path(path).toStdString())}});
    canvas_->setFocus();
  });
  connect(problems, &ProblemsPanel::go_to, this, [this](const QString& node) {
    session_.select({node.toStdString()}, node.toStdString());
    canvas_->make_visible(node.toStdString());
  });
}

void MainWindow::show_dock(const QString& name) {
  for (QDockWidget* dock : docks_)
    if (dock->windowTitle().compare(name, Qt::CaseInsensitive) == 0) {
      dock->show();
      dock->raise();
    }
}

QStringList MainWindow::dock_names() const {
  QStringList names;
  for (QDockWidget* dock : docks_) names << dock->windowTitle();
  return names;
}

}  // namespace kinegraph
