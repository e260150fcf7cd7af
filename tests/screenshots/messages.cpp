// Pictures of the dialogs, the questions and the notices, and of the window in other sizes.
#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QThread>

#include "graph/edit.h"
#include "graph/file/read.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/look/ask_file.h"
#include "gui/window/changes_dialog.h"
#include "gui/window/wait_aside.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

void troubles(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "takes/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}}, "feet": {"type": "Footskate"},
      "holo": {"type": "Hologram", "inputs": {"motion": "soft.motion"}})");
    shot.select("walk");
    shot.dock("Problems");
    shot.take("missing_file" + end);
    shot.take_dock("problems" + end, "Problems");
    shot.take_popup(
        "relink" + end, [&] { shot.window.action("relink")->trigger(); }, 2500);
    shot.select("holo");
    shot.take_dock("parameters_unknown" + end, "Parameters");
  }
  {
    Shot shot(theme, into);
    QFile newer(shot.folder.filePath("newer.kg.json"));
    if (newer.open(QIODevice::WriteOnly))
      newer.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"gait": {"type": "Gait"},
        "soft": {"type": "Filter", "inputs": {"motion": "gait.motion"}}}})");
    newer.close();
    shot.window.open(newer.fileName());
    shot.wait();
    shot.take("newer_file" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
    QFile file(path);
    if (file.open(QIODevice::ReadOnly)) {
      QByteArray changed = file.readAll();
      file.close();
      changed.replace("\"Filter\",", "\"Filter\", \"note\": \"calmer\",");
      changed.replace("walk.bvh", "strut.bvh");
      if (file.open(QIODevice::WriteOnly)) file.write(changed);
      file.close();
    }
    shot.wait(1200);
    shot.take("changed_on_disk" + end);
    const ReadResult before = read_document(shot.session().text_on_disk(), "a", shot.registry);
    if (file.open(QIODevice::ReadOnly)) {
      const ReadResult after = read_document(file.readAll().toStdString(), "a", shot.registry);
      ChangesDialog dialog("example.kg.json changed on disk", diff(before.document, after.document),
                           &shot.window);
      shot.take_popup("changes" + end, [&] { dialog.exec(); });
    }
  }
  {
    Shot shot(theme, into);
    QFile damaged(shot.in_shot("damaged.bvh"));
    if (damaged.open(QIODevice::WriteOnly)) damaged.write("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n}\n");
    damaged.close();
    shot.text(R"("walk": {"type": "Load", "params": {"file": "damaged.bvh"}})");
    shot.select("walk");
    shot.take("damaged_clip" + end);
  }
  {
    Shot shot(theme, into);
    shot.open("sneaky_walk");
    shot.take_popup("keys" + end, [&] { shot.window.action("keys")->trigger(); });
    shot.take_popup("about" + end, [&] { shot.window.action("about")->trigger(); });
    shot.session().perform([](const Document& d, const Registry&) { return set_note(d, "walk", "mine"); });
    shot.take_popup("unsaved" + end, [&] { shot.window.action("close_page")->trigger(); });
  }
}

void questions(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    QDir(shot.folder.path()).mkpath("pipelines");
    for (const char* name : {"reuse", "pipelines/sneakify", "pipelines/restyle", "pipelines/clean_feet"})
      QFile::copy(Shot::example(name), shot.folder.filePath(QString(name) + ".kg.json"));
    QFile::link(QString::fromStdString(source_folder()) + "/graphs/clips", shot.folder.filePath("clips"));
    shot.window.open(shot.folder.filePath("reuse.kg.json"));
    shot.wait();
    shot.window.open(shot.folder.filePath("pipelines/sneakify.kg.json"));
    shot.wait();
    shot.session().perform(
        [](const Document& d, const Registry&) { return set_note(d, d.nodes.begin()->first, "calmer"); });
    shot.session().show_page(0);
    shot.wait();
    shot.take_popup("run_asks_to_save" + end, [&] { shot.window.action("run")->trigger(); });
  }
  {
    Shot shot(theme, into);
    QFile torn(shot.folder.filePath("torn.kg.json"));
    if (torn.open(QIODevice::WriteOnly))
      torn.write("{\"format\": \"kinegraph\", \"schema\": 1, \"nodes\": {\n  \"walk\": {\"type\": ");
    torn.close();
    shot.take_popup("damaged_graph" + end, [&] { shot.window.open(torn.fileName()); });
  }
}

void notices(const Theme& theme, const QDir& into, const QString& end) {
  const auto change = [](const QString& path, const QByteArray& from, const QByteArray& to) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return;
    QByteArray text = file.readAll();
    file.close();
    text.replace(from, to);
    if (file.open(QIODevice::WriteOnly)) file.write(text);
  };
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}},
      "out": {"type": "Export", "params": {"file": "soft.bvh"}, "inputs": {"motion": "soft.motion"}})");
    shot.window.action("run")->trigger();
    shot.wait(1200);
    shot.take("ran" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "feet": {"type": "Footskate"},
      "out": {"type": "Export", "params": {"file": "soft.bvh"}, "inputs": {"motion": "feet.motion"}})");
    shot.window.action("run")->trigger();
    shot.select("feet");
    shot.take("run_refused" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}})");
    change(path, "}", "");
    shot.wait(1200);
    shot.take("torn_on_disk" + end);
  }
}

void refusals(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.text(R"("gait": {"type": "Gait"})");
    shot.window.action("run")->trigger();
    shot.take("nothing_to_run" + end);
    shot.window.action("relink")->trigger();
    shot.take("nothing_missing" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(
        R"("gait": {"type": "Gait"}, "figures": {"type": "Metrics", "inputs": {"motion": "gait.motion"}},
      "check": {"type": "Check", "params": {"rules": ["skate < -1", "penetration < 1"]},
        "inputs": {"metrics": "figures.metrics"}})");
    shot.window.action("run")->trigger();
    shot.wait(1200);
    shot.take("check_failed" + end);
  }
  {
    Shot shot(theme, into);
    QFile newer(shot.in_shot("newer.kg.json"));
    if (newer.open(QIODevice::WriteOnly))
      newer.write(R"({"format": "kinegraph", "schema": 99, "nodes": {"gait": {"type": "Gait"}}})");
    newer.close();
    shot.window.open(newer.fileName());
    shot.wait();
    shot.canvas().add("Filter", {260, 0});
    shot.take("edit_refused" + end);
  }
}

void rarer_dialogs(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}})");
  QTimer::singleShot(1500, [&] {
    if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget())) {
      shot.take_widget("opening" + end, dialog);
      dialog->reject();
    }
  });
  QElapsedTimer clock;
  clock.start();
  wait_aside(&shot.window, "Opening a_long_take.kg.json", [&clock](const StopToken& stop) {
    while (!stop.stopped() && clock.elapsed() < 5000) QThread::msleep(10);
  });
  // A name that is taken already: the dialogs are answered from behind their own loops.
  bool taken = false;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, [&] {
    QWidget* shown = QApplication::activeModalWidget();
    if (auto* question = qobject_cast<QMessageBox*>(shown)) {
      if (!taken) shot.take_widget("save_over" + end, question);
      taken = true;
      question->reject();
    } else if (auto* dialog = qobject_cast<QFileDialog*>(shown)) {
      if (taken)
        dialog->reject();
      else
        QMetaObject::invokeMethod(dialog, "accept", Qt::QueuedConnection);
    }
  });
  answers.start(700);
  shot.window.action("save_as")->trigger();
}

void sizes(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into, {1024, 700});
    shot.open("style_transfer");
    shot.select("feet");
    shot.canvas().frame_all();
    shot.take("window_small" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk_of_the_second_actor_take_07": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "the_walk_after_the_third_rehearsal_on_monday": {"type": "Filter",
        "inputs": {"motion": "walk_of_the_second_actor_take_07.motion"}})");
    shot.select("the_walk_after_the_third_rehearsal_on_monday");
    shot.viewer().pin(1, "walk_of_the_second_actor_take_07");
    shot.viewer().pin(2, "the_walk_after_the_third_rehearsal_on_monday");
    shot.canvas().frame_all();
    shot.wait();
    shot.take("names" + end);
  }
}

}  // namespace

void message_pictures(const Theme& theme, const QDir& into, const QString& end) {
  troubles(theme, into, end);
  questions(theme, into, end);
  notices(theme, into, end);
  refusals(theme, into, end);
  rarer_dialogs(theme, into, end);
  sizes(theme, into, end);
}

}  // namespace kinegraph::shots
