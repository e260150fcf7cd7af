// Gestures of the canvas as single edits, put together from those of graph/edit.h so that each is one undo
// step.
#pragma once
#include <QObject>
#include <QPointF>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "graph/edit.h"
#include "gui/canvas/graph_scene.h"

namespace kinegraph {

using EditStep = std::function<Edit(const Document&, const Registry&)>;
// The steps after one another as one edit; throws what a step throws.
Edit one_after_another(const Document&, const Registry&, const std::string& title,
                       const std::vector<EditStep>& steps);

// The same of one step, and before it nodes that have no saved place get the one where they are shown: they
// would be arranged anew around what is moved or added. Nothing where the step is nothing.
Edit keeping_places(const Document&, const Registry&, const GraphScene& scene, const EditStep& step);
Edit move_nodes(const Document&, const std::map<std::string, QPointF>& positions);
Edit set_color(const Document&, const std::set<std::string>& nodes, const QString& color);  // "" = none
Edit add_note(const Document&, QPointF at, const QString& text, std::string* name);
Edit set_note_text(const Document&, const std::string& note, const QString& text);
Edit place_note(const Document&, const std::string& note, QRectF rect);
Edit add_frame(const Document&, const std::set<std::string>& nodes, const QString& title, std::string* name);
Edit set_frame_title(const Document&, const std::string& frame, const QString& title);
Edit remove_decor(const Document&, const std::set<std::string>& frames, const std::set<std::string>& notes);

// A node of `type` at a position, optionally linked: from `from` to its first input that fits, or its first
// fitting output to `to`. `name` receives its name.
struct NewNode {
  std::string type;
  QPointF at;
  std::optional<PortAt> link;  // the port a wire was dragged from
  std::map<std::string, Json> params;
};
Edit add_new_node(const Document&, const Registry&, const NewNode& node, std::string* name);

// Links two ports, whichever way round; a single-link input that is taken gives up its link.
Edit link_ports(const Document&, const Registry&, const PortAt& a, const PortAt& b);
// Why the two ports can't be linked, "" where they can.
QString objection(const Document&, const Registry&, const PortAt& a, const PortAt& b);
// A port of the node that `from` can be linked to, shown or not.
std::optional<PortAt> fitting_port(const Document&, const Registry&, const PortAt& from,
                                   const std::string& node);
// Types that have a port which fits `from`.
std::vector<std::string> fitting_types(const Document&, const Registry&, const PortAt& from);

}  // namespace kinegraph
