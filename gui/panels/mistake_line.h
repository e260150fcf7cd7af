// Why what was typed above was not taken over: a badge and a sentence, hidden while there is nothing to say.
#pragma once
#include <QWidget>

class QLabel;

namespace kinegraph {

class MistakeLine : public QWidget {
 public:
  explicit MistakeLine(QWidget* parent);
  void say(const QString& why);  // empty: nothing
  bool says_something() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void draw_badge();
  QLabel *badge_, *words_;
};

}  // namespace kinegraph
