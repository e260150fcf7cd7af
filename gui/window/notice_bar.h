// A line across the window that says what happened and what can be done about it, without standing in the
// way.
#pragma once
#include <QFrame>
#include <QString>
#include <QTimer>
#include <functional>
#include <vector>

class QLabel;
class QHBoxLayout;
class QToolButton;

namespace kinegraph {

class NoticeBar : public QFrame {
  Q_OBJECT

 public:
  struct Answer {
    QString text;
    std::function<void()> act;
  };
  enum class Kind { info, good, warning, error };
  explicit NoticeBar(QWidget* parent = nullptr);
  // `seconds` 0 = until it is answered or replaced.
  void say(Kind kind, const QString& message, std::vector<Answer> answers = {}, int seconds = 0);

  // What the words that stand here are about, so that they go once it is settled elsewhere.
  void set_topic(const char* topic) { topic_ = topic; }
  void done_with(const char* topic) {
    if (topic_ == topic) hide();
  }

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void draw_sign();
  void set_words();

  Kind kind_ = Kind::info;
  QString topic_;
  QLabel* sign_;
  QLabel* label_;
  QToolButton* close_;
  QHBoxLayout* layout_;
  std::vector<QWidget*> buttons_;
  QTimer timer_;
};

}  // namespace kinegraph
