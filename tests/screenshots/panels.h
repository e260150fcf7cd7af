// Pictures of what the Parameters, Components, Problems and Files docks say in their many states.
#pragma once
#include "tests/screenshots/shots.h"

namespace kinegraph::shots {

void panel_pictures(const Theme& theme, const QDir& into, const QString& end);

}  // namespace kinegraph::shots
