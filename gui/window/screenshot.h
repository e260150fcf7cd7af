// Pictures of the window for tests and documentation: everything visible evaluated, drawn at a size.
#pragma once
#include <QSize>
#include <QString>

#include "gui/window/main_window.h"

namespace kinegraph {

// Handles events until what is looked at is evaluated and drawn, and nothing more came for a while.
void wait_until_drawn(MainWindow& window, int settle_ms = 700);

// Shows the window, waits until what is looked at is evaluated, writes its picture. False: it can't be
// written.
bool take_screenshot(MainWindow& window, const QString& file, QSize size);

}  // namespace kinegraph
