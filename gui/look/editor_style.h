// Qt's Fusion with the editor's own signs: ticks, the icons of file dialogs, message boxes and docks,
// progress bars, and the ring around what has the keyboard, all drawn in the theme's ink so that they are
// sharp at any resolution.
#pragma once
#include <QProxyStyle>

namespace kinegraph {

class EditorStyle : public QProxyStyle {
  Q_OBJECT

 public:
  EditorStyle();

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget = nullptr) const override;
  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget = nullptr) const override;
  QIcon standardIcon(StandardPixmap standard, const QStyleOption* option = nullptr,
                     const QWidget* widget = nullptr) const override;
  QPixmap standardPixmap(StandardPixmap standard, const QStyleOption* option = nullptr,
                         const QWidget* widget = nullptr) const override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option = nullptr,
                  const QWidget* widget = nullptr) const override;
};

}  // namespace kinegraph
