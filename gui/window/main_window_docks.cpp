// The docks and where they stand when nobody has moved them.
#include <QDockWidget>
#include <QTabBar>
#include <algorithm>

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
  const auto later = [this] {
    QMetaObject::invokeMethod(this, &MainWindow::update_dock_titles, Qt::QueuedConnection);
  };
  connect(dock, &QDockWidget::dockLocationChanged, this, later);
  connect(dock, &QDockWidget::topLevelChanged, this, later);
  connect(dock, &QDockWidget::visibilityChanged, this, later);
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
  add_room(viewer, tr("Viewer"), Qt::RightDockWidgetArea);
  add_room(parameters, tr("Parameters"), Qt::RightDockWidgetArea);
  add_room(files, tr("Files"), Qt::RightDockWidgetArea);
  add_room(timeline, tr("Timeline"), Qt::BottomDockWidgetArea);
  add_room(components, tr("Components"), Qt::BottomDockWidgetArea);
  add_room(curves, tr("Curves"), Qt::BottomDockWidgetArea);
  add_room(problems, tr("Problems"), Qt::BottomDockWidgetArea);
  usual_layout();
  // Whoever looks at the dock sees what is there now.
  connect(docks_[2], &QDockWidget::visibilityChanged, files, [files](bool seen) {
    if (seen) files->look();
  });
  connect(files, &FilesPanel::open_graph, this, &MainWindow::open);
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

QDockWidget* MainWindow::dock(const QString& name) const {
  for (QDockWidget* one : docks_)
    if (one->windowTitle().compare(name, Qt::CaseInsensitive) == 0) return one;
  return nullptr;
}

void MainWindow::usual_layout() {
  for (QDockWidget* one : docks_) {
    one->setFloating(false);
    one->show();
  }
  QDockWidget *viewer = docks_[0], *parameters = docks_[1], *files = docks_[2];
  addDockWidget(Qt::RightDockWidgetArea, viewer);
  addDockWidget(Qt::RightDockWidgetArea, parameters);
  splitDockWidget(viewer, parameters, Qt::Vertical);
  tabifyDockWidget(parameters, files);
  addDockWidget(Qt::BottomDockWidgetArea, docks_[3]);
  for (std::size_t i = 4; i < docks_.size(); ++i) tabifyDockWidget(docks_[i - 1], docks_[i]);
  parameters->raise();
  docks_[3]->raise();
  size_docks();
  QMetaObject::invokeMethod(this, &MainWindow::update_dock_titles, Qt::QueuedConnection);
}

// A third of the width for what is seen and set, and of a large window's height more for the motion.
void MainWindow::size_docks() {
  const int right = std::clamp(width() * 34 / 100, 384, 620),
            below = std::clamp(height() * 34 / 100, 220, 340);
  const int viewer = std::max(300, height() * 44 / 100);
  resizeDocks({docks_[0], docks_[3]}, {right, width() - right}, Qt::Horizontal);
  resizeDocks({docks_[0], docks_[1]}, {viewer, height() - viewer}, Qt::Vertical);
  resizeDocks({docks_[3]}, {below}, Qt::Vertical);
}

// A dock among tabs has its name on its tab already.
void MainWindow::update_dock_titles() {
  for (QDockWidget* one : docks_) {
    const bool tabbed = !one->isFloating() && !tabifiedDockWidgets(one).isEmpty();
    QWidget* own = one->titleBarWidget();
    if (tabbed == (own != nullptr)) continue;
    if (tabbed) {
      auto* none = new QWidget(one);
      none->setFixedHeight(0);
      one->setTitleBarWidget(none);
    } else {
      one->setTitleBarWidget(nullptr);
      delete own;
    }
  }
  for (QTabBar* bar : findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    bar->setAccessibleName(tr("Docks"));
    bar->setDrawBase(false);
    bar->setElideMode(Qt::ElideNone);
    bar->setUsesScrollButtons(true);
    bar->setExpanding(false);
  }
}

void MainWindow::go_to_dock(const QString& name) {
  show_dock(name);
  QDockWidget* at = dock(name);
  if (!at || !at->widget()) return;
  QWidget* room = at->widget();
  if (room->focusPolicy() != Qt::NoFocus) return room->setFocus(Qt::ShortcutFocusReason);
  for (QWidget* child : room->findChildren<QWidget*>())
    if (child->isVisibleTo(room) && child->isEnabled() && child->focusPolicy() & Qt::TabFocus)
      return child->setFocus(Qt::ShortcutFocusReason);
}

void MainWindow::show_dock(const QString& name) {
  if (QDockWidget* at = dock(name)) {
    at->show();
    at->raise();
  }
}

QStringList MainWindow::dock_names() const {
  QStringList names;
  for (QDockWidget* dock : docks_) names << dock->windowTitle();
  return names;
}

}  // namespace kinegraph
