// The editor as a process that a test kills.
#pragma once
#include <QString>

namespace kinegraph::editor_test {

inline const QString edit_until_killed = "--edit-until-killed";

// Opens main.kg.json in FOLDER and works on it. HOW: "save" adds a node, writes FOLDER/ready with what it is
// going to save, waits for FOLDER/go and presses Ctrl+S; a number is the seed of gestures without end.
int run_until_killed(const QString& folder, const QString& how);

}  // namespace kinegraph::editor_test
