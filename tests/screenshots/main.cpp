// Writes the pictures of docs/editor: every port type, node state, dock, dialog, error and empty state.
//   editor_screenshots FOLDER dark|light|qpainter [PART…]
//   editor_screenshots FOLDER scaled END
// PART: graph, viewer, stage, docks, menus, messages, files; all of them where none is given.
#include <QStandardPaths>
#include <cstdio>

#include "gui/look/editor_style.h"
#include "tests/screenshots/shots.h"

int main(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QApplication::setApplicationName("kinegraph-editor");
  QApplication::setApplicationVersion(KINEGRAPH_VERSION);
  QApplication::setStyle(new kinegraph::EditorStyle);
  if (argc < 3) {
    std::fprintf(stderr, "editor_screenshots FOLDER dark|light|qpainter [PART…] or FOLDER scaled END\n");
    return 2;
  }
  using namespace kinegraph;
  const QDir into(argv[1]);
  const QString what = argv[2];
  QDir().mkpath(into.path());
  if (what == "scaled" && argc > 3) {
    // With QT_SCALE_FACTOR in the environment: the same windows with more pixels.
    for (const Theme* theme : {&dark_theme(), &light_theme()}) {
      const QString end = (theme->dark ? "_" : "_light_") + QString(argv[3]);
      shots::Shot shot(*theme, into, {1280, 800});
      shot.open("component_edit");
      shot.select("edit");
      shot.dock("Components");
      shot.wait(1500);
      shot.take("window" + end);
    }
    return 0;
  }
  if (what == "qpainter") {
    // With QT_QPA_PLATFORM=offscreen in the environment: what is seen where there is no OpenGL.
    shots::viewer_pictures(dark_theme(), into, "_qpainter");
    shots::viewer_pictures(light_theme(), into, "_qpainter_light");
    return 0;
  }
  const Theme& theme = what == "light" ? light_theme() : dark_theme();
  const QString end = what == "light" ? "_light" : "";
  const QStringList wanted = QApplication::arguments().mid(3);
  using Take = void (*)(const Theme&, const QDir&, const QString&);
  const std::pair<const char*, Take> parts[] = {
      {"graph", shots::graph_pictures}, {"viewer", shots::viewer_pictures},
      {"stage", shots::stage_pictures}, {"docks", shots::dock_pictures},
      {"menus", shots::menu_pictures},  {"messages", shots::message_pictures},
      {"files", shots::file_pictures}};
  for (const auto& [part, take] : parts)
    if (wanted.isEmpty() || wanted.contains(part)) take(theme, into, end);
  return 0;
}
