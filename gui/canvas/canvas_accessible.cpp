#include "gui/canvas/canvas_accessible.h"

#include <QAccessible>
#include <QAccessibleWidget>
#include <algorithm>
#include <map>

#include "gui/canvas/graph_canvas.h"
#include "gui/canvas/node_painter.h"

namespace kinegraph {
namespace {

QString words(const std::string& text) {
  return QString::fromStdString(text);
}

// "motion from walk.motion; to feet.motion, after.motion"
QString links_of(const GraphScene& scene, const std::string& node) {
  QStringList from, to;
  for (const SceneWire& wire : scene.wires()) {
    if (wire.to == node)
      from << QObject::tr("%1 from %2").arg(words(wire.to_port), words(wire.from + "." + wire.from_port));
    if (wire.from == node) to << words(wire.to + "." + wire.to_port);
  }
  QStringList both;
  if (!from.isEmpty()) both << from.join(", ");
  if (!to.isEmpty()) both << QObject::tr("to %1").arg(to.join(", "));
  return both.isEmpty() ? QObject::tr("no links") : both.join("; ");
}

// Lives as long as its canvas, also when the node is gone: then it is invalid.
class NodeAccessible : public QAccessibleInterface {
 public:
  NodeAccessible(GraphCanvas& canvas, std::string name) : canvas_(canvas), name_(std::move(name)) {}

  bool isValid() const override { return node() != nullptr; }
  QObject* object() const override { return nullptr; }
  QAccessibleInterface* parent() const override { return QAccessible::queryAccessibleInterface(&canvas_); }
  QAccessibleInterface* child(int) const override { return nullptr; }
  QAccessibleInterface* childAt(int, int) const override { return nullptr; }
  int childCount() const override { return 0; }
  int indexOfChild(const QAccessibleInterface*) const override { return -1; }
  QAccessible::Role role() const override { return QAccessible::ListItem; }

  QRect rect() const override {
    const SceneNode* at = node();
    if (!at) return {};
    const QRect seen =
        QRectF(canvas_.to_view(at->rect.topLeft()), canvas_.to_view(at->rect.bottomRight())).toRect();
    return {canvas_.mapToGlobal(seen.topLeft()), seen.size()};
  }

  QString text(QAccessible::Text which) const override {
    const SceneNode* at = node();
    if (!at) return {};
    if (which == QAccessible::Name) return QString("%1, %2").arg(words(at->name), words(at->type));
    if (which == QAccessible::Value) {
      const NodeStatus* status = canvas_.evaluation().status(name_);
      if (at->missing) return shown_state(NodeStatus::State::missing);
      if (!at->enabled) return shown_state(NodeStatus::State::disabled);
      return shown_state(status ? status->state : NodeStatus::State::idle);
    }
    if (which == QAccessible::Description) return links_of(canvas_.scene(), name_);
    if (which == QAccessible::Help) return at->note;
    return {};
  }
  void setText(QAccessible::Text, const QString&) override {}

  QAccessible::State state() const override {
    QAccessible::State state;
    const Session& session = canvas_.session();
    state.selectable = state.focusable = true;
    state.selected = session.selected().count(name_) > 0;
    state.focused = canvas_.hasFocus() && session.current() == name_;
    state.invalid = !isValid();
    return state;
  }

 private:
  const SceneNode* node() const { return canvas_.scene().node(name_); }
  GraphCanvas& canvas_;
  std::string name_;
};

class CanvasAccessible : public QAccessibleWidget {
 public:
  explicit CanvasAccessible(GraphCanvas& canvas)
      : QAccessibleWidget(&canvas, QAccessible::List), canvas_(canvas) {}
  ~CanvasAccessible() override {
    for (const auto& [name, id] : nodes_) QAccessible::deleteAccessibleInterface(id);
  }

  int childCount() const override { return int(canvas_.scene().nodes().size()); }
  QAccessibleInterface* child(int index) const override {
    return index < 0 || index >= childCount() ? nullptr
                                              : of(canvas_.scene().nodes()[std::size_t(index)].name);
  }
  int indexOfChild(const QAccessibleInterface* child) const override {
    for (int i = 0; i < childCount(); ++i)
      if (this->child(i) == child) return i;
    return -1;
  }
  QAccessibleInterface* childAt(int x, int y) const override {
    const SceneNode* node = canvas_.scene().node_at(canvas_.to_graph(canvas_.mapFromGlobal(QPoint(x, y))));
    return node ? of(node->name) : nullptr;
  }
  QAccessibleInterface* focusChild() const override {
    const std::string& current = canvas_.session().current();
    return canvas_.hasFocus() && canvas_.scene().node(current) ? of(current) : nullptr;
  }

 private:
  QAccessibleInterface* of(const std::string& name) const {
    auto [known, fresh] = nodes_.try_emplace(name);
    if (fresh) known->second = QAccessible::registerAccessibleInterface(new NodeAccessible(canvas_, name));
    return QAccessible::accessibleInterface(known->second);
  }
  GraphCanvas& canvas_;
  mutable std::map<std::string, QAccessible::Id> nodes_;
};

}  // namespace

QAccessibleInterface* canvas_accessible(const QString&, QObject* object) {
  auto* canvas = qobject_cast<GraphCanvas*>(object);
  return canvas ? new CanvasAccessible(*canvas) : nullptr;
}

void tell_of_current_node(GraphCanvas& canvas) {
  if (!QAccessible::isActive() || !canvas.hasFocus()) return;
  const auto& nodes = canvas.scene().nodes();
  const auto at = std::find_if(nodes.begin(), nodes.end(), [&](const SceneNode& node) {
    return node.name == canvas.session().current();
  });
  if (at == nodes.end()) return;
  QAccessibleEvent event(&canvas, QAccessible::Focus);
  event.setChild(int(at - nodes.begin()));
  QAccessible::updateAccessibility(&event);
}

}  // namespace kinegraph
