#include "tests/gui/hands.h"

#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QMenu>
#include <QSlider>
#include <QTest>
#include <QTimer>

#include "tests/gui/mouse.h"
#include "tests/places.h"

namespace kinegraph::editor_test {

Hands::Hands(MainWindow& the_window, unsigned seed, QString the_folder)
    : window(the_window), random(seed), folder(std::move(the_folder)) {
  for (const auto& [name, node] : document().nodes) given.insert(name);
}

std::vector<std::string> Hands::own() {
  std::vector<std::string> names;
  for (const auto& [name, node] : document().nodes)
    if (!given.count(name)) names.push_back(name);
  return names;
}

std::vector<std::string> Hands::all() {
  std::vector<std::string> names;
  for (const auto& [name, node] : document().nodes) names.push_back(name);
  return names;
}

QPoint Hands::title(const std::string& node) {
  const SceneNode& one = *canvas().scene().node(node);
  return canvas()
      .to_view(QPointF(one.rect.center().x(), one.rect.top() + (one.dot ? one.rect.height() / 2 : 14)))
      .toPoint();
}

bool Hands::reaches(const std::string& node) {
  const QPoint at = title(node);
  if (!canvas().rect().adjusted(4, 4, -4, -4).contains(at)) return false;
  const SceneNode* found = canvas().scene().node_at(canvas().to_graph(at));
  const double reach = 12 / std::max(canvas().zoom(), 0.4);
  return found && found->name == node &&
         (found->dot || !canvas().scene().port_at(canvas().to_graph(at), reach));
}

bool Hands::reaches(const PortAt& port) {
  const QPointF place = canvas().scene().port_position(port);
  const QPoint at = canvas().to_view(place).toPoint();
  if (!canvas().rect().contains(at)) return false;
  const auto found = canvas().scene().port_at(canvas().to_graph(at), 12 / std::max(canvas().zoom(), 0.4));
  return found && *found == port;
}

bool Hands::is_empty(QPoint view) {
  const QPointF at = canvas().to_graph(view);
  const GraphScene& scene = canvas().scene();
  for (const SceneFrame& frame : scene.frames())
    if (frame.title_bar.contains(at)) return false;
  return !scene.node_at(at) && !scene.port_at(at, 40) && !scene.wire_at(at, 20) && !scene.note_at(at) &&
         !(view.x() > canvas().width() - 180 && view.y() > canvas().height() - 130);
}

QPoint Hands::empty_place() {
  for (int tries = 0; tries < 200; ++tries) {
    const QPoint at(20 + below(canvas().width() - 40), 20 + below(canvas().height() - 40));
    if (is_empty(at)) return at;
  }
  return {};
}

std::vector<SceneWire> Hands::wires() {
  return shuffled(canvas().scene().wires());
}

void Hands::settle() {
  QCoreApplication::processEvents();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  QCoreApplication::processEvents();
}

void Hands::look_at_all() {
  delete asking.data();  // the gesture before opened nothing
  if (!QApplication::activeWindow()) QApplication::setActiveWindow(&window);
  canvas().setFocus();
  key(Qt::Key_Escape);
  key(Qt::Key_A);
}

void Hands::give_clips() {
  for (const char* clip : {"walk", "sneak"}) {
    const auto& inputs = document().nodes.at("ica").inputs;
    const auto clips = inputs.find("motions");
    const bool is_there =
        clips != inputs.end() && std::any_of(clips->second.links.begin(), clips->second.links.end(),
                                             [&](const Link& link) { return link.node == clip; });
    const PortAt from{clip, "motion", false}, to{"ica", "motions", true};
    if (is_there || !reaches(from) || !reaches(to)) continue;
    const auto place = [&](const PortAt& port) {
      return canvas().to_view(canvas().scene().port_position(port)).toPoint();
    };
    drag(place(from), place(to));
  }
}

void Hands::key(int which, Qt::KeyboardModifiers keys) {
  if (!QApplication::activeWindow()) QApplication::setActiveWindow(&window);
  QWidget* widget = QApplication::focusWidget() ? QApplication::focusWidget() : &canvas();
  QTest::keyClick(widget, Qt::Key(which), keys);
  settle();
}

void Hands::type(const QString& text) {
  if (QWidget* widget = QApplication::focusWidget()) QTest::keyClicks(widget, text);
  settle();
}

void Hands::click(QWidget& widget, QPoint at, Qt::KeyboardModifiers keys) {
  QTest::mouseClick(&widget, Qt::LeftButton, keys, at);
  settle();
}

void Hands::double_click(QPoint view) {
  QTest::mouseDClick(&canvas(), Qt::LeftButton, {}, view);
  settle();
}

void Hands::drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys) {
  editor_test::drag(canvas(), from, to, {.keys = keys, .steps = 6});
  settle();
}

void Hands::drag_slider(QSlider& slider) {
  const int to = slider.minimum() + below(slider.maximum() - slider.minimum() + 1);
  editor_test::drag(slider, handle_of(slider, slider.value()), handle_of(slider, to), {.steps = 4});
  settle();
}

bool Hands::choose(const std::string& node) {
  if (!document().nodes.count(node) || !reaches(node)) return false;
  click(canvas(), title(node));
  return session().current() == node;
}

bool Hands::choose_some(int least) {
  int chosen = 0;
  for (const std::string& node : shuffled(own())) {
    if (!reaches(node)) continue;
    click(canvas(), title(node), chosen ? Qt::ShiftModifier : Qt::NoModifier);
    if (++chosen >= least && below(2) == 0) break;
  }
  return chosen >= least;
}

void Hands::when_asked(std::function<void(QWidget&)> answer) {
  auto* timer = new QTimer(&window);
  timer->setInterval(2);
  asking = timer;
  QObject::connect(timer, &QTimer::timeout, &window, [timer, answer = std::move(answer)] {
    QWidget* up = QApplication::activePopupWidget();
    if (!up) up = QApplication::activeModalWidget();
    if (!up || !up->isVisible()) return;
    timer->stop();
    timer->deleteLater();
    answer(*up);
  });
  timer->start();
}

void Hands::answer_file_dialog(const QString& path) {
  when_asked([path](QWidget& dialog) {
    QApplication::clipboard()->setText(path);
    auto* line = dialog.findChild<QLineEdit*>("fileNameEdit");
    if (!line) {
      dialog.close();
      return;
    }
    QTest::keyClick(line, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClick(line, Qt::Key_V, Qt::ControlModifier);
    QTest::keyClick(line, Qt::Key_Return);
  });
}

bool Hands::choose_in_menu(QWidget& widget, const QString& starts_with) {
  auto* menu = qobject_cast<QMenu*>(&widget);
  for (QAction* action : menu ? menu->actions() : QList<QAction*>())
    if (action->isEnabled() && !action->isSeparator() && action->text().startsWith(starts_with)) {
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
      return true;
    }
  widget.close();
  return false;
}

QString Hands::new_file(const char* ending) {
  return folder + "/made_" + QString::number(++files) + ending;
}

std::vector<Gesture> all_gestures() {
  std::vector<Gesture> gestures = canvas_gestures();
  for (const auto& more : {parameter_gestures(), dock_gestures()})
    gestures.insert(gestures.end(), more.begin(), more.end());
  return gestures;
}

QString graph_for_hands(const QString& folder) {
  QDir(folder).mkpath("clips");
  for (const char* clip : {"/clips/walk.bvh", "/clips/sneak.bvh"})
    QFile::copy(QString::fromStdString(source_folder()) + "/graphs" + clip, folder + clip);
  const QString path = folder + "/hands.kg.json";
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return {};
  file.write(R"({
  "format": "kinegraph",
  "schema": 1,
  "variables": {
    "lively": 1.25
  },
  "nodes": {
    "bold": {
      "type": "Exaggerate",
      "params": {
        "correct": false
      },
      "inputs": {
        "motion": "made.motion"
      }
    },
    "check": {
      "type": "Check",
      "params": {
        "rules": ["skate < 0.02"]
      },
      "inputs": {
        "metrics": "judge.metrics"
      }
    },
    "ica": {
      "type": "ICA",
      "params": {
        "components": 3,
        "starts": 1
      },
      "inputs": {
        "motions": [
          "walk.motion",
          "sneak.motion"
        ]
      }
    },
    "judge": {
      "type": "Metrics",
      "inputs": {
        "motion": "transfer.motion"
      }
    },
    "made": {
      "type": "Gait",
      "params": {
        "seconds": 1
      }
    },
    "poses": {
      "type": "MotionWarp",
      "inputs": {
        "motion": "sneak.motion"
      }
    },
    "sneak": {
      "type": "Gait",
      "params": {
        "gait": "sneak",
        "seconds": 1
      }
    },
    "stats": {
      "type": "QuatStats",
      "inputs": {
        "motion": "sneak.motion"
      }
    },
    "take": {
      "type": "Load",
      "params": {
        "file": "clips/walk.bvh"
      }
    },
    "transfer": {
      "type": "StyleTransfer",
      "inputs": {
        "motion": "walk.motion",
        "style": "stats.stats"
      }
    },
    "walk": {
      "type": "Gait",
      "params": {
        "seconds": 1
      }
    }
  },
  "ui": {
    "nodes": {
      "bold": {
        "pos": [250, 700]
      },
      "check": {
        "pos": [1000, 0]
      },
      "ica": {
        "pos": [250, 450]
      },
      "judge": {
        "pos": [750, 0]
      },
      "made": {
        "pos": [0, 600]
      },
      "poses": {
        "pos": [500, 250]
      },
      "sneak": {
        "pos": [0, 250]
      },
      "stats": {
        "pos": [250, 250]
      },
      "take": {
        "pos": [750, 250]
      },
      "transfer": {
        "pos": [500, 0]
      },
      "walk": {
        "pos": [0, 0]
      }
    }
  }
}
)");
  return path;
}

}  // namespace kinegraph::editor_test
