// How quick the editor is: each figure beside what is wanted. Exits with 1 where one doesn't hold. Started by
// scripts/bench_gui.
#include <QApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QMouseEvent>
#include <QSlider>
#include <QStandardPaths>
#include <QStyleOptionSlider>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "graph/file/write.h"
#include "gui/look/editor_style.h"
#include "gui/viewer/shown_motion.h"
#include "gui/viewer/viewer.h"
#include "gui/window/main_window.h"
#include "nodes/all_nodes.h"

namespace kinegraph {
namespace {

bool all_hold = true;

void tell(const std::string& what, double measured, const char* unit, double wanted, bool at_least = false) {
  const bool holds = at_least ? measured >= wanted : measured <= wanted;
  all_hold = all_hold && holds;
  std::printf("%-66s %8.1f %-10s %s %6.1f  %s\n", what.c_str(), measured, unit,
              at_least ? "at least" : "at most ", wanted, holds ? "holds" : "DOES NOT HOLD");
  std::fflush(stdout);
}

double part(std::vector<double> all, double fraction) {
  if (all.empty()) return 1e9;
  std::sort(all.begin(), all.end());
  return all[std::min(all.size() - 1, std::size_t(double(all.size()) * fraction))];
}

double ms(const QElapsedTimer& clock) {
  return double(clock.nsecsElapsed()) * 1e-6;
}

struct Bench {
  Bench() : window(registry, {.remember = false, .ask = false, .cache_folder = {}}) {
    window.resize(1280, 800);
    window.show();
    (void)QTest::qWaitForWindowExposed(&window);
    QApplication::setActiveWindow(&window);
  }
  bool open(const std::string& text) {
    path = folder.filePath("bench.kg.json");
    std::ofstream(path.toStdString()) << text;
    return window.open(path);
  }
  GraphCanvas& canvas() { return window.canvas(); }
  Session& session() { return window.session(); }

  QTemporaryDir folder;
  QString path;
  int asked = 0;  // warps
  Registry registry = all_nodes();
  MainWindow window;
};

std::string warp_graph() {
  return R"({"format": "kinegraph", "schema": 1, "nodes": {
    "a": {"type": "Gait", "params": {"seconds": 166.67}},
    "b": {"type": "Gait", "params": {"gait": "sneak", "seconds": 166.67}},
    "free": {"type": "Gait"},
    "warp": {"type": "TimeWarp", "inputs": {"source": "a.motion", "reference": "b.motion"}}},
    "ui": {"nodes": {"a": {"pos": [0, 0]}, "b": {"pos": [0, 200]}, "free": {"pos": [0, 420]}, "warp": {"pos": [300, 0]}}}})";
}

bool warp_runs(Bench& bench) {
  const NodeStatus* status = bench.window.evaluation().status("warp");
  return bench.window.is_evaluating() && status && status->state == NodeStatus::State::running;
}

// Another warp from here on, one that was never asked for: what ran is stopped.
void ask_anew(Bench& bench) {
  bench.session().perform([&](const Document& d, const Registry& r) {
    return set_param(d, r, "b", "speed", Json(1.0 + 0.001 * ++bench.asked));
  });
}

// Gaps between two turns of the event loop while a node is dragged and the warp runs, ms.
std::vector<double> gaps(Bench& bench, int least) {
  std::vector<double> found;
  QElapsedTimer since;
  QTimer turn, hand;
  turn.setTimerType(Qt::PreciseTimer);
  hand.setTimerType(Qt::PreciseTimer);
  bool counting = false;
  QObject::connect(&turn, &QTimer::timeout, [&] {
    if (counting && since.isValid()) found.push_back(ms(since));
    since.start();
  });
  GraphCanvas& canvas = bench.canvas();
  const QRectF box = canvas.scene().node("free")->rect;
  const QPoint grip = canvas.to_view(QPointF(box.center().x(), box.top() + 14)).toPoint();
  int step = 0;
  QObject::connect(&hand, &QTimer::timeout, [&] {
    ++step;
    const QPoint at = grip + QPoint(int(90 * std::sin(step * 0.08)), int(-30 * std::sin(step * 0.05)));
    QMouseEvent event(QEvent::MouseMove, at, canvas.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&canvas, &event);
  });
  QTest::mousePress(&canvas, Qt::LeftButton, {}, grip);
  turn.start(1);
  hand.start(8);
  QElapsedTimer all;
  all.start();
  while (int(found.size()) < least && all.elapsed() < 60000) {
    ask_anew(bench);
    if (!QTest::qWaitFor([&] { return warp_runs(bench); }, 20000)) break;
    since.invalidate();
    counting = true;
    (void)QTest::qWaitFor([&] { return !warp_runs(bench) || int(found.size()) >= least; }, 3000);
    counting = false;
  }
  QTest::mouseRelease(&canvas, Qt::LeftButton, {}, grip);
  return found;
}

void never_blocks() {
  Bench bench;
  bench.open(warp_graph());
  auto* viewer = bench.window.findChild<Viewer*>();
  viewer->pin(2, "warp");  // looked at whatever is chosen: who drags a node chooses it
  if (!QTest::qWaitFor([&] { return warp_runs(bench); }, 60000)) {
    tell("TimeWarp of 20,000 frames runs", 0, "", 1, true);
    return;
  }
  const std::vector<double> resting = gaps(bench, 3000);
  tell("dragging while TimeWarp runs: 99 % of " + std::to_string(resting.size()) + " gaps",
       part(resting, 0.99), "ms", 20);
  tell("dragging while TimeWarp runs: longest gap", part(resting, 1), "ms", 50);

  std::vector<double> cancelled;
  for (int turn = 0; turn < 5; ++turn) {
    ask_anew(bench);
    if (!QTest::qWaitFor([&] { return warp_runs(bench); }, 60000)) break;
    QTest::qWait(150);
    if (!warp_runs(bench)) continue;
    QElapsedTimer clock;
    double after = -1;
    const auto ended = QObject::connect(&bench.window.evaluation(), &Evaluation::finished, [&] {
      if (after < 0 && bench.window.evaluation().log().stopped) after = ms(clock);
    });
    clock.start();
    ask_anew(bench);
    (void)QTest::qWaitFor([&] { return after >= 0; }, 20000);
    QObject::disconnect(ended);
    cancelled.push_back(after);
  }
  tell("an edit stops the old work, the longest of " + std::to_string(cancelled.size()), part(cancelled, 1),
       "ms", 50);

  viewer->pin(1, "a");
  (void)QTest::qWaitFor([&] { return !viewer->shown().empty() && viewer->shown()[0].motion; }, 60000);
  bench.window.playback().play();
  const std::vector<double> playing = gaps(bench, 3000);
  tell("the same while the viewer plays: longest of " + std::to_string(playing.size()) + " gaps",
       part(playing, 1), "ms", 70);
  ask_anew(bench);
  (void)QTest::qWaitFor([&] { return warp_runs(bench); }, 20000);
  QElapsedTimer clock;
  clock.start();
  bench.window.close();
  QCoreApplication::processEvents();
  tell("closing the window while it runs", ms(clock), "ms", 200);
}

std::string five_hundred_nodes() {
  std::string nodes, places;
  for (int i = 0; i < 500; ++i) {
    const int column = i % 25, row = i / 25;
    const std::string name = "n" + std::to_string(1000 + i);
    const char* type = column == 0       ? "Gait"
                       : column % 3 == 1 ? "Footskate"
                       : column % 3 == 2 ? "Mirror"
                                         : "Trim";
    nodes += (i ? ",\n" : "") + std::string("\"") + name + "\": {\"type\": \"" + type + "\"";
    if (column) nodes += ", \"inputs\": {\"motion\": \"n" + std::to_string(999 + i) + ".motion\"}";
    nodes += "}";
    places += (i ? ",\n" : "") + std::string("\"") + name + "\": {\"pos\": [" + std::to_string(column * 240) +
              ", " + std::to_string(row * 180) + "]}";
  }
  return R"({"format": "kinegraph", "schema": 1, "nodes": {)" + nodes + R"(}, "ui": {"nodes": {)" + places +
         "}}}";
}

void many_nodes() {
  Bench bench;
  QElapsedTimer clock;
  clock.start();
  const bool opened = bench.open(five_hundred_nodes());
  bench.canvas().repaint();
  tell("500 nodes open and are drawn", opened ? ms(clock) : 1e9, "ms", 150);
  bench.window.evaluation().cancel();
  (void)QTest::qWaitFor([&] { return !bench.window.is_evaluating(); }, 60000);
  QTest::qWait(500);

  GraphCanvas& canvas = bench.canvas();
  const QPointF middle = QRectF(canvas.rect()).center();
  const auto wheel = [&](int notches) {
    QWheelEvent event(middle, canvas.mapToGlobal(middle), {}, {0, 120 * notches}, Qt::NoButton, {},
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&canvas, &event);
  };
  const auto at_zoom = [&](double wanted) {
    while (canvas.zoom() > wanted * 1.09) wheel(-1);
    while (canvas.zoom() < wanted / 1.09) wheel(1);
  };
  for (double zoom : {0.2, 0.3, 0.5, 1.0}) {
    at_zoom(zoom);
    QTest::qWait(300);
    std::vector<double> frames;
    QTest::mousePress(&canvas, Qt::MiddleButton, {}, middle.toPoint());
    for (int i = 1; i <= 160; ++i) {
      const QPoint at =
          middle.toPoint() + QPoint(int(160 * std::sin(i * 0.04)), int(90 * std::sin(i * 0.06)));
      clock.start();
      QMouseEvent event(QEvent::MouseMove, at, canvas.mapToGlobal(at), Qt::NoButton, Qt::MiddleButton, {});
      QApplication::sendEvent(&canvas, &event);
      canvas.repaint();
      frames.push_back(ms(clock));
    }
    QTest::mouseRelease(&canvas, Qt::MiddleButton, {}, middle.toPoint());
    for (int i = 0; i < 40; ++i) {
      clock.start();
      wheel(i % 8 < 4 ? 1 : -1);
      canvas.repaint();
      frames.push_back(ms(clock));
      QTest::qWait(10);
    }
    char what[80];
    std::snprintf(what, sizeof what, "500 nodes at zoom %.1f: 95 %% of %zu frames", zoom, frames.size());
    tell(what, part(frames, 0.95), "ms", 16.7);
  }
}

// A graph with a slider on 1,000 frames; `nested`: the nodes lie in a graph file inside it, whose `more`
// other nodes are read with it.
std::string slider_graph(Bench& bench, bool nested, int more) {
  std::string nodes = R"("sneak": {"type": "Gait", "params": {"gait": "sneak", "seconds": 8.34}},
    "style": {"type": "QuatStats", "inputs": {"motion": "sneak.motion"}},
    "transfer": {"type": "StyleTransfer", "params": {"amount": 0.5}, "inputs": {"motion": "walk.motion", "style": "style.stats"}},
    "walk": {"type": "Gait", "params": {"seconds": 8.34}})";
  const std::string start = R"({"format": "kinegraph", "schema": 1, )";
  for (int i = 0; i < more; ++i)
    nodes += ",\n\"more" + std::to_string(i) + R"(": {"type": "Trim", "inputs": {"motion": "walk.motion"}})";
  if (!nested) return start + R"("nodes": {)" + nodes + "}}";
  std::ofstream(bench.folder.filePath("inside.kg.json").toStdString())
      << start
      << R"("publish": {"params": {"amount": "transfer.amount"}, "outputs": {"motion": "transfer.motion"}},
      "nodes": {)" +
             nodes + "}}";
  return start +
         R"("nodes": {"transfer": {"type": "Graph", "params": {"file": "inside.kg.json", "amount": 0.5}}}})";
}

double cpu_ms(clockid_t which) {
  timespec now{};
  clock_gettime(which, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

// Where a hand takes hold of it: pressed elsewhere it would go there page by page.
QPoint handle_of(const QSlider& slider) {
  QStyleOptionSlider option;
  option.initFrom(&slider);
  option.orientation = slider.orientation();
  option.minimum = slider.minimum();
  option.maximum = slider.maximum();
  option.sliderPosition = slider.sliderPosition();
  return slider.style()
      ->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider)
      .center();
}

// From a move of the slider's handle to the picture of the new motion.
void slider_drag(const char* what, bool nested, int more) {
  Bench bench;
  bench.open(slider_graph(bench, nested, more));
  bench.session().select({"transfer"}, "transfer");
  auto* viewer = bench.window.findChild<Viewer*>();
  const auto value = [&] { return bench.window.evaluation().value("transfer", "motion"); };
  const auto shows = [&] {
    return !viewer->shown().empty() && viewer->shown()[0].motion &&
           viewer->shown()[0].motion->value == value();
  };
  (void)QTest::qWaitFor([&] { return value() && shows() && !bench.window.is_evaluating(); }, 60000);
  QTest::qWait(300);
  auto* row = bench.window.findChild<QWidget*>("param_amount");
  auto* slider = row ? row->findChild<QSlider*>() : nullptr;
  if (!slider) return tell(std::string(what) + ": there is a slider", 0, "", 1, true);
  const QPoint from = handle_of(*slider);
  QTest::mousePress(slider, Qt::LeftButton, {}, from);
  std::vector<double> edited, evaluated, made, drawn, window_cpu, all_cpu;
  for (int i = 1; i <= 60; ++i) {
    (void)QTest::qWaitFor([&] { return !bench.window.is_evaluating(); }, 5000);
    QTest::qWait(20);
    const ValuePtr before = value();
    const int pictures = viewer->pictures_drawn();
    const double thread = cpu_ms(CLOCK_THREAD_CPUTIME_ID), process = cpu_ms(CLOCK_PROCESS_CPUTIME_ID);
    QElapsedTimer clock;
    clock.start();
    const QPoint at = from + QPoint(i % 2 ? i / 2 + 1 : -i / 2, 0);
    QMouseEvent event(QEvent::MouseMove, at, slider->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(slider, &event);
    edited.push_back(ms(clock));
    double computed = 0, ready = 0;
    while (ms(clock) < 2000) {
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
      if (!computed && value() != before) computed = ms(clock);
      if (computed && !ready && shows()) ready = ms(clock);
      if (ready && viewer->pictures_drawn() > pictures) break;
    }
    // What never came counts as long as it was waited for.
    evaluated.push_back(computed > 0 ? computed : ms(clock));
    made.push_back(ready > 0 ? ready : ms(clock));
    drawn.push_back(ms(clock));
    window_cpu.push_back(cpu_ms(CLOCK_THREAD_CPUTIME_ID) - thread);
    all_cpu.push_back(cpu_ms(CLOCK_PROCESS_CPUTIME_ID) - process);
  }
  QTest::mouseRelease(slider, Qt::LeftButton, {}, from);
  // One repaint is drawing the picture.
  tell(std::string(what) + ": the result, median of 60", part(made, 0.5), "ms", 33);
  std::printf(
      "    medians: edited %.1f, evaluated %.1f, made ready %.1f, drawn %.1f ms; CPU of the window's thread "
      "%.1f, of all %.1f ms\n",
      part(edited, 0.5), part(evaluated, 0.5), part(made, 0.5), part(drawn, 0.5), part(window_cpu, 0.5),
      part(all_cpu, 0.5));
  tell(std::string(what) + ": 95 % of results", part(made, 0.95), "ms", 50);
  tell(std::string(what) + ": the window's thread, 95 % of edits", part(edited, 0.95), "ms", 20);

  // Without a pause, as a hand drags: how many results are seen.
  const QPoint handle = handle_of(*slider);
  QTest::mousePress(slider, Qt::LeftButton, {}, handle);
  int seen = 0;
  const Value* shown = nullptr;
  QElapsedTimer clock;
  clock.start();
  for (int i = 0; ms(clock) < 2000; ++i) {
    const QPoint at = handle + QPoint(int(40 * std::sin(i * 0.05)), 0);
    QMouseEvent event(QEvent::MouseMove, at, slider->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(slider, &event);
    QTest::qWait(8);
    if (viewer->shown().empty() || !viewer->shown()[0].motion) continue;
    // The hand goes to and fro, so that the same value may come again.
    const Value* now = viewer->shown()[0].motion->value.get();
    seen += now != shown;
    shown = now;
  }
  QTest::mouseRelease(slider, Qt::LeftButton, {}, handle);
  tell(std::string(what) + ": results seen in a second of dragging", double(seen) / 2, "", 12, true);
}

void slider_drags() {
  slider_drag("a slider on 1,000 frames", false, 0);
  slider_drag("in a graph of 500 nodes", false, 496);
  slider_drag("through a nested file of 500 nodes", true, 496);
}

void five_bodies() {
  Bench bench;
  bench.open(R"({"format": "kinegraph", "schema": 1, "nodes": {
    "walk": {"type": "Gait"}, "run": {"type": "Gait", "params": {"gait": "run"}},
    "sneak": {"type": "Gait", "params": {"gait": "sneak"}}, "strut": {"type": "Gait", "params": {"gait": "strut"}},
    "hobble": {"type": "Gait", "params": {"gait": "hobble"}}}})");
  auto* viewer = bench.window.findChild<Viewer*>();
  const char* const names[] = {"walk", "run", "sneak", "strut", "hobble"};
  for (int place = 1; place <= 5; ++place) viewer->pin(place, names[place - 1]);
  (void)QTest::qWaitFor(
      [&] {
        int ready = 0;
        for (const Viewer::Shown& one : viewer->shown()) ready += one.motion ? 1 : 0;
        return ready == 5 && !bench.window.is_evaluating();
      },
      60000);
  viewer->picture();
  QTest::qWait(500);
  Playback& playback = bench.window.playback();
  playback.set_loops(false);
  playback.set_frame(0);
  QElapsedTimer clock;
  double off = 0;
  QObject::connect(&playback, &Playback::moved, [&] {
    if (clock.isValid() && playback.is_playing())
      off = std::max(off, std::abs(playback.time() - ms(clock) * 1e-3) * playback.fps());
  });
  const int drawn = viewer->pictures_drawn();
  clock.start();
  playback.play();
  while (ms(clock) < 2500) QTest::qWait(20);
  const double seconds = ms(clock) * 1e-3;
  const int pictures = viewer->pictures_drawn() - drawn;
  playback.pause();
  tell(std::string("five bodies at 1280x800, ") + (viewer->uses_opengl() ? "OpenGL" : "QPainter") +
           ": pictures a second",
       pictures / seconds, "", 24, true);
  tell("the clip's clock, furthest off", off, "frames", 1);
}

}  // namespace
}  // namespace kinegraph

int main(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QApplication::setStyle(new kinegraph::EditorStyle);
  const std::string which = argc > 1 ? argv[1] : "";
  if (which.empty() || which == "blocks") kinegraph::never_blocks();
  if (which.empty() || which == "nodes") kinegraph::many_nodes();
  if (which.empty() || which == "slider") kinegraph::slider_drags();
  if (which.empty() || which == "bodies") kinegraph::five_bodies();
  return kinegraph::all_hold ? 0 : 1;
}
