#include "nodes/time/joint_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "graph/diagnostic.h"
#include "nodes/motion/joint_names.h"
#include "nodes/node_params.h"

namespace kinegraph {

namespace {

std::vector<std::string> names_of(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

class Pairing {
 public:
  Pairing(const Skeleton& source, const Skeleton& target) : source_(source), target_(target) {
    out_.source = find_body(source);
    out_.target = find_body(target);
    out_.source_of.assign(target.joints.size(), -1);
    taken_.assign(source.joints.size(), false);
    out_.source_pelvis = out_.source.pelvis;
    out_.target_pelvis = out_.target.pelvis;
  }

  void bodies() {
    const Body &a = out_.source, &b = out_.target;
    if (a.pelvis < 0 || b.pelvis < 0) return;
    pair(a.pelvis, b.pelvis);
    chains(a.spine, b.spine);
    std::vector<int> from = a.neck, to = b.neck;
    if (a.head >= 0 && b.head >= 0) {
      from.push_back(a.head);
      to.push_back(b.head);
    }
    chains(from, to);
    for (const Arm& one : a.arms)
      for (const Arm& other : b.arms) {
        if (one.left != other.left) continue;
        pair(one.clavicle, other.clavicle);
        pair(one.upper, other.upper);
        pair(one.forearm, other.forearm);
        pair(one.hand, other.hand);
      }
    for (const Leg& one : a.legs)
      for (const Leg& other : b.legs) {
        if (one.left != other.left) continue;
        pair(one.hip, other.hip);
        pair(one.knee, other.knee);
        pair(one.ankle, other.ankle);
        pair(one.toe, other.toe);
      }
  }

  // What is called alike and hangs below partners of each other.
  void names() {
    const std::vector<int> equal = partners(source_, target_, {});
    std::map<std::pair<Side, std::string>, int> by_word;
    for (int i = 0; i < source_.size(); ++i) by_word.emplace(key_of(source_, i), i);
    for (int j = 0; j < target_.size(); ++j) {
      if (out_.source_of[j] >= 0) continue;
      if (hangs_well(equal[j], j)) {
        pair(equal[j], j);
      } else if (auto found = by_word.find(key_of(target_, j));
                 found != by_word.end() && hangs_well(found->second, j)) {
        pair(found->second, j);
      }
    }
  }

  void told(const std::vector<std::string>& map) {
    std::vector<std::string> by(target_.joints.size());  // the entry that named a joint of the target
    for (std::size_t k = 0; k < map.size(); ++k) {
      const std::string& entry = map[k];
      const std::string param = fmt::format("map[{}]", k);
      const auto equals = entry.find('=');
      if (equals == entry.npos || entry.size() == 1)
        throw Failure(error("bad-map", fmt::format("\"{}\" is not of the form FROM=TO", entry))
                          .at_param(param)
                          .hinting("write a joint of the motion, =, and a joint of the target; =TO or FROM= "
                                   "takes a joint out"));
      const std::string from = entry.substr(0, equals), to = entry.substr(equals + 1);
      const int i = from.empty() ? -1 : joint_of(source_, from, target_, "motion", entry, param);
      const int j = to.empty() ? -1 : joint_of(target_, to, source_, "target", entry, param);
      if (j < 0) {
        for (int& one : out_.source_of)
          if (one == i) one = -1;
        continue;
      }
      if (!by[j].empty() && by[j] != entry)
        throw Failure(
            error("bad-map", fmt::format("\"{}\" and \"{}\" both lead to the target's {}", by[j], entry, to))
                .at_param(param)
                .at_joint(to)
                .hinting("name each joint of the target once"));
      by[j] = entry;
      // The joint that was found for it before is not what was meant.
      if (i >= 0)
        for (int other = 0; other < target_.size(); ++other)
          if (out_.source_of[other] == i && by[other].empty()) out_.source_of[other] = -1;
      out_.source_of[j] = i;
    }
  }

  JointPairs finished(Work& work) {
    if (std::all_of(out_.source_of.begin(), out_.source_of.end(), [](int i) { return i < 0; }))
      throw Failure(no_common_joint());
    choose_pelvis();
    // What stands above the pelvis carries the path.
    for (int j = 0; j < target_.size(); ++j)
      if (is_above_pelvis(j)) out_.source_of[j] = -1;
    std::vector<std::string> alone;
    for (int j = 0; j < target_.size(); ++j)
      if (out_.source_of[j] < 0 && !is_above_pelvis(j) && !is_between(j))
        alone.push_back(target_.joints[j].name);
    if (!alone.empty())
      work.report(warning("no-partner", fmt::format("{} of the target's {} joints have no partner in the "
                                                    "motion and stay at rest: {}",
                                                    alone.size(), target_.size(), listed(alone)))
                      .hinting("name partners with the parameter map, as FROM=TO"));
    return std::move(out_);
  }

 private:
  static std::pair<Side, std::string> key_of(const Skeleton& skeleton, int joint) {
    JointName name = read_joint_name(skeleton.joints[joint].name);
    // Fingers are those of a hand everywhere; the first joint of one may go without a number.
    if (name.word.starts_with("hand") && name.word.size() > 4) name.word.erase(0, 4);
    if (name.word.starts_with("mid") && !name.word.starts_with("middle")) name.word.insert(3, "dle");
    return {name.side, name.word};
  }

  void pair(int i, int j) {
    if (i < 0 || j < 0) return;
    out_.source_of[j] = i;
    taken_[i] = true;
  }

  // First with first and last with last, those between by their share of the way.
  void chains(const std::vector<int>& from, const std::vector<int>& to) {
    if (from.empty() || to.empty()) return;
    if (to.size() == 1 || from.size() == 1) return pair(from.back(), to.back());
    std::size_t next = 0;  // of `from`
    for (std::size_t k = 0; k < to.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(to.size() - 1);
      const auto at = static_cast<std::size_t>(share * static_cast<double>(from.size() - 1) + 0.5);
      const bool last = k + 1 == to.size();
      if (at < next || (!last && at + 1 == from.size())) continue;  // taken, or the last one's
      pair(from[at], to[k]);
      next = at + 1;
    }
  }

  bool hangs_well(int i, int j) const {
    if (i < 0 || taken_[i] || is_middle(out_.source, i) || is_middle(out_.target, j)) return false;
    int above = target_.joints[j].parent;
    while (above >= 0 && out_.source_of[above] < 0) above = target_.joints[above].parent;
    return above < 0 ? true : source_.is_below(i, out_.source_of[above]);
  }
  static bool is_middle(const Body& body, int joint) {
    return std::count(body.spine.begin(), body.spine.end(), joint) > 0 ||
           std::count(body.neck.begin(), body.neck.end(), joint) > 0 || joint == body.head ||
           joint == body.pelvis;
  }
  // A joint of spine or neck below one with a partner shares in what that one does.
  bool is_between(int j) const {
    const Body& body = out_.target;
    if (!is_middle(body, j) || j == body.head || j == body.pelvis) return false;
    return std::any_of(out_.source_of.begin() + j + 1, out_.source_of.end(), [](int i) { return i >= 0; });
  }
  bool is_above_pelvis(int j) const {
    return j != out_.target_pelvis && target_.is_below(out_.target_pelvis, j);
  }

  static int joint_of(const Skeleton& skeleton, const std::string& name, const Skeleton& other,
                      const char* which, const std::string& entry, const std::string& param) {
    if (const int joint = skeleton.find(name); joint >= 0) return joint;
    std::string hint = suggestion(name, names_of(skeleton));
    if (other.find(name) >= 0)
      hint = fmt::format("{} is a joint of the other side: FROM is the motion's, TO the target's", name);
    throw Failure(
        error("unknown-joint", fmt::format("\"{}\": the {} has no joint \"{}\"", entry, which, name))
            .at_param(param)
            .at_joint(name)
            .hinting(hint));
  }

  Diagnostic no_common_joint() const {
    const auto what = [](const Skeleton& skeleton, const Body& body) {
      return fmt::format("{} joint{} ({}){}", skeleton.size(), skeleton.size() == 1 ? "" : "s",
                         listed(names_of(skeleton)), body.pelvis < 0 ? ", in which no body is seen" : "");
    };
    const bool unseen = out_.source.pelvis < 0 || out_.target.pelvis < 0;
    return error(
               unseen ? "no-body" : "no-common-joint",
               fmt::format("nothing tells which joints belong together: the motion has {}; the target has {}",
                           what(source_, out_.source), what(target_, out_.target)))
        .at_port(out_.target.pelvis < 0 ? "target" : "motion")
        .hinting("name the joints that belong together with map, as FROM=TO; a camera or a prop has none");
  }

  // Without a body, or with a map that puts the pelvis elsewhere: the topmost pair.
  void choose_pelvis() {
    int& pelvis = out_.target_pelvis;
    if (pelvis >= 0 && out_.source_of[pelvis] >= 0) {
      out_.source_pelvis = out_.source_of[pelvis];
      return;
    }
    const auto first =
        std::find_if(out_.source_of.begin(), out_.source_of.end(), [](int i) { return i >= 0; });
    pelvis = static_cast<int>(first - out_.source_of.begin());
    out_.source_pelvis = *first;
  }

  const Skeleton& source_;
  const Skeleton& target_;
  JointPairs out_;
  std::vector<bool> taken_;
};

}  // namespace

JointPairs pair_joints(const Skeleton& source, const Skeleton& target, const std::vector<std::string>& map,
                       Work& work) {
  Pairing pairing(source, target);
  pairing.bodies();
  pairing.names();
  pairing.told(map);
  return pairing.finished(work);
}

}  // namespace kinegraph
