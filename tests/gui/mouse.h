// The mouse as a person holds it: pressed, moved in steps, let go.
#pragma once
#include <QPoint>
#include <Qt>
#include <functional>

class QSlider;
class QWidget;

namespace kinegraph::editor_test {

struct Drag {
  Qt::KeyboardModifiers keys = {};
  Qt::MouseButton button = Qt::LeftButton;
  int steps = 8;
  std::function<void()> meanwhile = {};  // before the button is let go
};
void drag(QWidget& widget, QPoint from, QPoint to, const Drag& how = {});

// Where a horizontal slider's handle stands for a value.
QPoint handle_of(const QSlider& slider, int value);

}  // namespace kinegraph::editor_test
