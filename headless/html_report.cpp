#include "headless/html_report.h"

#include <algorithm>
#include <cmath>

#include "headless/html_page.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

namespace {

// More frames than this and every second, third, … is shown: a page should open at once.
constexpr std::size_t most_frames = 3000;

// {"fps", "frames", "joints": [name], "parents": [index], "positions": [millimetres, frame by frame]}
Json motion_json(const Motion& motion, const std::string& name) {
  const std::size_t step = std::max<std::size_t>(1, (motion.frames() + most_frames - 1) / most_frames);
  const WorldMotion world = world_motion(motion);
  Json::Array names, parents, positions;
  for (const Joint& joint : motion.skeleton().joints) {
    names.push_back(joint.name);
    parents.push_back(joint.parent);
  }
  std::size_t frames = 0;
  for (std::size_t t = 0; t < motion.frames(); t += step, ++frames)
    for (int j = 0; j < motion.joints(); ++j) {
      const Vec3 at = world.position(j)[t];
      for (const double metres : {at.x, at.y, at.z}) positions.push_back(Json(std::round(metres * 1000)));
    }
  return Json::Object{{"name", name},
                      {"fps", motion.fps() / static_cast<double>(step)},
                      {"frames", frames},
                      {"joints", std::move(names)},
                      {"parents", std::move(parents)},
                      {"positions", std::move(positions)}};
}

// Inside a script element nothing may look like its end.
std::string safe(std::string text) {
  for (auto at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.replace(at, 2, "<\\/");
  for (auto at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at + 5))
    text.replace(at, 4, "<\\!--");
  return text;
}

// The links of the plan, as "from node" -> "to node".
Json links_of(const Plan& plan) {
  Json::Array links;
  for (const PlannedNode& node : plan.nodes)
    for (const auto& [port, sources] : node.inputs)
      for (const Source& source : sources)
        if (source.node >= 0)
          links.push_back(Json::Array{plan.nodes[static_cast<std::size_t>(source.node)].name, source.port,
                                      node.name, port});
  return links;
}

bool is_motion(const Plan& plan, const Source& source) {
  if (source.node < 0) return false;
  const NodeType* type = plan.nodes[static_cast<std::size_t>(source.node)].type;
  const OutputPort* port = type ? type->find_output(source.port) : nullptr;
  return port && port->type == "Motion";
}

std::optional<Source> main_input(const Plan& plan, int node) {
  const PlannedNode& planned = plan.nodes[static_cast<std::size_t>(node)];
  if (!planned.type) return {};
  for (const InputPort& port : planned.type->inputs)
    if (const auto sources = planned.inputs.find(port.name); sources != planned.inputs.end() &&
                                                             !sources->second.empty() &&
                                                             is_motion(plan, sources->second.front()))
      return sources->second.front();
  return {};
}

}  // namespace

std::vector<BeforeAfter> motions_to_show(const Session& session, const std::vector<Target>& targets) {
  const Plan& plan = session.plan();
  std::vector<BeforeAfter> shown;
  for (const Target& target : targets) {
    std::optional<Source> after;
    if (target.port.empty()) {
      const auto node = plan.by_name.find(target.node);
      const bool writes = node != plan.by_name.end() &&
                          plan.nodes[static_cast<std::size_t>(node->second)].type &&
                          plan.nodes[static_cast<std::size_t>(node->second)].type->effect == Effect::writes;
      if (writes) after = main_input(plan, node->second);
    } else {
      after = plan.find_output(target.node, target.port);
    }
    if (!after || !is_motion(plan, *after)) continue;
    const auto named = [&](const Source& source) {
      return Target{plan.nodes[static_cast<std::size_t>(source.node)].name, source.port};
    };
    BeforeAfter one{target.port.empty() ? target.node : target.node + "." + target.port, {}, named(*after)};
    std::optional<Source> at = after;
    while (const auto earlier = main_input(plan, at->node)) at = earlier;
    if (at->node != after->node) one.before = named(*at);
    shown.push_back(std::move(one));
  }
  return shown;
}

std::string html_of(const Outcome& outcome, const Program& program, Session& session,
                    const std::vector<BeforeAfter>& shown) {
  Json::Array pairs;
  for (const BeforeAfter& one : shown) {
    Json::Array motions;
    for (const Target& target : {one.before, one.after}) {
      if (target.node.empty()) continue;
      const auto value = session.evaluator().value(session.plan(), target.node, target.port);
      if (const auto motion = std::dynamic_pointer_cast<const Motion>(value); motion && motion->frames() > 0)
        motions.push_back(motion_json(*motion, target.node + "." + target.port));
    }
    if (!motions.empty()) pairs.push_back(Json::Object{{"name", one.name}, {"motions", std::move(motions)}});
  }
  const Json data =
      Json::Object{{"report", report_of(outcome, program, session.opened(), session.options().out)},
                   {"links", links_of(session.plan())},
                   {"players", std::move(pairs)}};
  return std::string(html_page_start()) + safe(compact(data)) + std::string(html_page_end());
}

}  // namespace kinegraph
