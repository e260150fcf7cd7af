// What a program built without Assimp says to an FBX: this one has nodes/files/fbx_without_assimp.cpp in it.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

TEST(WithoutAssimp, FbxIsRefusedWithWhatToDo) {
  PlainFiles files;
  for (const char* bytes : {"Kaydara FBX Binary  \x1a\0", "; FBX 7.4.0 project file\n"}) {
    files.made["/walks/dance.fbx"] = bytes;
    Alone work;
    try {
      read_motion_file("/walks/dance.fbx", {}, files, work);
      ADD_FAILURE();
    } catch (const Failure& failure) {
      const Diagnostic& told = failure.diagnostic();
      EXPECT_EQ(told.code, "no-fbx");
      EXPECT_NE(told.message.find("built without Assimp"), std::string::npos) << told.message;
      EXPECT_EQ(told.file, "/walks/dance.fbx");
      for (const char* way : {"libassimp-dev", "build again", "GLB", "Blender"})
        EXPECT_NE(told.hint.find(way), std::string::npos) << told.hint;
    }
  }
}

TEST(WithoutAssimp, OtherFilesAreReadAsEver) {
  PlainFiles files;
  Alone work;
  const MotionFile walk = read_motion_file(source_folder() + "/graphs/clips/walk.bvh", {}, files, work);
  EXPECT_GT(walk.motion()->frames(), 100u);
}

}  // namespace
}  // namespace kinegraph
