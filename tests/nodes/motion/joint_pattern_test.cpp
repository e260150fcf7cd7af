#include "nodes/motion/joint_pattern.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

class JointPattern : public ::testing::Test {
 protected:
  Alone work;
  Skeleton skeleton = sample_skeleton();

  std::string chosen(std::string_view pattern) {
    auto flags = chosen_joints(pattern, skeleton, "joints", work);
    std::string names;
    for (int j = 0; j < skeleton.size(); ++j)
      if (flags[j]) names += (names.empty() ? "" : " ") + skeleton.joints[j].name;
    return names;
  }
  std::string all() { return chosen("*"); }
  Diagnostic refusal(std::string_view pattern) {
    try {
      chosen(pattern);
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
    return {};
  }
};

TEST_F(JointPattern, an_exact_name_is_that_joint) {
  EXPECT_EQ(chosen("LeftArm"), "LeftArm");
}

TEST_F(JointPattern, a_star_stands_for_any_characters_or_none) {
  EXPECT_EQ(chosen("*Leg"), "LeftUpLeg LeftLeg RightUpLeg RightLeg");
  EXPECT_EQ(chosen("Left*Leg*"), "LeftUpLeg LeftLeg");
  EXPECT_EQ(chosen("H*e*d*"), "Head");
  EXPECT_EQ(chosen("H*s"), "Hips");
  EXPECT_EQ(chosen("**"), all());
}

TEST_F(JointPattern, case_counts) {
  EXPECT_EQ(refusal("leftarm").code, "unknown-joint");
  EXPECT_EQ(chosen("*arm"), "");
}

TEST_F(JointPattern, read_from_left_to_right) {
  EXPECT_EQ(chosen("*Leg,-Left*,LeftLeg"), "LeftLeg RightUpLeg RightLeg");
  EXPECT_EQ(chosen("LeftLeg,-LeftLeg"), "");
  EXPECT_EQ(chosen(" LeftLeg , Head "), "LeftLeg Head");
}

TEST_F(JointPattern, a_first_minus_starts_from_all) {
  EXPECT_EQ(chosen("-Left*,-Right*"), "Hips Spine Neck Head");
  EXPECT_EQ(chosen("Head,-Left*"), "Head");
}

TEST_F(JointPattern, an_arrow_is_the_joint_and_all_below_it) {
  EXPECT_EQ(chosen("Neck>"), "Neck Head");
  EXPECT_EQ(chosen("*UpLeg>,-*Foot>"), "LeftUpLeg LeftLeg RightUpLeg RightLeg");
  EXPECT_EQ(chosen("Hips>"), all());
}

TEST_F(JointPattern, an_empty_text_chooses_nothing) {
  EXPECT_EQ(chosen(""), "");
  EXPECT_EQ(chosen("  "), "");
}

TEST_F(JointPattern, a_backslash_takes_a_character_as_it_is) {
  skeleton.joints[1].name = "a,b*";
  skeleton.joints[2].name = "-c>";
  skeleton.joints[3].name = "d\\-e";
  EXPECT_EQ(chosen(R"(a\,b\*)"), "a,b*");
  EXPECT_EQ(chosen(R"(\-c\>)"), "-c>");
  EXPECT_EQ(chosen(R"(d\\-e,-\-c\>)"), "d\\-e");
  EXPECT_EQ(refusal(R"(a\b)").code, "bad-pattern");
  EXPECT_EQ(refusal("a\\").code, "bad-pattern");
}

TEST_F(JointPattern, an_unknown_name_names_the_nearest_and_the_parameter) {
  Diagnostic d = refusal("LeftArn");
  EXPECT_EQ(d.code, "unknown-joint");
  EXPECT_EQ(d.param, "joints");
  EXPECT_NE(d.hint.find("\"LeftArm\""), std::string::npos) << d.hint;
  EXPECT_EQ(refusal("*,-Heed").code, "unknown-joint");
}

TEST_F(JointPattern, a_wildcard_without_a_joint_is_a_warning) {
  EXPECT_EQ(chosen("*Tail*,Head"), "Head");
  ASSERT_EQ(work.reported.size(), 1u);
  EXPECT_EQ(work.reported[0].code, "no-joint");
  EXPECT_EQ(work.reported[0].severity, Severity::warning);
}

TEST_F(JointPattern, malformed_patterns_are_refused) {
  for (const char* pattern : {"a,,b", ",", "-", "Head,", "Sp>ine", ">", "Head>>"})
    EXPECT_EQ(refusal(pattern).code, "bad-pattern") << pattern;
}

TEST_F(JointPattern, names_without_a_tree_have_no_arrow) {
  std::vector<std::string> names = {"root", "Head"};
  EXPECT_EQ(chosen_names("*,-root", names, "features", work), (std::vector<bool>{false, true}));
  EXPECT_THROW(chosen_names("root>", names, "features", work), Failure);
}

TEST_F(JointPattern, in_a_table_the_most_specific_pattern_wins) {
  auto of = [&](std::vector<std::string> patterns, const char* joint) {
    return most_specific(patterns, skeleton, "weights", work)[skeleton.find(joint)];
  };
  EXPECT_EQ(of({"*", "Left*", "LeftArm", "*LeftArm*"}, "LeftArm"),
            2);                                              // exact before any number of characters
  EXPECT_EQ(of({"*", "Left*", "*LeftArm*"}, "LeftArm"), 2);  // then most literal characters
  EXPECT_EQ(of({"*rm", "*Ar*", "L*a"}, "LeftArm"), 1);       // then byte order: '*Ar*' < '*rm'
  EXPECT_EQ(of({"Left*", "Right*"}, "Head"), -1);
  EXPECT_EQ(of({"Head*", "Spine>"}, "Head"), 1);  // also of a joint taken from above
  EXPECT_EQ(of({"*nothing*", "Neck>"}, "Head"), 1);
  ASSERT_FALSE(work.reported.empty());
  EXPECT_EQ(work.reported.back().param, "weights");
  EXPECT_THROW(of({"Haed"}, "Head"), Failure);
}

}  // namespace
}  // namespace kinegraph
