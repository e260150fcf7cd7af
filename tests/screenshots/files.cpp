// Pictures of what happens to files: those that are gone, that others change, that can't be written, and many
// at once.
#include <sys/fsuid.h>
#include <unistd.h>

#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QProgressBar>
#include <QPushButton>
#include <filesystem>
#include <fstream>

#include "graph/edit.h"
#include "graph/file/write.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/look/ask_file.h"
#include "gui/look/settings.h"
#include "gui/window/relink_dialog.h"
#include "tests/gui/long_row.h"
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {
namespace {

// A project as people have them, of one name at every run.
struct Project {
  Project() : path(QDir::temp().filePath("sneak_tests")) {
    QDir(path).removeRecursively();
    for (const char* folder : {"clips", "renders", "pipelines"}) QDir().mkpath(path + "/" + folder);
    for (const char* name : {"sneaky_walk", "style_transfer", "component_edit", "pipelines/sneakify"})
      QFile::copy(Shot::example(name), path + "/" + QString(name) + ".kg.json");
    const QString clips = QString::fromStdString(source_folder()) + "/graphs/clips";
    for (const QString& clip : QDir(clips).entryList(QDir::Files))
      QFile::copy(clips + "/" + clip, path + "/clips/" + clip);
    // A morning's work in March.
    using namespace std::chrono;
    auto time = file_clock::from_sys(system_clock::time_point(sys_days(year(2026) / 3 / 9) + 9h));
    for (const char* name : {"clips", "renders", "pipelines", "sneaky_walk.kg.json", "style_transfer.kg.json",
                             "component_edit.kg.json"}) {
      std::error_code ignored;
      std::filesystem::last_write_time((path + "/" + name).toStdString(), time += 23min, ignored);
    }
  }
  ~Project() { QDir(path).removeRecursively(); }
  QString file(const QString& name) const { return path + "/" + name; }
  QString path;
};

void press_notice(Shot& shot, const QString& words) {
  for (QPushButton* button : shot.window.findChild<QWidget*>("notice_bar")->findChildren<QPushButton*>())
    if (button->isVisible() && button->text().startsWith(words)) {
      button->click();
      return;
    }
  qWarning("no button %s", qPrintable(words));
}

void change(const QString& path, const QByteArray& from, const QByteArray& to) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return;
  QByteArray text = file.readAll();
  file.close();
  text.replace(from, to);
  if (file.open(QIODevice::WriteOnly)) file.write(text);
}

void dialogs(const Theme& theme, const QDir& into, const QString& end) {
  Project project;
  Shot shot(theme, into);
  shot.window.open(project.file("sneaky_walk.kg.json"));
  shot.wait();
  shot.take_popup("file_dialog" + end, [&] { shot.window.action("open")->trigger(); });
  shot.take_popup("save_dialog" + end, [&] { shot.window.action("save_as")->trigger(); });
  shot.take_popup("folder_dialog" + end,
                  [&] { ask_for_folder(&shot.window, "Look in a folder", project.path); });
  shot.session().select({"walk", "sneak"}, "sneak");
  shot.take_popup("collapse_dialog" + end, [&] { shot.window.action("collapse")->trigger(); });
}

void unsavable(const Theme& theme, const QDir& into, const QString& end) {
  Project project;
  const QString path = project.file("pipelines/sneakify.kg.json"), folder = project.file("pipelines");
  Shot shot(theme, into);
  shot.window.open(path);
  shot.wait();
  shot.session().perform(
      [](const Document& d, const Registry&) { return set_note(d, d.nodes.begin()->first, "calmer"); });
  // Root may write everywhere: somebody else tries.
  QFile::setPermissions(folder, QFile::ReadOwner | QFile::ExeOwner | QFile::ReadOther | QFile::ExeOther);
  const uid_t before = ::geteuid();
  ::setfsuid(before ? before : 65534);
  QTimer::singleShot(300, [before] { ::setfsuid(before); });  // it was tried by then
  shot.take_popup("save_read_only" + end, [&] { shot.window.action("save")->trigger(); });
  ::setfsuid(before);
  QDir(folder).removeRecursively();
  shot.wait(1200);
  shot.take_popup("save_failed" + end, [&] { shot.window.action("save")->trigger(); });
}

void gone(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    const QString path = shot.text(R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})");
    QFile::remove(path);
    shot.wait(1200);
    shot.take("graph_gone" + end);
  }
  {
    Shot shot(theme, into);
    shot.text(R"("walk": {"type": "Load", "params": {"file": "takes/walk_calm.bvh"}},
      "sneak": {"type": "Load", "params": {"file": "takes/sneak_low.bvh"}},
      "style": {"type": "MotionStats", "inputs": {"motion": "sneak.motion"}})");
    shot.take("missing_several" + end);
    shot.take_popup(
        "relink_nothing" + end, [&] { shot.window.action("relink")->trigger(); }, 2500);
    // A folder that takes a while to look through.
    KnownFiles known;
    RelinkDialog dialog(shot.session(), known, missing_files(shot.session()), &shot.window);
    dialog.search({"/usr"});
    shot.take_popup(
        "relink_searching" + end, [&] { dialog.exec(); }, 400);
  }
}

void of_others(const Theme& theme, const QDir& into, const QString& end) {
  const char* const nodes = R"("walk": {"type": "Load", "params": {"file": "clips/walk.bvh"}},
      "soft": {"type": "Filter", "inputs": {"motion": "walk.motion"}})";
  {
    Shot first(theme, into);
    const QString path = first.text(nodes);
    Shot second(theme, into);
    second.window.open(path);
    second.wait();
    second.take("open_elsewhere" + end);
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(nodes);
    shot.session().perform([](const Document& d, const Registry& r) {
      return set_param(d, r, "walk", "file", "clips/run.bvh");
    });
    change(path, "\"Filter\",", "\"Filter\", \"note\": \"calmer\",");
    shot.wait(1200);
    press_notice(shot, "Merge");
    shot.wait();
    shot.take("merged" + end);
    change(path, "walk.bvh", "strut.bvh");
    shot.wait(1200);
    press_notice(shot, "Merge");
    shot.wait();
    shot.take("merge_conflict" + end);
    shot.take_popup("conflicts" + end, [&] { press_notice(shot, "Choose"); });
  }
  {
    // What a session left that ended without a word.
    Shot shot(theme, into);
    const QString path = shot.in_shot("example.kg.json");
    for (const char* beside : {"clips", "characters"})
      QFile::link(QString::fromStdString(source_folder()) + "/graphs/" + beside, shot.in_shot(beside));
    for (const QString& name : {path, shot.in_shot(".example.kg.json.autosave")})
      std::ofstream(name.toStdString())
          << R"({"format": "kinegraph", "schema": 1, "nodes": {)" << nodes
          << (name == path ? "" : R"(, "late": {"type": "Mirror", "inputs": {"motion": "soft.motion"}})")
          << "}}\n";
    shot.window.open(path);
    shot.wait();
    shot.take("autosave" + end);
    shot.session().discard_found();
  }
  {
    Shot shot(theme, into);
    const QString path = shot.text(nodes);
    change(path, "\"schema\": 1", "\"schema\": 99");
    shot.wait(1200);
    shot.take("newer_on_disk" + end);
  }
}

void long_work(const Theme& theme, const QDir& into, const QString& end) {
  {
    Shot shot(theme, into);
    shot.text(R"("long_walk": {"type": "Gait"}, "long_sneak": {"type": "Gait", "params": {"gait": "sneak"}},
      "warp": {"type": "TimeWarp", "inputs": {"source": "long_walk.motion", "reference": "long_sneak.motion"}},
      "out": {"type": "Export", "params": {"file": "in_step.bvh"}, "inputs": {"motion": "warp.warped"}})");
    for (const char* name : {"long_walk", "long_sneak"})
      shot.session().perform(
          [name](const Document& d, const Registry& r) { return set_param(d, r, name, "seconds", 400.0); });
    shot.window.action("run")->trigger();
    QElapsedTimer clock;
    for (clock.start(); clock.elapsed() < 30000;) {
      QApplication::processEvents(QEventLoop::AllEvents, 20);
      const NodeStatus* warp = shot.window.evaluation().status("warp");
      if (warp && warp->state == NodeStatus::State::running && warp->progress > 0.15) break;
    }
    shot.take("run_under_way" + end);
    shot.window.action("cancel")->trigger();
    shot.wait();
    shot.take("run_cancelled" + end);
  }
  {
    Shot shot(theme, into);
    const std::string inside = long_row();
    // Six parts of ten pieces each.
    shot.in_shot("x");
    const auto write = [&](const std::string& name, const std::string& text) {
      std::ofstream(shot.in_shot(QString::fromStdString(name)).toStdString()) << text;
    };
    const auto graph_node = [](const std::string& name) {
      return "\"" + name + R"(": {"type": "Graph", "params": {"file": ")" + name + ".kg.json\"}}";
    };
    std::string nodes;
    for (int part = 0; part < 6; ++part) {
      std::string of_part;
      for (int piece = 0; piece < 10; ++piece) {
        const std::string name = "piece_" + std::to_string(part) + std::to_string(piece);
        write(name + ".kg.json", inside);
        of_part += (piece ? "," : "") + graph_node(name);
      }
      const std::string name = "part_" + std::to_string(part);
      write(name + ".kg.json", R"({"format": "kinegraph", "schema": 1, "nodes": {)" + of_part + "}}");
      nodes += (part ? "," : "") + graph_node(name);
    }
    shot.text(QByteArray::fromStdString(nodes));
    shot.session().reopen_inside();
    QElapsedTimer clock;
    const auto* bar = shot.window.findChild<QProgressBar*>();
    for (clock.start(); clock.elapsed() < 10000 && !bar->isVisible();)
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    shot.take("reading_inside" + end);
    shot.window.action("cancel")->trigger();
    QApplication::processEvents();
    shot.take("reading_cancelled" + end);
  }
}

void many(const Theme& theme, const QDir& into, const QString& end) {
  Shot shot(theme, into);
  const auto note = [&] {
    shot.session().perform(
        [](const Document& d, const Registry&) { return set_note(d, d.nodes.begin()->first, "calmer"); });
  };
  for (const char* name : {"sneaky_walk", "style_transfer", "cartoon_walk"}) {
    shot.open(name);
    if (QString(name) != "style_transfer") note();
  }
  shot.take("tabs" + end);
  shot.take_popup("unsaved_several" + end, [&] { shot.window.close(); });
  for (const char* name : {"component_edit", "component_transfer", "component_between", "representations",
                           "face", "explosion", "cartoon_run", "cartoon_kick", "feet"})
    shot.open(name);
  shot.take("tabs_many" + end);
  shot.session().show_page(0);
  shot.wait();
  shot.canvas().add("Filter", {260, 200});
  shot.session().undo();
  shot.take_popup("menu_edit_steps" + end, [&] {
    shot.window.menuBar()->actions()[1]->menu()->popup(shot.window.mapToGlobal(QPoint(60, 24)));
  });
  for (int i = 0; i < shot.session().pages(); ++i) {
    shot.session().show_page(i);
    shot.session().discard_autosave();
  }
}

void remembered(const Theme& theme, const QDir& into, const QString& end) {
  Project project;
  QTemporaryDir folder;
  qputenv("KINEGRAPH_SETTINGS", folder.filePath("settings.ini").toLocal8Bit());
  {
    QStringList recent;
    for (const char* name : {"style_transfer", "sneaky_walk", "pipelines/sneakify", "component_edit"})
      recent << project.file(QString(name) + ".kg.json");
    const auto settings = user_settings();
    settings->setValue("recent", recent);
    settings->setValue("window/theme", theme.dark ? "dark" : "light");
  }
  Shot shot(theme, into, {1280, 800}, true);
  shot.take("welcome_recent" + end);
  for (QMenu* menu : shot.window.findChildren<QMenu*>())
    if (QString(menu->title()).remove('&') == "Open recent")
      shot.take_popup("menu_recent_filled" + end, [menu] { menu->popup(QPoint(40, 40)); });
  qunsetenv("KINEGRAPH_SETTINGS");
}

}  // namespace

void file_pictures(const Theme& theme, const QDir& into, const QString& end) {
  dialogs(theme, into, end);
  unsavable(theme, into, end);
  gone(theme, into, end);
  of_others(theme, into, end);
  long_work(theme, into, end);
  many(theme, into, end);
  remembered(theme, into, end);
}

}  // namespace kinegraph::shots
