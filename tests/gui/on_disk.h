// An editor with a graph of the examples on disk, its clips beside it, that tests change behind its back.
#pragma once
#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QPushButton>

#include "graph/edit.h"
#include "tests/gui/editor.h"
#include "tests/places.h"

namespace kinegraph::editor_test {

inline QString example_graphs() {
  return QString::fromStdString(source_folder()) + "/graphs/";
}

struct OnDisk : Editor {
  explicit OnDisk(bool ask = false) : Editor(ask), path(folder.filePath("main.kg.json")) {
    QDir(folder.path()).mkpath("clips");
    EXPECT_TRUE(QFile::copy(example_graphs() + "sneaky_walk.kg.json", path));
    for (const QFileInfo& clip : QDir(example_graphs() + "clips").entryInfoList(QDir::Files))
      QFile::copy(clip.absoluteFilePath(), folder.filePath("clips/" + clip.fileName()));
    EXPECT_TRUE(window.open(path));
    canvas().setFocus();
    settle();
  }
  void rewrite(const std::string& text) {
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(text.data(), qint64(text.size()));
  }
  void set_note(const std::string& note) {
    session().perform([&](const Document& d, const Registry&) {
      return kinegraph::set_note(d, d.nodes.begin()->first, note);
    });
  }
  std::string note() { return document().nodes.begin()->second.note; }
  QWidget* notice() { return window.findChild<QWidget*>("notice_bar"); }
  bool answer(const QString& text) {
    for (QPushButton* button : notice()->findChildren<QPushButton*>())
      if (button->text() == text && button->isVisible()) {
        QTest::mouseClick(button, Qt::LeftButton);
        settle();
        return true;
      }
    return false;
  }
  QString path;
};

}  // namespace kinegraph::editor_test
