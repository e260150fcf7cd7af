// How the graph stands, at the end of the status line: a dot in the colour of what is said, and the words.
#pragma once
#include <QLabel>

#include "gui/evaluation/standing.h"
#include "gui/look/theme.h"

namespace kinegraph {

class StateLine : public QLabel {
  Q_OBJECT

 public:
  explicit StateLine(QWidget* parent = nullptr);
  void say(const Standing& standing);
  void set_theme(const Theme& theme);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const Theme* theme_;
  Standing::Tone tone_ = Standing::Tone::quiet;
};

}  // namespace kinegraph
