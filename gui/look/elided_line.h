// A line that is typed into and, while the keyboard is elsewhere, ends in "…" where it has no room for all of
// its words; the tool tip has them all then.
#pragma once
#include <QLineEdit>

namespace kinegraph {

class ElidedLine : public QLineEdit {
 public:
  using QLineEdit::QLineEdit;
  // Of a path the middle goes, of words the end.
  void set_elide(Qt::TextElideMode mode) { mode_ = mode; }
  bool is_cut() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRect room() const;
  Qt::TextElideMode mode_ = Qt::ElideRight;
};

}  // namespace kinegraph
