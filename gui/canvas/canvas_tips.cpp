// What the canvas says of what is under the pointer: in a line of the status bar, and as a tool tip.
#include <set>

#include "graph/nested.h"
#include "gui/canvas/graph_canvas.h"
#include "gui/document/problem_text.h"

namespace kinegraph {
namespace {

constexpr double port_reach = 12;  // pixels

QString escaped(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped();
}

QString capitalised(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString block(const QString& html, const QColor& color) {
  return QString("<div style='margin-top: 4px; color: %1'>%2</div>").arg(color.name(), html);
}

QString tip(const QString& title, const QString& rest) {
  return "<div style='white-space: nowrap'>" + title + "</div>" + rest;
}

}  // namespace

QString GraphCanvas::port_words(const PortAt& at) const {
  const SceneNode* node = scene_.node(at.node);
  const ScenePort* port = node ? node->port(at.input, at.port) : nullptr;
  QString text = QString::fromStdString(at.node + "." + at.port);
  if (port && !port->type.empty()) text += " · " + QString::fromStdString(port->type);
  if (port && port->optional) text += tr(" · may stay open");
  if (port && !port->help.isEmpty()) text += " · " + port->help;
  return text;
}

QString GraphCanvas::wire_words(const SceneWire& wire) const {
  return QString::fromStdString(wire.from + "." + wire.from_port + " → " + wire.to + "." + wire.to_port) +
         tr(" · Ctrl+click puts a dot, Ctrl+drag cuts");
}

QString GraphCanvas::port_tip(const PortAt& at) const {
  const SceneNode* node = scene_.node(at.node);
  const ScenePort* port = node ? node->port(at.input, at.port) : nullptr;
  if (!port) return {};
  QStringList about{port->type.empty() ? tr("any type") : QString::fromStdString(port->type)};
  if (at.input && port->list) about << tr("takes several links");
  if (port->optional) about << tr("may stay open");
  return tip("<b>" + escaped(at.node + "." + at.port) + "</b> · " + about.join(" · "),
             port->help.isEmpty() ? QString() : block(capitalised(port->help).toHtmlEscaped(), theme_->text));
}

QString GraphCanvas::wire_tip(const SceneWire& wire) const {
  QString title = "<b>" + escaped(wire.from + "." + wire.from_port) + "</b> → <b>" +
                  escaped(wire.to + "." + wire.to_port) + "</b>";
  if (!wire.type.empty()) title += " · " + escaped(wire.type);
  return tip(title, block(tr("Ctrl+click puts a dot, Ctrl+drag cuts"), theme_->faint_text));
}

QString GraphCanvas::node_tip(const SceneNode& node) const {
  const auto found = session_.document().nodes.find(node.name);
  if (found == session_.document().nodes.end()) return {};
  const NodeType* type = known_type(session_.registry(), found->second);
  const NodeStatus* status = evaluation_.status(node.name);
  using State = NodeStatus::State;
  const State state = node.missing    ? State::missing
                      : !node.enabled ? State::disabled
                      : status        ? status->state
                                      : State::idle;
  QString stands = state == State::idle && node.effect ? tr("not run yet: Run does it") : shown_state(state);
  if (state == State::failed && status->broken_rules > 0) stands = tr("check failed");
  if (state == State::blocked && !status->blocked_by.empty())
    stands += tr(" by %1").arg(QString::fromStdString(status->blocked_by));
  if (state == State::running) stands += QString(" · %1 %").arg(int(100 * status->progress));
  if (state == State::done && (status->seconds > 0 || !status->cached.empty())) {
    const bool cached = status->cached == "memory" || status->cached == "disk";
    if (!cached || status->seconds >= 0.0005) stands += " · " + shown_seconds(status->seconds);
    if (cached) stands += tr(" · from the cache");
  }
  QString rest;
  if (type) rest += block(escaped(type->help), theme_->text);
  if (!node.note.isEmpty()) rest += block("<i>" + node.note.toHtmlEscaped() + "</i>", theme_->faint_text);
  rest += block(capitalised(stands).toHtmlEscaped(), state_color(*theme_, state));
  std::set<std::string> said;
  const auto say = [&](const Diagnostic& problem) {
    if (problem.code == "blocked" && status && !status->blocked_by.empty()) return;  // said already
    if (!said.insert(problem.code + "\n" + problem.param + problem.port).second) return;
    const Severity severity = shown_severity(problem);
    QString line = problem_text(problem).toHtmlEscaped();
    if (const QString advice = advice_on(problem); !advice.isEmpty())
      line += "<br><span style='color: " + theme_->text.name() + "'>" + advice.toHtmlEscaped() + "</span>";
    rest += block(line, severity == Severity::error     ? theme_->error
                        : severity == Severity::warning ? theme_->warning
                                                        : theme_->faint_text);
  };
  for (const Diagnostic& problem : session_.problems())
    if (problem.node == node.name) say(problem);
  if (status)
    for (const Diagnostic& problem : status->diagnostics) say(problem);
  return tip("<b>" + escaped(node.name) + "</b> · " + escaped(node.type), rest);
}

QString GraphCanvas::tool_tip(QPointF view) const {
  if (gesture_) return {};
  const QPointF at = to_graph(view);
  if (const auto port = scene_.port_at(at, port_reach / std::max(zoom_, 0.4))) return port_tip(*port);
  if (const SceneNode* node = scene_.node_at(at)) return node_tip(*node);
  if (const SceneWire* wire = scene_.wire_at(at, 6 / zoom_)) return wire_tip(*wire);
  return {};
}

}  // namespace kinegraph
