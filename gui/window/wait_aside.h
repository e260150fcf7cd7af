// A long operation that its caller can't go on without, done on another thread while the window lives on.
#pragma once
#include <QString>
#include <functional>

#include "graph/evaluate/stop.h"

class QWidget;

namespace kinegraph {

// Comes back once `work` (see gui/document/aside.h) has ended. Meanwhile the window draws and its timers run,
// but nobody can use it; after a moment a dialog with a progress bar and Cancel says what is going on, unless
// `over` is null. False: cancelled.
bool wait_aside(QWidget* over, const QString& what, const std::function<void(const StopToken&)>& work);

}  // namespace kinegraph
