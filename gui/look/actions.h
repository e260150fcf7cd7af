// Every action of the editor in one table: its name, words, keys, and what it does. Menus, the toolbar and
// the help are made from it.
#pragma once
#include <QString>
#include <span>

namespace kinegraph {

struct ActionRow {
  // Where its keys hold: everywhere in the window, or where the keyboard is at the graph, viewer or timeline.
  enum class Where { window, graph, viewer, timeline };
  const char* name;  // "save_as"; that of a row of the viewer or timeline is only for the help
  const char* menu;  // "File"; "" = in none
  const char* text;  // "Save &as…"
  const char* keys;  // "Ctrl+Shift+S"
  const char* what;  // for tool tips and the help
  Where where = Where::window;
  bool after_line = false;  // a line stands above it in the menu
};
std::span<const ActionRow> all_actions();

// An action's words with its keys, as an entry of a menu that opens at the pointer.
QString menu_text(const char* name);

// What the mouse does, for the help: gesture and effect.
struct MouseRow {
  const char* gesture;
  const char* what;
};
std::span<const MouseRow> mouse_gestures();

}  // namespace kinegraph
