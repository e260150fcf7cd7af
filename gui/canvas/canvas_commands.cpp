// What menus and keys do on the canvas.
#include <QApplication>
#include <QClipboard>
#include <QMenu>
#include <QWidgetAction>
#include <algorithm>
#include <cmath>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "graph/links.h"
#include "graph/nested.h"
#include "gui/canvas/arrange.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/canvas/graph_canvas.h"

namespace kinegraph {

namespace {

constexpr double margin_of_new = 8;  // pixels

// As long as nothing is typed: families in the order of a motion's way through a graph.
void in_order_of_families(std::vector<std::string>& types, const Registry& registry) {
  static const std::string_view way[] = {"files", "motion",  "time",  "style", "components",
                                         "feet",  "cartoon", "judge", "graph"};
  const auto place = [&](const std::string& type) {
    return std::find(std::begin(way), std::end(way), registry.find(type)->category) - std::begin(way);
  };
  std::stable_sort(types.begin(), types.end(),
                   [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
}

}  // namespace

// Where a new node hides none: below those that it would lie on.
QPointF GraphCanvas::free_place(QPointF graph) const {
  constexpr double least_height = 150, apart = 20;
  for (std::size_t tries = 0; tries <= scene_.nodes().size(); ++tries) {
    const QRectF box(graph, QSizeF(GraphScene::node_width, least_height));
    const auto under = std::find_if(scene_.nodes().begin(), scene_.nodes().end(),
                                    [&](const SceneNode& node) { return node.rect.intersects(box); });
    if (under == scene_.nodes().end()) break;
    graph.setY(under->rect.bottom() + apart);
  }
  return graph;
}

std::string GraphCanvas::add(const std::string& type, QPointF graph, std::optional<PortAt> port,
                             std::map<std::string, Json> params) {
  if (!port) graph = free_place(graph);
  std::string name;
  const bool done = session_.perform([&](const Document& d, const Registry& r) {
    return keeping_places(d, r, scene_, [&](const Document& placed, const Registry& registry) {
      return add_new_node(placed, registry, {type, graph, port, params}, &name);
    });
  });
  if (!done) return {};
  session_.select({name}, name);
  // Its place may be out of sight where the one that was asked for is taken.
  const QRectF seen = QRectF(rect()).adjusted(margin_of_new, margin_of_new, -margin_of_new, -margin_of_new);
  if (const SceneNode* node = scene_.node(name)) {
    const QRectF box(to_view(node->rect.topLeft()), to_view(node->rect.bottomRight()));
    const QPointF by(std::max(0.0, seen.left() - box.left()) + std::min(0.0, seen.right() - box.right()),
                     std::max(0.0, seen.top() - box.top()) + std::min(0.0, seen.bottom() - box.bottom()));
    if (!by.isNull() && seen.height() > box.height() && seen.width() > box.width()) pan_by(by);
  }
  return name;
}

void GraphCanvas::search_to_add(QPointF graph, std::optional<PortAt> port) {
  std::vector<std::string> types =
      port ? fitting_types(session_.document(), session_.registry(), *port) : session_.registry().names();
  in_order_of_families(types, session_.registry());
  std::vector<SearchBox::Entry> entries;
  for (const std::string& name : types) {
    const NodeType& type = *session_.registry().find(name);
    QStringList keywords{QString::fromStdString(type.category)};
    for (const std::string& word : type.keywords) keywords << QString::fromStdString(word);
    entries.push_back({QString::fromStdString(name), QString::fromStdString(type.category),
                       QString::fromStdString(type.help), keywords});
  }
  const QString prompt =
      port ? tr("Nodes that fit %1").arg(QString::fromStdString(port->port)) : tr("Add a node");
  search_->open(to_view(graph).toPoint(), prompt, std::move(entries), [this, graph, port, types](int chosen) {
    // The node's first port comes to lie where the wire was let go.
    const QPointF at =
        port ? graph - QPointF(port->input ? GraphScene::node_width : 0, 52) : graph - QPointF(90, 20);
    add(types[std::size_t(chosen)], at, port);
  });
}

void GraphCanvas::add_by_search() {
  search_to_add(pointer());
}

void GraphCanvas::find_node() {
  std::vector<SearchBox::Entry> entries;
  std::vector<std::string> names;
  for (const auto& [name, node] : session_.document().nodes) {
    names.push_back(name);
    entries.push_back({QString::fromStdString(name),
                       QString::fromStdString(node.type),
                       QString::fromStdString(node.note),
                       {QString::fromStdString(node.type), QString::fromStdString(node.note)}});
  }
  search_->open({(width() - 340) / 2, 40}, tr("Find a node"), std::move(entries), [this, names](int chosen) {
    const std::string& name = names[std::size_t(chosen)];
    session_.select({name}, name);
    make_visible(name);
  });
}

void GraphCanvas::link_by_search() {
  const SceneNode* node = scene_.node(session_.current());
  if (!node) return;
  const std::string from = node->name;
  const Document& document = session_.document();
  const NodeType* type = known_type(session_.registry(), document.nodes.at(from));
  if (!type) return;
  struct Found {
    int rank;
    SearchBox::Entry entry;
    std::pair<PortAt, PortAt> link;
  };
  std::vector<Found> found;
  for (const OutputPort& output : type->outputs)
    for (const auto& [name, other] : document.nodes) {
      const NodeType* to = name == from ? nullptr : known_type(session_.registry(), other);
      for (std::size_t i = 0; to && i < to->inputs.size(); ++i) {
        const PortAt a{from, output.name, false}, b{name, to->inputs[i].name, true};
        if (!objection(document, session_.registry(), a, b).isEmpty()) continue;
        const auto inputs = other.inputs.find(b.port);
        const bool linked = inputs != other.inputs.end() && !inputs->second.links.empty();
        const Link link{from, output.name, {}};
        if (linked && std::count(inputs->second.links.begin(), inputs->second.links.end(), link)) continue;
        const bool replaces = linked && !to->inputs[i].list;
        // Of ports that match alike the shorter line comes first: the one that needs a link.
        QString line = QString::fromStdString(name + "." + b.port);
        if (replaces)
          line += tr(" · instead of its link");
        else if (linked || to->inputs[i].optional)
          line += tr(" · may stay open");
        const int rank = replaces ? 2 : linked || to->inputs[i].optional ? 1 : 0;
        found.push_back({rank,
                         {line,
                          QString::fromStdString(output.name + " →"),
                          QString::fromStdString(to->inputs[i].help),
                          {}},
                         {a, b}});
      }
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& x, const Found& y) { return x.rank < y.rank; });
  std::vector<std::pair<PortAt, PortAt>> links;
  std::vector<SearchBox::Entry> entries;
  for (Found& one : found) {
    links.push_back(std::move(one.link));
    entries.push_back(std::move(one.entry));
  }
  search_->open(to_view(node->rect.topRight() + QPointF(10, 0)).toPoint(), tr("Link to"), std::move(entries),
                [this, links](int chosen) {
                  const auto& [a, b] = links[std::size_t(chosen)];
                  session_.perform([&, a = a, b = b](const Document& d, const Registry& r) {
                    return link_ports(d, r, a, b);
                  });
                });
}

void GraphCanvas::remove_selected() {
  const auto names = selection();
  const auto frames = selected_frames_, notes = selected_notes_;
  // Of a chosen frame only the frame goes when its nodes were chosen by it.
  if (names.empty() && frames.empty() && notes.empty()) return;
  session_.perform([&](const Document& document, const Registry& registry) {
    std::vector<EditStep> steps;
    if (!frames.empty() || !notes.empty())
      steps.push_back([&](const Document& d, const Registry&) { return remove_decor(d, frames, notes); });
    if (!names.empty() && frames.empty())
      steps.push_back([&](const Document& d, const Registry& r) { return remove_nodes(d, r, names, true); });
    return one_after_another(document, registry,
                             names.size() == 1 && frames.empty() ? "Delete " + names.front() : "Delete",
                             steps);
  });
}

void GraphCanvas::copy_selected() {
  if (session_.selected().empty()) return;
  const Document part = copied(session_.document(), session_.registry(), selection());
  QApplication::clipboard()->setText(QString::fromStdString(write_document(part, session_.registry())));
}

void GraphCanvas::cut_selected() {
  copy_selected();
  remove_selected();
}

void GraphCanvas::paste() {
  // Out of a chat it comes with words around it.
  std::string text = QApplication::clipboard()->text().toStdString();
  if (const auto from = text.find('{'), to = text.rfind('}'); from < to && to != std::string::npos)
    text = text.substr(from, to - from + 1);
  const ReadResult read = read_document(text, "clipboard", session_.registry());
  if (has_error(read.problems) || read.document.read_only || read.document.nodes.empty()) {
    set_hint(tr("The clipboard holds no nodes."), to_view(pointer()), true);
    QTimer::singleShot(2500, this, [this] { set_hint({}, {}, false); });
    return;
  }
  GraphScene part;
  part.rebuild(read.document, session_.registry(), {});
  const QPointF by = pointer() - part.bounds().center();
  std::vector<std::string> names;
  const auto snapped = [](double x) { return int(std::lround(x / GraphScene::step)) * GraphScene::step; };
  session_.perform([&](const Document& d, const Registry& r) {
    return keeping_places(d, r, scene_, [&](const Document& placed, const Registry& registry) {
      names.clear();
      return kinegraph::paste(placed, registry, read.document, snapped(by.x()), snapped(by.y()), &names);
    });
  });
  session_.select({names.begin(), names.end()}, names.empty() ? "" : names.front());
}

void GraphCanvas::duplicate() {
  if (session_.selected().empty()) return;
  const std::vector<std::string> chosen = selection();
  std::vector<std::string> names;
  session_.perform([&](const Document& d, const Registry& r) {
    return keeping_places(d, r, scene_, [&](const Document& placed, const Registry& registry) {
      names.clear();
      // Copies lie beside what they were made of, wherever that got its place.
      return kinegraph::paste(placed, registry, copied(placed, registry, chosen), 40, 40, &names);
    });
  });
  session_.select({names.begin(), names.end()}, names.empty() ? "" : names.front());
}

void GraphCanvas::toggle_enabled() {
  const auto names = selection();
  if (names.empty()) return;
  bool any_enabled = false;
  for (const std::string& name : names) any_enabled |= session_.document().nodes.at(name).enabled;
  session_.perform([&](const Document& document, const Registry& registry) {
    std::vector<EditStep> steps;
    for (const std::string& name : names)
      steps.push_back([&](const Document& d, const Registry&) { return set_enabled(d, name, !any_enabled); });
    return one_after_another(document, registry, any_enabled ? "Disable" : "Enable", steps);
  });
}

void GraphCanvas::choose_color() {
  if (session_.selected().empty()) return;
  const auto nodes = session_.selected();
  static const std::pair<const char*, const char*> colors[] = {
      {"#c8553d", "Red"},  {"#d98e2b", "Orange"}, {"#c9b53a", "Yellow"}, {"#5a9e4b", "Green"},
      {"#3a9c94", "Teal"}, {"#3f7fc0", "Blue"},   {"#7a5fc0", "Violet"}, {"#b04f8f", "Pink"}};
  QMenu menu(this);
  for (const auto& [hex, name] : colors) {
    QPixmap swatch(16, 16);
    swatch.fill(QColor(hex));
    menu.addAction(QIcon(swatch), tr(name), this, [this, nodes, hex = QString(hex)] {
      session_.perform([&](const Document& d, const Registry&) { return set_color(d, nodes, hex); });
    });
  }
  menu.addSeparator();
  menu.addAction(tr("None"), this, [this, nodes] {
    session_.perform([&](const Document& d, const Registry&) { return set_color(d, nodes, {}); });
  });
  const SceneNode* node = scene_.node(session_.current().empty() ? *nodes.begin() : session_.current());
  menu.exec(mapToGlobal(node ? to_view(node->rect.bottomLeft()).toPoint() : rect().center()));
}

void GraphCanvas::add_note() {
  std::string name;
  const QPointF at = pointer();
  if (!session_.perform(
          [&](const Document& d, const Registry&) { return kinegraph::add_note(d, at, {}, &name); }))
    return;
  select_decor({}, {name});
  for (const SceneNote& note : scene_.notes())
    if (note.name == name)
      edit_text(note.rect, {}, [this, name, step = session_.history().position()](const QString& text) {
        if (session_.history().position() == step) session_.continue_gesture();
        session_.perform([&](const Document& d, const Registry&) { return set_note_text(d, name, text); });
        session_.end_gesture();
      });
}

void GraphCanvas::group_in_frame() {
  if (session_.selected().empty()) return;
  std::string name;
  const auto nodes = session_.selected();
  if (!session_.perform(
          [&](const Document& d, const Registry&) { return add_frame(d, nodes, tr("Group"), &name); }))
    return;
  select_decor({name}, {});
  for (const SceneFrame& frame : scene_.frames())
    if (frame.name == name)
      edit_text(frame.title_bar, frame.title,
                [this, name, step = session_.history().position()](const QString& text) {
                  if (session_.history().position() == step) session_.continue_gesture();
                  session_.perform(
                      [&](const Document& d, const Registry&) { return set_frame_title(d, name, text); });
                  session_.end_gesture();
                });
}

void GraphCanvas::arrange() {
  const std::set<std::string> nodes =
      session_.selected().size() > 1 ? session_.selected() : std::set<std::string>();
  const auto positions = arranged(scene_, nodes);
  if (positions.empty()) return;
  session_.perform([&](const Document& d, const Registry& r) {
    return keeping_places(d, r, scene_, [&](const Document& placed, const Registry&) {
      Edit edit = move_nodes(placed, positions);
      edit.title = "Arrange";
      return edit;
    });
  });
  if (nodes.empty()) frame_all();
}

void GraphCanvas::frame_selected() {
  const QRectF chosen = scene_.bounds_of(session_.selected());
  show_rect(chosen.isNull() ? scene_.bounds() : chosen.adjusted(-60, -60, 60, 60));
}

void GraphCanvas::frame_all() {
  show_rect(scene_.bounds());
}

void GraphCanvas::rename_selected() {
  const SceneNode* node = scene_.node(session_.current());
  if (!node) return;
  const std::string name = node->name;
  edit_text(QRectF(node->rect.topLeft(), QSizeF(node->rect.width(), 30)), QString::fromStdString(name),
            [this, name](const QString& text) {
              const std::string wanted = text.trimmed().toStdString();
              if (wanted.empty() || wanted == name) return;
              if (session_.perform(
                      [&](const Document& d, const Registry&) { return rename_node(d, name, wanted); }))
                session_.select({wanted}, wanted);
            });
}

void GraphCanvas::select_all() {
  std::set<std::string> all, notes;
  for (const SceneNode& node : scene_.nodes()) all.insert(node.name);
  for (const SceneNote& note : scene_.notes()) notes.insert(note.name);
  session_.select(all, session_.current());
  select_decor({}, notes);
}

void GraphCanvas::take_out_selected() {
  const auto names = selection();
  if (names.empty()) return;
  session_.perform([&](const Document& document, const Registry& registry) {
    std::vector<EditStep> steps;
    for (const std::string& name : names)
      steps.push_back([&](const Document& d, const Registry& r) { return kinegraph::take_out(d, r, name); });
    return one_after_another(document, registry, "Take out of links", steps);
  });
}

void GraphCanvas::walk(int dx, int dy) {
  const SceneNode* node = scene_.node(session_.current());
  const SceneNode* best = nullptr;
  double least = 1e300;
  const auto consider = [&](const SceneNode* other, double cost) {
    if (other && other != node && cost < least) {
      least = cost;
      best = other;
    }
  };
  if (!node) {
    for (const SceneNode& other : scene_.nodes())
      consider(&other, other.rect.left() + other.rect.top() * 0.1);
  } else if (dx) {
    // The nearest of those linked there, sooner one at the same height.
    for (const SceneWire& wire : scene_.wires()) {
      if ((dx < 0 ? wire.to : wire.from) != node->name) continue;
      const SceneNode* other = scene_.node(dx < 0 ? wire.from : wire.to);
      if (!other) continue;
      const QPointF way = other->rect.center() - node->rect.center();
      consider(other, std::abs(way.y()) + 0.5 * std::abs(way.x()));
    }
  } else {
    for (const SceneNode& other : scene_.nodes()) {
      const QPointF way = other.rect.center() - node->rect.center();
      if (way.y() * dy > 1) consider(&other, std::abs(way.y()) + 2 * std::abs(way.x()));
    }
  }
  if (!best) return;
  const std::string name = best->name;
  session_.select({name}, name);
  make_visible(name);
}

void GraphCanvas::nudge(int dx, int dy) {
  if (session_.selected().empty()) return;
  std::map<std::string, QPointF> positions;
  for (const std::string& name : session_.selected())
    if (const SceneNode* node = scene_.node(name))
      positions[name] = node->rect.topLeft() + QPointF(dx, dy) * GraphScene::step;
  session_.perform([&](const Document& d, const Registry& r) {
    return keeping_places(
        d, r, scene_, [&](const Document& placed, const Registry&) { return move_nodes(placed, positions); });
  });
}

}  // namespace kinegraph
