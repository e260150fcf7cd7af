#include "nodes/motion/cut_links.h"

#include <gmock/gmock.h>

namespace kinegraph {
namespace {

Skeleton tree(const std::vector<std::pair<std::string, std::string>>& joints) {
  Skeleton skeleton;
  for (const auto& [name, parent] : joints)
    skeleton.joints.push_back({name, skeleton.find(parent), {0.1, 0, 0}, {}});
  return skeleton;
}

TEST(CutLinks, LieBetweenAJointAndTheNextInTheOrderOfTheirNumbers) {
  const Skeleton leg = tree({{"Shin", ""},
                             {"Shin_2", "Shin"},
                             {"Shin_3_", "Shin_2"},
                             {"Foot", "Shin_3_"},
                             {"Foot_2", "Foot"},
                             {"Toe", "Foot_2"}});
  const std::vector<bool> cut = on_cut_links(leg);
  EXPECT_THAT(cut, testing::ElementsAre(false, true, true, false, true, false));
  EXPECT_EQ(whole_parent(leg, cut, leg.find("Foot")), leg.find("Shin"));
  EXPECT_EQ(whole_parent(leg, cut, leg.find("Toe")), leg.find("Foot"));
  EXPECT_EQ(whole_parent(leg, cut, 0), -1);
}

TEST(CutLinks, AreNotTailsTipsAndBranchesThatHaveNumbers) {
  // A tail of numbers from 1, a tip, a branching joint, a number left out.
  for (const Skeleton& skeleton : {tree({{"tail_1", ""}, {"tail_2", "tail_1"}, {"tail_3", "tail_2"}}),
                                   tree({{"Foot", ""}, {"Foot_2", "Foot"}}),
                                   tree({{"Foot", ""}, {"Foot_2", "Foot"}, {"a", "Foot_2"}, {"b", "Foot_2"}}),
                                   tree({{"Foot", ""}, {"Foot_3", "Foot"}, {"a", "Foot_3"}})})
    EXPECT_THAT(on_cut_links(skeleton), testing::Each(false));
}

}  // namespace
}  // namespace kinegraph
