#include <QApplication>
#include <QCommandLineParser>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <cstdio>

#include "gui/look/editor_style.h"
#include "gui/window/main_window.h"
#include "gui/window/screenshot.h"
#include "nodes/all_nodes.h"

namespace {

std::string cache_folder() {
  const QString given = qEnvironmentVariable("KINEGRAPH_CACHE");
  if (!given.isEmpty()) return given.toStdString();
  const QString folder =
      QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/kinegraph";
  return QDir().mkpath(folder) ? folder.toStdString() : std::string();
}

int complain(const QString& text) {
  std::fprintf(stderr, "kinegraph-editor: %s\n", qPrintable(text));
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  QApplication::setApplicationName("kinegraph-editor");
  QApplication::setOrganizationName("kinegraph");
  QApplication::setApplicationVersion(KINEGRAPH_VERSION);
  QApplication::setStyle(new kinegraph::EditorStyle);

  QCommandLineParser options;
  options.setApplicationDescription("Edits Kinegraph's graphs of character motion.");
  options.addHelpOption();
  options.addVersionOption();
  options.addPositionalArgument("GRAPH", "the graph to open", "[GRAPH]");
  const QCommandLineOption screenshot("screenshot", "writes a picture of the window and ends", "FILE");
  const QCommandLineOption size("size", "of the window", "WxH", "1280x800");
  const QCommandLineOption node("node", "selects a node", "NAME");
  const QCommandLineOption dock("dock", "shows a dock", "NAME");
  const QCommandLineOption theme("theme", "dark or light", "NAME");
  options.addOptions({screenshot, size, node, dock, theme});
  options.process(application);

  const kinegraph::Registry registry = kinegraph::all_nodes();
  const bool picture = options.isSet(screenshot);
  kinegraph::MainWindow window(registry,
                               {.remember = !picture, .ask = !picture, .cache_folder = cache_folder()});
  if (options.isSet(theme)) {
    const QString name = options.value(theme);
    if (name != "dark" && name != "light") return complain("--theme is dark or light");
    window.set_theme(name == "dark" ? kinegraph::dark_theme() : kinegraph::light_theme());
  }
  const QStringList graphs = options.positionalArguments();
  if (graphs.size() > 1) return complain("one graph at a time");
  bool opened = true;
  if (!picture) window.show();
  if (!graphs.isEmpty())
    opened = window.open(graphs.first());
  else if (!picture)
    window.offer_autosave();
  if (options.isSet(dock)) {
    if (!window.dock_names().contains(options.value(dock), Qt::CaseInsensitive))
      return complain("there is no dock \"" + options.value(dock) + "\"; there are " +
                      window.dock_names().join(", "));
    window.show_dock(options.value(dock));
  }
  if (options.isSet(node)) {
    const std::string name = options.value(node).toStdString();
    if (!window.session().document().nodes.count(name))
      return complain("there is no node \"" + options.value(node) + "\"");
    window.session().select({name}, name);
  }
  if (!picture) return QApplication::exec();

  const QStringList sides = options.value(size).split('x');
  const QSize wanted = sides.size() == 2 ? QSize(sides[0].toInt(), sides[1].toInt()) : QSize();
  if (wanted.width() < 320 || wanted.height() < 240)
    return complain("--size is WIDTHxHEIGHT, at least 320x240");
  if (!kinegraph::take_screenshot(window, options.value(screenshot), wanted))
    return complain("can't write " + QFileInfo(options.value(screenshot)).absoluteFilePath());
  return opened ? 0 : 3;
}
