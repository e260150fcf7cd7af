// A window with the viewing half of the editor and a graph evaluated in it, as the main window joins them.
#pragma once
#include <QApplication>
#include <QElapsedTimer>
#include <QLabel>
#include <QMouseEvent>
#include <QSplitter>
#include <QTabWidget>
#include <QTest>
#include <QVBoxLayout>
#include <functional>
#include <string>

#include "gui/components/components_panel.h"
#include "gui/curves/curves_panel.h"
#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"
#include "gui/look/theme.h"
#include "gui/timeline/timeline.h"
#include "gui/viewer/viewer.h"
#include "gui/viewing/playback.h"
#include "nodes/all_nodes.h"

namespace kinegraph {

struct ViewingWindow {
  Registry registry = all_nodes();
  Session session{registry};
  Evaluation evaluation{registry, ""};
  Playback playback;
  QWidget window;
  Viewer* viewer = nullptr;
  Timeline* timeline = nullptr;
  CurvesPanel* curves = nullptr;
  ComponentsPanel* components = nullptr;

  explicit ViewingWindow(const std::string& graph, QSize size = {1280, 800}) {
    viewer = new Viewer(session, evaluation, playback);
    timeline = new Timeline(session, evaluation, playback, *viewer);
    curves = new CurvesPanel(session, evaluation, playback, *viewer);
    components = new ComponentsPanel(session, evaluation, playback);
    auto* right = new QTabWidget;
    right->addTab(curves, "Curves");
    right->addTab(components, "Components");
    auto* above = new QSplitter(Qt::Horizontal);
    above->addWidget(viewer);
    above->addWidget(right);
    above->setSizes({640, 640});
    auto* all = new QSplitter(Qt::Vertical, &window);
    all->addWidget(above);
    all->addWidget(timeline);
    all->setSizes({600, 200});
    auto* column = new QVBoxLayout(&window);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(all);
    const auto evaluate = [this] {
      EvaluationRequest request;
      request.document = session.document();
      request.folder = session.folder().toStdString();
      for (const auto& targets :
           {viewer->wanted(), timeline->wanted(), curves->wanted(), components->wanted()})
        for (const Target& target : targets) request.targets.push_back(target);
      evaluation.request(std::move(request));
    };
    for (auto wanted : {&Viewer::wanted_changed}) QObject::connect(viewer, wanted, &window, evaluate);
    QObject::connect(timeline, &Timeline::wanted_changed, &window, evaluate);
    QObject::connect(curves, &CurvesPanel::wanted_changed, &window, evaluate);
    QObject::connect(components, &ComponentsPanel::wanted_changed, &window, evaluate);
    QObject::connect(&session, &Session::meaning_changed, &window, evaluate);
    set_theme(dark_theme());
    window.resize(size);
    window.show();
    window.activateWindow();
    (void)QTest::qWaitForWindowActive(&window, 2000);
    problems = session.open_text(graph, "");
  }
  Diagnostics problems;

  void set_theme(const Theme& theme) {
    QApplication::setPalette(theme.palette());
    qApp->setStyleSheet(theme.style_sheet());
    viewer->set_theme(theme);
    timeline->set_theme(theme);
    curves->set_theme(theme);
    components->set_theme(theme);
  }

  // Lets the window live until something holds; false after a while.
  static bool until(const std::function<bool()>& holds, int milliseconds = 30000) {
    QElapsedTimer clock;
    clock.start();
    while (!holds()) {
      if (clock.elapsed() > milliseconds) return false;
      QTest::qWait(10);
    }
    return true;
  }
  bool shows_motions(std::size_t count = 1) {
    return until([&] {
      std::size_t ready = 0;
      for (const Viewer::Shown& one : viewer->shown()) ready += one.motion ? 1 : 0;
      return ready >= count;
    });
  }
  // For a person to look at: written into the folder that KINEGRAPH_PICTURES names, if any.
  void keep_picture(const QString& name) {
    QTest::qWait(350);
    const QString folder = qEnvironmentVariable("KINEGRAPH_PICTURES");
    if (folder.isEmpty()) return;
    viewer->picture();
    window.grab().save(folder + "/" + name + ".png");
  }
};

}  // namespace kinegraph
