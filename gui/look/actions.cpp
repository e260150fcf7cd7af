#include "gui/look/actions.h"

#include <QKeySequence>
#include <QObject>
#include <string_view>

namespace kinegraph {
namespace {

using Where = ActionRow::Where;

constexpr ActionRow rows[] = {
    {"new", "File", "&New", "Ctrl+N", "Starts an empty graph"},
    {"open", "File", "&Open…", "Ctrl+O", "Opens a graph file"},
    {"save", "File", "&Save", "Ctrl+S", "Saves the graph", Where::window, true},
    {"save_as", "File", "Save &as…", "Ctrl+Shift+S", "Saves the graph under another name"},
    {"relink", "File", "Find &missing files…", "Ctrl+Shift+R", "Looks for files that the graph reads",
     Where::window, true},
    {"close_page", "File", "&Close this graph", "Ctrl+W", "Closes the page of this graph", Where::window,
     true},
    {"quit", "File", "&Quit", "Ctrl+Q", "Closes the editor"},

    {"undo", "Edit", "&Undo", "Ctrl+Z", "Takes back the last step"},
    {"redo", "Edit", "&Redo", "Ctrl+Shift+Z", "Does again what was taken back; so does Ctrl+Y"},
    {"cut", "Edit", "Cu&t", "Ctrl+X", "Moves the chosen nodes to the clipboard, as graph JSON", Where::graph,
     true},
    {"copy", "Edit", "&Copy", "Ctrl+C", "Copies the chosen nodes, as graph JSON", Where::graph},
    {"paste", "Edit", "&Paste", "Ctrl+V", "Adds the nodes of the clipboard", Where::graph},
    {"duplicate", "Edit", "Dup&licate", "Ctrl+D", "Copies the chosen nodes with their links", Where::graph},
    {"delete", "Edit", "&Delete, reconnecting", "Del", "Removes what is chosen and links past it",
     Where::graph},
    {"select_all", "Edit", "Select &all", "Ctrl+A", "Chooses all nodes", Where::graph, true},
    {"find", "Edit", "&Find a node…", "Ctrl+F", "Goes to a node by its name, type or note"},

    {"add", "Graph", "&Add a node…", "Tab", "Adds a node by a few letters of its name", Where::graph},
    {"link", "Graph", "&Link to…", "L", "Links the node's output to a port that fits", Where::graph},
    {"take_out", "Graph", "Ta&ke out of its links", "X", "Links past the chosen nodes and leaves them beside",
     Where::graph},
    {"rename", "Graph", "Re&name…", "F2", "Renames the node; links follow", Where::graph},
    {"enable", "Graph", "&Disable or enable", "D", "A disabled node passes on what it gets", Where::graph,
     true},
    {"color", "Graph", "Colo&ur…", "C", "Colours the chosen nodes", Where::graph},
    {"note", "Graph", "No&te", "N", "Puts a note on the canvas", Where::graph},
    {"group", "Graph", "&Group in a frame", "G", "Draws a frame around the chosen nodes", Where::graph},
    {"collapse", "Graph", "Collapse into a graph &file…", "Ctrl+G",
     "Makes the chosen nodes a graph file with one Graph node in their place", Where::graph, true},
    {"open_inside", "Graph", "&Open the node's graph", "Ctrl+Return",
     "Opens the file of a Graph node in a page of its own", Where::graph},
    {"arrange", "Graph", "Arrang&e", "Ctrl+L", "Puts the nodes in columns along their links", Where::graph,
     true},
    {"run", "Graph", "&Run", "F5", "Runs Exports and Checks, as kinegraph run does", Where::window, true},
    {"cancel", "Graph", "&Cancel", "Ctrl+.", "Stops what runs"},

    {"frame", "View", "Show &selection", "F", "Shows the chosen nodes", Where::graph},
    {"frame_all", "View", "Show &all", "A", "Shows the whole graph", Where::graph},
    {"zoom_in", "View", "Zoom &in", "+", "Shows the graph larger", Where::graph},
    {"zoom_out", "View", "Zoom &out", "-", "Shows the graph smaller", Where::graph},
    {"next_page", "View", "&Next graph", "Ctrl+PgDown", "Shows the next open graph", Where::window, true},
    {"previous_page", "View", "Pre&vious graph", "Ctrl+PgUp", "Shows the open graph before"},
    {"go_graph", "View", "Go to the &graph", "Ctrl+1", "Takes the keyboard to the graph", Where::window,
     true},
    {"go_viewer", "View", "Go to the vie&wer", "Ctrl+2", "Takes the keyboard to the viewer"},
    {"go_timeline", "View", "Go to the &timeline", "Ctrl+3", "Takes the keyboard to the timeline"},
    {"go_parameters", "View", "Go to the &parameters", "Ctrl+4",
     "Takes the keyboard to the node's parameters"},
    {"go_components", "View", "Go to the &components", "Ctrl+5", "Takes the keyboard to the components"},
    {"go_curves", "View", "Go to the c&urves", "Ctrl+6", "Takes the keyboard to the curves"},
    {"go_problems", "View", "Go to the p&roblems", "Ctrl+7", "Takes the keyboard to the list of problems"},
    {"go_files", "View", "Go to the &files", "Ctrl+8", "Takes the keyboard to examples, graphs and clips"},
    {"play", "View", "Pla&y or pause", "Ctrl+Space", "Plays what the viewer shows", Where::window, true},
    {"theme", "View", "Light th&eme", "Ctrl+T", "Changes between the dark and the light theme", Where::window,
     true},
    {"reset_layout", "View", "Usual &layout", "Ctrl+Shift+L", "Puts all docks where they stand at first"},

    {"keys", "Help", "&Keys and mouse", "F1", "Lists all actions with their keys"},
    {"about", "Help", "&About Kinegraph", "Shift+F1", "Says what this program is"},

    {"walk", "", "Walk along links", "Arrow keys", "Chooses the node before, behind, above or below",
     Where::graph},
    {"nudge", "", "Move the selection", "Ctrl+Arrow keys", "Moves the chosen nodes by a step of the grid",
     Where::graph},
    {"escape", "", "Give up", "Escape", "Gives up the gesture, or the selection", Where::graph},

    {"pin", "", "Pin the node", "1 … 9",
     "Shows the node at a place of its own beside others; again empties it", Where::viewer},
    {"unpin", "", "Empty all places", "0", "Shows the current node alone", Where::viewer},
    {"several", "", "Side by side, overlaid, wipe", "W", "Changes how several motions are shown",
     Where::viewer},
    {"viewer_frame", "", "Frame all", "F", "Shows all of the motion", Where::viewer},
    {"follow", "", "Follow the root", "R", "The camera goes along with the body", Where::viewer},
    {"trails", "", "Trails", "T", "Shows the ways of hands, feet, head and root", Where::viewer},
    {"contacts", "", "Contacts", "C", "Marks planted feet on the floor", Where::viewer},
    {"stretch", "", "Stretch", "S", "Colours links that are longer or shorter than at rest", Where::viewer},
    {"ghosts", "", "Ghosts", "G", "Shows the body at other times, faintly", Where::viewer},
    {"orbit", "", "Turn the camera", "Arrow keys", "Turns around what is shown", Where::viewer},
    {"viewer_zoom", "", "Nearer, farther", "+, -", "Moves the camera", Where::viewer},
    {"viewer_play", "", "Play or pause", "Space", "Plays what is shown", Where::viewer},

    {"timeline_play", "", "Play or pause", "Space", "Plays what the viewer shows", Where::timeline},
    {"step", "", "Step", "Left, Right", "A frame back or on; with Shift ten", Where::timeline},
    {"ends", "", "Start and end", "Home, End", "To the first and the last frame", Where::timeline},
    {"in", "", "Start of the range", "I", "The range that plays starts here", Where::timeline},
    {"out", "", "End of the range", "O", "The range that plays ends here", Where::timeline},
    {"whole", "", "Whole clip", "X", "Plays the whole clip again", Where::timeline},
    {"loop", "", "Loop", "L", "Starts again at the end", Where::timeline},
    {"speed", "", "Speed", "Up, Down", "Plays faster or slower", Where::timeline},
};

constexpr MouseRow gestures[] = {
    {"Double-click on the graph", "Adds a node; on a Graph node opens its file; on another renames it"},
    {"Drag from a port", "Links; let go on empty space it offers the nodes that fit"},
    {"Drop a node on a wire", "Puts it into the wire"},
    {"Alt+drag a node", "Takes it out of its links"},
    {"Ctrl+drag across wires", "Cuts them"},
    {"Ctrl+click on a wire", "Puts a dot there"},
    {"Wheel", "Zooms to the pointer; with Shift moves sideways"},
    {"Middle button, Space+drag", "Moves the view"},
    {"Drag in the viewer", "Turns; with the middle button or Shift moves; the wheel goes nearer and farther"},
};

}  // namespace

std::span<const ActionRow> all_actions() {
  return rows;
}

QString menu_text(const char* name) {
  for (const ActionRow& row : rows)
    if (std::string_view(row.name) == name)
      return QString(QObject::tr(row.text)).remove('&') + "\t" + QObject::tr(row.keys);
  return QString::fromUtf8(name);
}

std::span<const MouseRow> mouse_gestures() {
  return gestures;
}

}  // namespace kinegraph
