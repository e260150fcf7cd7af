// The editor's whole way, with mouse and keys alone: from an empty canvas to a file that the command line
// runs to the same bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <QToolButton>

#include "gui/components/component_edits.h"
#include "gui/components/components_grid.h"
#include "gui/viewer/shown_motion.h"
#include "gui/viewer/stage.h"
#include "gui/viewer/viewer.h"
#include "tests/gui/editor.h"
#include "tests/mocap.h"
#include "tests/places.h"

namespace kinegraph::editor_test {
namespace {

QByteArray bytes_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

struct FromNothing : Editor {
  FromNothing() : Editor(true) {
    for (int i = 0; i < 4; ++i) key(Qt::Key_Minus);
    settle();
  }
  // A node by Tab and a few letters, where the mouse is.
  std::string add_at(const QString& typed, int column, int row) {
    const int rows[] = {24, 124, 320};
    QTest::mouseMove(&canvas(), QPoint(62 + column * 124, rows[row] + 10));
    settle();
    const std::string name = add(typed);
    settle();
    return name;
  }
  void link(const std::string& from, const char* output, const std::string& to, const char* input) {
    drag(port(from, output, false), port(to, input, true));
    EXPECT_GE(links(to, input), 1u) << from << "." << output << " to " << to << "." << input;
  }
  void click(const std::string& node) {
    come_back();
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, middle(node));
    settle();
    ASSERT_EQ(session().current(), node);
  }
  template <class Widget>
  Widget* field(const char* param) {
    auto* row = window.findChild<QWidget*>(QString("param_") + param);
    return row ? row->findChild<Widget*>() : nullptr;
  }
  // With the button beside the field and the dialog that it opens.
  void choose_file(const std::string& node, const QString& path) {
    click(node);
    auto* button = field<QToolButton>("file");
    ASSERT_TRUE(button);
    name_file(path);
    QTest::mouseClick(button, Qt::LeftButton);
    settle();
  }
  void type_file(const std::string& node, const QString& path) {
    click(node);
    auto* line = field<QLineEdit>("file");
    ASSERT_TRUE(line);
    QTest::mouseClick(line, Qt::LeftButton);
    type(path);
    key(Qt::Key_Return);
  }
  Viewer& viewer() { return *window.findChild<Viewer*>(); }
  QImage stage() { return window.findChild<Stage*>()->grab().toImage(); }
  bool shows(const std::string& node) {
    return QTest::qWaitFor(
        [&] {
          const auto& shown = viewer().shown();
          return shown.size() == 1 && shown[0].target.node == node && shown[0].motion &&
                 !window.is_evaluating();
        },
        60000);
  }

  void whole_way(const QString& walk_clip, const QString& sneak_clip) {
    const std::string empty = session().text();
    const std::string walk = add_at("load", 0, 0), sneak = add_at("load", 0, 2);
    const std::string warp = add_at("timewarp", 1, 0), plants = add_at("detectcon", 1, 2);
    const std::string style = add_at("quatstats", 2, 2), transfer = add_at("styletr", 3, 0);
    const std::string unwarp = add_at("unwarp", 4, 0), feet = add_at("footsk", 4, 2);
    const std::string result = add_at("export", 5, 2);
    ASSERT_EQ(document().nodes.size(), 9u);
    link(walk, "motion", warp, "source");
    link(sneak, "motion", warp, "reference");
    link(warp, "reference", style, "motion");
    link(warp, "warped", transfer, "motion");
    link(style, "stats", transfer, "style");
    link(transfer, "motion", unwarp, "motion");
    link(warp, "warp", unwarp, "warp");
    link(walk, "motion", plants, "motion");
    link(unwarp, "motion", feet, "motion");
    link(plants, "contacts", feet, "contacts");
    link(feet, "motion", result, "motion");

    choose_file(walk, walk_clip);
    type_file(sneak, sneak_clip);
    type_file(result, "made.bvh");
    for (const Diagnostic& problem : session().problems())
      ASSERT_NE(problem.severity, Severity::error) << to_text(problem);

    // Live while the slider is dragged, and one step.
    click(transfer);
    ASSERT_TRUE(shows(transfer));
    settle();
    // Nothing stands there as failed that was mended.
    for (const auto& [name, unused] : document().nodes)
      if (const NodeStatus* status = window.evaluation().status(name)) {
        EXPECT_NE(status->state, NodeStatus::State::failed) << name;
      }
    const QImage before = stage();
    const ValuePtr plain = viewer().shown()[0].motion->value;
    auto* amount = field<QSlider>("amount");
    ASSERT_TRUE(amount);
    const std::size_t steps = session().history().position();
    drag_slider(*amount, amount->value() > amount->maximum() / 2 ? -40 : 40, [&] {
      // Another motion, and a picture of it, while the button is still down.
      EXPECT_TRUE(QTest::qWaitFor(
          [&] {
            const auto& shown = viewer().shown();
            return shown.size() == 1 && shown[0].motion && shown[0].motion->value != plain;
          },
          20000));
      EXPECT_TRUE(QTest::qWaitFor([&] { return stage() != before; }, 20000));
    });
    EXPECT_EQ(session().history().position(), steps + 1);
    ASSERT_TRUE(document().nodes.at(transfer).params.count("amount"));

    // Plays: the clip's frames go by and so do the pictures.
    ASSERT_TRUE(shows(transfer));
    const int frame = window.playback().frame();
    const QImage resting = stage();
    canvas().setFocus();
    key(Qt::Key_Space, Qt::ControlModifier);
    EXPECT_TRUE(window.playback().is_playing());
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.playback().frame() > frame + 5; }, 10000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return stage() != resting; }, 10000));
    key(Qt::Key_Space, Qt::ControlModifier);
    EXPECT_FALSE(window.playback().is_playing());

    pick_a_component(walk, sneak);

    const std::string built = session().text();
    int taken_back = 0;
    while (session().can_undo() && taken_back++ < 200) key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(session().text(), empty);
    while (session().can_redo() && taken_back-- > 0) key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(session().text(), built);

    // Ctrl+S asks for a name once.
    const QString path = folder.filePath("made.kg.json");
    canvas().setFocus();
    name_file(path);
    key(Qt::Key_S, Qt::ControlModifier);
    ASSERT_EQ(bytes_of(path).toStdString(), session().text());
    const std::string saved = session().text();
    EXPECT_FALSE(session().is_modified());
    key(Qt::Key_W, Qt::ControlModifier);
    ASSERT_TRUE(document().nodes.empty());
    name_file(path);
    key(Qt::Key_O, Qt::ControlModifier);
    ASSERT_EQ(session().text(), saved);
    EXPECT_FALSE(session().is_modified());

    // Run and kinegraph run.
    bool ran = false;
    QObject::connect(&window.evaluation(), &Evaluation::finished, &window,
                     [&](bool effects) { ran = ran || effects; });
    key(Qt::Key_F5);
    ASSERT_TRUE(QTest::qWaitFor([&] { return ran; }, 60000));
    const QByteArray here = bytes_of(folder.filePath("made.bvh"));
    ASSERT_GT(here.size(), 1000);
    ASSERT_TRUE(QFile::remove(folder.filePath("made.bvh")));
    QProcess run;
    run.setWorkingDirectory(folder.path());
    run.start(QString::fromStdString(bin_folder()) + "/kinegraph", {"run", path});
    ASSERT_TRUE(run.waitForFinished(60000));
    ASSERT_EQ(run.exitCode(), 0) << run.readAllStandardError().toStdString();
    EXPECT_TRUE(bytes_of(folder.filePath("made.bvh")) == here);
  }

  void pick_a_component(const std::string& walk, const std::string& sneak) {
    const std::string ica = add_at("ica", 0, 1);
    ASSERT_EQ(document().nodes.at(ica).type, "ICA");
    link(walk, "motion", ica, "motions");
    link(sneak, "motion", ica, "motions");
    ASSERT_EQ(links(ica, "motions"), 2u);
    click(ica);
    key(Qt::Key_5, Qt::ControlModifier);
    auto* grid = window.findChild<ComponentsGrid*>();
    ASSERT_TRUE(QTest::qWaitFor([&] { return grid->isVisible() && !grid->tile(1).isEmpty(); }, 60000));
    settle();
    QTest::mouseClick(grid, Qt::LeftButton, {}, grid->tile(1).center());
    QPushButton* take_away = nullptr;
    for (QPushButton* one : window.findChildren<QPushButton*>())
      if (one->text() == "Take away") take_away = one;
    ASSERT_TRUE(take_away && take_away->isEnabled());
    QTest::mouseClick(take_away, Qt::LeftButton);
    settle();
    std::string edit;
    for (const auto& [name, node] : document().nodes)
      if (node.type == "ComponentEdit") edit = name;
    ASSERT_FALSE(edit.empty());
    EXPECT_EQ(links(edit, "components"), 1u);
    EXPECT_EQ(amount_of(document().nodes.at(edit).params.at("edits"), "scale", 2), 0);
    // The dock lies before the timeline now; the graph has the keyboard again.
    key(Qt::Key_1, Qt::ControlModifier);
  }
};

TEST(EditorEndToEnd, AStyleTransferFromAnEmptyCanvasToTheSameBytesAsTheCommandLine) {
  FromNothing editor;
  const QString clips = QString::fromStdString(source_folder()) + "/graphs/clips/";  // made by Gait
  editor.whole_way(clips + "walk.bvh", clips + "sneak.bvh");
}

TEST(EditorEndToEnd, TheSameWithRealClips) {
  KINEGRAPH_NEEDS_MOCAP();
  FromNothing editor;
  editor.whole_way(QString::fromStdString(mocap("cmu/bvh/08_01.bvh")),
                   QString::fromStdString(mocap("cmu/bvh/08_07.bvh")));
}

}  // namespace
}  // namespace kinegraph::editor_test
