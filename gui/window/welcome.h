// What an empty graph says: how to begin, and the graphs that were open last and the examples as small
// pictures of them.
#pragma once
#include <QLabel>
#include <QWidget>
#include <vector>

#include "graph/registry.h"
#include "gui/look/theme.h"

class QScrollArea;

namespace kinegraph {

class ExampleCard;

class Welcome : public QWidget {
  Q_OBJECT

 public:
  // Lies over the canvas; what isn't a card lets the mouse through to it. The registry outlives this.
  Welcome(QWidget* canvas, const Registry& registry);
  void set_theme(const Theme& theme);
  void show_where(bool empty);
  void show_recent(const QStringList& paths);  // before the examples

 signals:
  void chosen(const QString& path);

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Group {
    QLabel* heading;
    std::vector<ExampleCard*> cards;
  };
  void fill();  // reads the examples, once they are to be seen
  void add_group(const QString& title, const QStringList& paths, const QStringList& words);
  void place();

  const Registry& registry_;
  const Theme* theme_;
  QScrollArea* scroll_;
  QWidget* page_;  // of the scroll area
  std::vector<Group> groups_;
  QStringList recent_;
  bool filled_ = false;
};

}  // namespace kinegraph
