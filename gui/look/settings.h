// What the editor remembers of a user, never in the graph file: layout, theme, recent graphs.
#pragma once
#include <QSettings>
#include <memory>

namespace kinegraph {

inline constexpr int layout_version = 2;  // of the docks: an older layout is forgotten

// $KINEGRAPH_SETTINGS names the file, else the user's own.
std::unique_ptr<QSettings> user_settings();

}  // namespace kinegraph
