#include "nodes/files/gltf_nodes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

using Model = tinygltf::Model;

Decomposed local_of(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    Affine map;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) map.rows[i][j] = node.matrix[static_cast<std::size_t>(4 * j + i)];
    return decomposed(map);
  }
  Decomposed local;
  if (node.translation.size() == 3)
    local.move = {node.translation[0], node.translation[1], node.translation[2]};
  if (node.rotation.size() == 4)
    local.turned = normalized(Quat{node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]});
  if (node.scale.size() == 3) local.scale = {node.scale[0], node.scale[1], node.scale[2]};
  return local;
}

double cube_root(double x) {
  return x > 0 ? power(x, 1.0 / 3) : 0;
}

double mean_scale(const Affine& map) {
  return cube_root(std::fabs(determinant(map)));
}

// Parents before children, as children stand in the file. Throws where that is no forest.
std::vector<int> in_order(const Model& model, std::vector<int>& parent) {
  const int count = static_cast<int>(model.nodes.size());
  parent.assign(model.nodes.size(), -1);
  for (int i = 0; i < count; ++i)
    for (int child : model.nodes[i].children) {
      if (child < 0 || child >= count) bad_gltf(fmt::format("node {} has a child {}", i, child));
      if (parent[child] >= 0) bad_gltf(fmt::format("node {} has two parents", child));
      parent[child] = i;
    }
  std::vector<int> order, open;
  for (int i = count - 1; i >= 0; --i)
    if (parent[i] < 0) open.push_back(i);
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    order.push_back(node);
    const auto& children = model.nodes[node].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  if (order.size() != model.nodes.size()) bad_gltf("a node stands below itself");
  return order;
}

bool is_above(const std::vector<int>& parent, int ancestor, int node) {
  for (; node >= 0; node = parent[node])
    if (node == ancestor) return true;
  return false;
}

std::set<int> moving_nodes(const Model& model) {
  std::set<int> moving;
  for (const tinygltf::Animation& animation : model.animations)
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      if ((channel.target_path == "rotation" || channel.target_path == "translation") &&
          channel.target_node >= 0 && channel.target_node < static_cast<int>(model.nodes.size()))
        moving.insert(channel.target_node);
  return moving;
}

// The nodes that are joints for their own sake.
std::set<int> chosen_nodes(const Model& model, const std::vector<int>& parent,
                           const std::vector<int>& order) {
  std::set<int> chosen;
  for (const tinygltf::Skin& skin : model.skins)
    for (int joint : skin.joints) {
      if (joint < 0 || joint >= static_cast<int>(model.nodes.size()))
        bad_gltf(fmt::format("a skin has the joint {}", joint));
      chosen.insert(joint);
    }
  const std::set<int> moving = moving_nodes(model), skinned = chosen;
  for (int node : moving)
    if (skinned.empty() || std::any_of(skinned.begin(), skinned.end(), [&](int joint) {
          return is_above(parent, node, joint) || is_above(parent, joint, node);
        }))
      chosen.insert(node);
  if (chosen.empty() && !order.empty()) chosen.insert(order.front());
  return chosen;
}

// The deepest node above (or equal to) all of them, or -1.
int common_root(const std::vector<int>& parent, const std::set<int>& nodes) {
  for (int root = *nodes.begin(); root >= 0; root = parent[root])
    if (std::all_of(nodes.begin(), nodes.end(), [&](int node) { return is_above(parent, root, node); }))
      return root;
  return -1;
}

}  // namespace

GltfNodes gltf_nodes(const GltfFile& file, double metres, Work& work) {
  const Model& model = *file.model;
  GltfNodes out;
  const std::vector<int> order = in_order(model, out.parent);
  if (order.empty()) bad_gltf("the file has no nodes");
  out.local.resize(order.size());
  out.world.resize(order.size());
  for (int node : order) {
    out.local[node] = local_of(model.nodes[node]);
    const Decomposed& local = out.local[node];
    const Affine own = affine(local.move, local.turned, local.scale);
    out.world[node] = out.parent[node] < 0 ? own : out.world[out.parent[node]] * own;
  }
  const std::set<int> chosen = chosen_nodes(model, out.parent, order);
  const int root = common_root(out.parent, chosen);
  std::set<int> joints;
  for (int node : chosen)
    for (; node >= 0; node = out.parent[node]) {
      joints.insert(node);
      if (node == root) break;
    }

  Skeleton skeleton;
  std::set<std::string> names;
  std::map<std::string, int> last_number;
  auto unique = [&](std::string name, const std::string& otherwise) {
    if (name.empty()) name = otherwise;
    std::string free = name;
    while (!names.insert(free).second)
      free = fmt::format("{}_{}", name, ++last_number.try_emplace(name, 1).first->second);
    return free;
  };
  out.joint_of_node.assign(order.size(), -1);
  if (root < 0) {
    skeleton.joints.push_back({unique("scene", ""), -1, {}, {}});
    out.node_of_joint.push_back(-1);
    out.scale_of_parent.push_back(metres);
  } else if (out.parent[root] >= 0) {
    const Decomposed above = decomposed(out.world[out.parent[root]]);
    skeleton.above = above.turned;
    skeleton.above_offset = metres * above.move;
  }
  std::string uneven;
  for (int node : order) {
    if (!joints.count(node)) continue;
    const int parent = out.parent[node];
    const double scale = metres * (parent < 0 ? 1 : mean_scale(out.world[parent]));
    const Decomposed& local = out.local[node];
    Joint joint;
    joint.name = unique(model.nodes[node].name, fmt::format("node{}", node));
    joint.parent = node == root                                    ? -1
                   : parent >= 0 && out.joint_of_node[parent] >= 0 ? out.joint_of_node[parent]
                                                                   : 0;
    joint.offset = scale * local.move;
    joint.rest = local.turned;
    const double mean = cube_root(std::fabs(local.scale.x * local.scale.y * local.scale.z));
    if (const Vec3 apart = local.scale - mean * Vec3{1, 1, 1}; !(norm(apart) <= 1e-3 * mean))
      uneven = joint.name;
    out.joint_of_node[node] = skeleton.size();
    out.node_of_joint.push_back(node);
    out.scale_of_parent.push_back(scale);
    skeleton.joints.push_back(std::move(joint));
  }
  for (int node : order) {
    const tinygltf::Node& one = model.nodes[node];
    const int parent = out.parent[node];
    if (joints.count(node) || parent < 0 || out.joint_of_node[parent] < 0 || !one.children.empty() ||
        one.mesh >= 0 || one.camera >= 0)
      continue;
    skeleton.ends.push_back(
        {out.joint_of_node[parent], metres * mean_scale(out.world[parent]) * out.local[node].move, one.name});
  }
  if (!uneven.empty())
    work.report(warning("uneven-scale",
                        fmt::format("{} is scaled differently along its axes; its children's lengths are "
                                    "taken by the mean",
                                    uneven))
                    .at_joint(uneven));
  out.skeleton = std::make_shared<const Skeleton>(std::move(skeleton));
  return out;
}

}  // namespace kinegraph
