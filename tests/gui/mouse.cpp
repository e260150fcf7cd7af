#include "tests/gui/mouse.h"

#include <QApplication>
#include <QMouseEvent>
#include <QSlider>
#include <QStyle>
#include <QTest>

namespace kinegraph::editor_test {

void drag(QWidget& widget, QPoint from, QPoint to, const Drag& how) {
  QTest::mousePress(&widget, how.button, how.keys, from);
  for (int i = 1; i <= how.steps; ++i) {
    const QPoint at = from + (to - from) * i / how.steps;
    QMouseEvent event(QEvent::MouseMove, at, widget.mapToGlobal(at), Qt::NoButton, how.button, how.keys);
    QApplication::sendEvent(&widget, &event);
  }
  if (how.meanwhile) how.meanwhile();
  QTest::mouseRelease(&widget, how.button, how.keys, to);
}

QPoint handle_of(const QSlider& slider, int value) {
  const int handle = slider.style()->pixelMetric(QStyle::PM_SliderLength, nullptr, &slider);
  return {
      QStyle::sliderPositionFromValue(slider.minimum(), slider.maximum(), value, slider.width() - handle) +
          handle / 2,
      slider.height() / 2};
}

}  // namespace kinegraph::editor_test
