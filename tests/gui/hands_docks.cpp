// The gestures of the docks beside: components, files, and a colleague who saves the same file.
#include <QDir>
#include <QDropEvent>
#include <QFile>
#include <QMimeData>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QTreeWidget>
#include <QUrl>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "gui/components/components_grid.h"
#include "tests/gui/hands.h"

namespace kinegraph::editor_test {
namespace {

// The components of the ICA, with so many chosen; null: they aren't there.
ComponentsGrid* components(Hands& hands, int count) {
  if (!hands.choose("ica")) return nullptr;
  hands.window.show_dock("Components");
  auto* grid = hands.window.findChild<ComponentsGrid*>();
  if (!QTest::qWaitFor([&] { return grid->isVisible() && !grid->visibleRegion().isEmpty(); }, 5000))
    return nullptr;
  const int first = hands.below(3);
  for (int i = 0; i < count; ++i)
    hands.click(*grid, grid->tile((first + i) % 3).center(), i ? Qt::ControlModifier : Qt::NoModifier);
  return grid;
}

bool press(Hands& hands, const char* text) {
  for (auto* button : hands.window.findChildren<QPushButton*>())
    if (button->text() == text && button->isVisible() && button->isEnabled()) {
      hands.click(*button, button->rect().center());
      return true;
    }
  return false;
}

bool take_component_away(Hands& hands) {
  return components(hands, 1) && press(hands, "Take away");
}

bool component_slider(Hands& hands, const char* name) {
  if (!components(hands, 1)) return false;
  for (auto* slider : hands.window.findChildren<QSlider*>())
    if (slider->accessibleName() == name && slider->isEnabled()) {
      hands.drag_slider(*slider);
      return true;
    }
  return false;
}

bool scale_component(Hands& hands) {
  return component_slider(hands, "Scale");
}
bool translate_component(Hands& hands) {
  return component_slider(hands, "Translate");
}
bool merge_components(Hands& hands) {
  return components(hands, 2) && press(hands, "Merge");
}
bool transfer_component(Hands& hands) {
  return components(hands, 1) && press(hands, "Transfer");
}

bool add_clip(Hands& hands) {
  if (!hands.few()) return false;
  hands.window.show_dock("Files");
  Hands::settle();
  auto* tree = hands.window.findChild<QTreeWidget*>("file_tree");
  const auto found = tree->findItems("clips/walk.bvh", Qt::MatchExactly | Qt::MatchRecursive);
  if (found.isEmpty()) return false;
  tree->setCurrentItem(found.front());
  tree->setFocus();
  hands.key(Qt::Key_Return);
  return true;
}

bool drop_clip(Hands& hands) {
  const QPoint at = hands.empty_place();
  if (!hands.few() || at.isNull()) return false;
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QDir(hands.folder).filePath("clips/walk.bvh"))});
  QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(&hands.canvas(), &enter);
  QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(&hands.canvas(), &drop);
  Hands::settle();
  return true;
}

// Somebody else saves the file with another note on a node, and it is merged in.
bool merge_from_disk(Hands& hands) {
  const Session& session = hands.session();
  ReadResult theirs = read_document(session.text_on_disk(), session.path().toStdString(), session.registry());
  theirs.document.nodes.at("judge").note = "theirs " + std::to_string(hands.below(100000));
  const std::string text = write_document(theirs.document, session.registry());
  QFile file(session.path());
  if (!file.open(QIODevice::WriteOnly)) return false;
  file.write(text.data(), qint64(text.size()));
  file.close();
  auto* notice = hands.window.findChild<QWidget*>("notice_bar");
  QPushButton* merge = nullptr;
  const bool offered = QTest::qWaitFor(
      [&] {
        for (auto* button : notice->findChildren<QPushButton*>())
          if (button->text() == "Merge it in" && button->isVisible()) merge = button;
        return merge != nullptr;
      },
      5000);
  if (!offered) return false;
  hands.click(*merge, merge->rect().center());
  const bool merged = QTest::qWaitFor([&] { return session.text_on_disk() == text; }, 1000);
  QTest::qWait(210);  // until the file is watched again
  return merged;
}

}  // namespace

std::vector<Gesture> dock_gestures() {
  return {
      {"take a component away", take_component_away},
      {"scale a component", scale_component},
      {"translate a component", translate_component},
      {"merge components", merge_components},
      {"transfer a component", transfer_component},
      {"add a clip of the files", add_clip},
      {"drop a clip", drop_clip},
      {"merge what changed on disk", merge_from_disk},
  };
}

}  // namespace kinegraph::editor_test
