#include <gtest/gtest.h>

#include "nodes/all_nodes.h"
#include "nodes/gait/gait.h"
#include "nodes/gait/gait_styles.h"

namespace kinegraph {
namespace {

TEST(GaitNode, DescribesEveryGaitAndItsDefaults) {
  const Registry registry = all_nodes();
  const NodeType* type = registry.find("Gait");
  ASSERT_TRUE(type);
  const Param* gait = type->find_param("gait");
  ASSERT_TRUE(gait);
  ASSERT_EQ(gait->choices.size(), gait_styles().size());
  EXPECT_EQ(gait->choices.front().key, GaitParams().gait);
  for (const char* name : {"speed", "cadence", "stride", "bounce", "lean", "crouch", "arm_swing", "limp",
                           "seconds", "fps", "seed"})
    EXPECT_TRUE(type->find_param(name)) << name;
  ASSERT_EQ(type->outputs.size(), 1u);
  EXPECT_EQ(type->outputs[0].type, "Motion");
}

}  // namespace
}  // namespace kinegraph
