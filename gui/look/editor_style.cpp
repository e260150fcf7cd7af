#include "gui/look/editor_style.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QDateTime>
#include <QPainter>
#include <QStyleFactory>
#include <QStyleOption>
#include <QTimer>
#include <algorithm>
#include <optional>

#include "gui/look/icons.h"

namespace kinegraph {
namespace {

constexpr int bar_height = 8, there_and_back_ms = 2400, busy_step_ms = 33;

// The one whose palette the application has.
const Theme& theme_now() {
  return QApplication::palette().color(QPalette::Window).lightness() < 128 ? dark_theme() : light_theme();
}

std::optional<Sign> sign_of(QStyle::StandardPixmap standard) {
  switch (standard) {
    case QStyle::SP_MessageBoxInformation:
      return Sign::info;
    case QStyle::SP_MessageBoxQuestion:
      return Sign::question;
    case QStyle::SP_MessageBoxWarning:
      return Sign::warning;
    case QStyle::SP_MessageBoxCritical:
      return Sign::error;
    case QStyle::SP_DialogApplyButton:
      return Sign::done;
    case QStyle::SP_TitleBarNormalButton:
    case QStyle::SP_TitleBarMaxButton:
      return Sign::dock_out;
    case QStyle::SP_TitleBarCloseButton:
    case QStyle::SP_DockWidgetCloseButton:
    case QStyle::SP_LineEditClearButton:
      return Sign::remove;
    case QStyle::SP_DirIcon:
    case QStyle::SP_DirOpenIcon:
    case QStyle::SP_DirClosedIcon:
    case QStyle::SP_DirLinkIcon:
    case QStyle::SP_DirLinkOpenIcon:
      return Sign::folder;
    case QStyle::SP_FileIcon:
    case QStyle::SP_FileLinkIcon:
      return Sign::file;
    case QStyle::SP_DirHomeIcon:
      return Sign::home;
    case QStyle::SP_ComputerIcon:
    case QStyle::SP_DesktopIcon:
    case QStyle::SP_DriveHDIcon:
    case QStyle::SP_DriveNetIcon:
    case QStyle::SP_DriveCDIcon:
      return Sign::computer;
    case QStyle::SP_ArrowBack:
    case QStyle::SP_FileDialogBack:
      return Sign::back;
    case QStyle::SP_ArrowForward:
      return Sign::forward;
    case QStyle::SP_FileDialogToParent:
      return Sign::up;
    case QStyle::SP_FileDialogNewFolder:
      return Sign::new_folder;
    case QStyle::SP_FileDialogListView:
      return Sign::list;
    case QStyle::SP_FileDialogDetailedView:
      return Sign::details;
    default:
      return {};
  }
}

void draw_tick(QPainter& painter, QRectF box, const QColor& ink) {
  painter.setPen(QPen(ink, 0.14 * box.width(), Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  const auto at = [&](double x, double y) {
    return box.topLeft() + QPointF(x * box.width(), y * box.height());
  };
  painter.drawPolyline(QPolygonF({at(0.22, 0.53), at(0.43, 0.73), at(0.79, 0.29)}));
}

// A square with room around it, in the middle of the place that the style gives.
QRectF square_in(const QRect& place, double side) {
  QRectF box(0, 0, side, side);
  box.moveCenter(QRectF(place).center());
  return box;
}

void draw_check_box(QPainter& painter, const QStyleOption& option, bool round) {
  const Theme& theme = theme_now();
  const QRectF box = square_in(option.rect, std::min(option.rect.width(), option.rect.height()) - 1);
  const bool usable = option.state & QStyle::State_Enabled;
  const bool on = option.state & (QStyle::State_On | QStyle::State_NoChange);
  const QColor accent = usable ? theme.accent : theme.faint_text;
  const QColor edge = on                                                 ? accent
                      : usable && option.state & QStyle::State_MouseOver ? theme.accent
                                                                         : theme.faint_text;
  painter.setPen(QPen(edge, 1));
  painter.setBrush(on ? accent : theme.panel);
  const double corner = round ? box.width() / 2 : 3;
  painter.drawRoundedRect(box, corner, corner);
  if (option.state & QStyle::State_On && round) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme.window);
    painter.drawEllipse(box.center(), box.width() / 5, box.width() / 5);
  } else if (option.state & QStyle::State_On) {
    draw_tick(painter, box, theme.window);
  } else if (option.state & QStyle::State_NoChange) {
    painter.setPen(QPen(theme.window, 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(box.center() - QPointF(box.width() / 4, 0), box.center() + QPointF(box.width() / 4, 0));
  }
}

// A round track; where the length isn't known something runs to and fro in it.
void draw_progress(QPainter& painter, const QStyleOptionProgressBar& bar, const QWidget* widget) {
  const Theme& theme = theme_now();
  const QRectF place(bar.rect);
  QRectF track(place.left() + 0.5, place.center().y() - bar_height / 2 + 0.5, place.width() - 1,
               bar_height - 1);
  painter.setPen(QPen(theme.line, 1));
  painter.setBrush(theme.panel);
  painter.drawRoundedRect(track, track.height() / 2, track.height() / 2);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.accent);
  QRectF done = track.adjusted(1, 1, -1, -1);
  if (bar.maximum > bar.minimum) {
    const double share = double(bar.progress - bar.minimum) / (bar.maximum - bar.minimum);
    if (share <= 0) return;
    done.setWidth(std::max(done.height(), done.width() * std::min(share, 1.0)));
  } else {
    const double there = double(QDateTime::currentMSecsSinceEpoch() % there_and_back_ms) / there_and_back_ms;
    const double at = there < 0.5 ? 2 * there : 2 - 2 * there, wide = done.width() * 0.3;
    done =
        QRectF(done.left() + at * at * (3 - 2 * at) * (done.width() - wide), done.top(), wide, done.height());
    if (auto* moving = const_cast<QWidget*>(widget))
      QTimer::singleShot(busy_step_ms, moving, qOverload<>(&QWidget::update));
  }
  painter.drawRoundedRect(done, done.height() / 2, done.height() / 2);
}

}  // namespace

EditorStyle::EditorStyle() : QProxyStyle(QStyleFactory::create("Fusion")) {}

void EditorStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                const QWidget* widget) const {
  // Buttons, lines and the like show the keyboard by their edge.
  if (element == PE_FrameFocusRect && !qobject_cast<const QAbstractItemView*>(widget)) return;
  if (element != PE_IndicatorCheckBox && element != PE_IndicatorItemViewItemCheck &&
      element != PE_IndicatorMenuCheckMark && element != PE_IndicatorRadioButton &&
      element != PE_FrameFocusRect)
    return QProxyStyle::drawPrimitive(element, option, painter, widget);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  if (element == PE_FrameFocusRect) {
    painter->setPen(QPen(theme_now().accent, 1));
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(QRectF(option->rect).adjusted(-4.5, -1.5, 4.5, 1.5), 3, 3);
  } else if (element == PE_IndicatorMenuCheckMark) {
    if (option->state & State_On) draw_tick(*painter, square_in(option->rect, 14), theme_now().text);
  } else {
    draw_check_box(*painter, *option, element == PE_IndicatorRadioButton);
  }
  painter->restore();
}

void EditorStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                              const QWidget* widget) const {
  const auto* bar = qstyleoption_cast<const QStyleOptionProgressBar*>(option);
  if (bar && (element == CE_ProgressBarGroove || element == CE_ProgressBarLabel)) return;
  if (!bar || (element != CE_ProgressBar && element != CE_ProgressBarContents))
    return QProxyStyle::drawControl(element, option, painter, widget);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  draw_progress(*painter, *bar, widget);
  painter->restore();
}

QIcon EditorStyle::standardIcon(StandardPixmap standard, const QStyleOption* option,
                                const QWidget* widget) const {
  if (const auto sign = sign_of(standard)) return icon(*sign, theme_now());
  return QProxyStyle::standardIcon(standard, option, widget);
}

QPixmap EditorStyle::standardPixmap(StandardPixmap standard, const QStyleOption* option,
                                    const QWidget* widget) const {
  if (const auto sign = sign_of(standard)) return icon(*sign, theme_now()).pixmap(16);
  return QProxyStyle::standardPixmap(standard, option, widget);
}

int EditorStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
  switch (metric) {
    case PM_IndicatorWidth:
    case PM_IndicatorHeight:
    case PM_ExclusiveIndicatorWidth:
    case PM_ExclusiveIndicatorHeight:
      return 16;
    case PM_MessageBoxIconSize:
      return 32;
    default:
      return QProxyStyle::pixelMetric(metric, option, widget);
  }
}

}  // namespace kinegraph
