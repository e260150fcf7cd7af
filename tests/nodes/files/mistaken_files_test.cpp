// Files that people give by mistake: empty, of another kind than their ending says, in UTF-16, no motion at
// all.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "nodes/files/text_place.h"
#include "tests/nodes/files/bvh_texts.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

const char* const endings[] = {"bvh", "amc", "asf", "glb", "gltf", "c3d", "trc", "csv", "json", "fbx"};

Diagnostic refusal(const std::string& name, const std::string& bytes) {
  PlainFiles files;
  files.made[name] = bytes;
  Alone work;
  try {
    read_motion_file(name, {}, files, work);
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << name << " loaded";
  return {};
}

TEST(MistakenFiles, ThatAreEmptyAreSaidToBe) {
  for (const char* ending : endings) {
    const Diagnostic said = refusal(std::string("/it.") + ending, "");
    EXPECT_EQ(said.code, "empty-file") << ending;
    EXPECT_EQ(said.file, std::string("/it.") + ending);
  }
}

TEST(MistakenFiles, InUtf16AreToBeSavedAsUtf8) {
  for (const char* ending : {"bvh", "asf", "gltf", "trc", "csv", "json"})
    for (const std::string& mark : {std::string("\xFF\xFE"), std::string("\xFE\xFF")}) {
      const Diagnostic said = refusal(std::string("/it.") + ending, mark + std::string("H\0I\0", 4));
      EXPECT_EQ(said.code, "utf-16") << ending;
      EXPECT_NE(said.hint.find("UTF-8"), std::string::npos);
    }
}

TEST(MistakenFiles, WithAnothersEndingAreSaidToBeginAsTheOther) {
  const std::string bvh = small_bvh(two_frames());
  const std::string glb = std::string("glTF\2\0\0\0", 8) + std::string(100, '\0');
  std::string c3d(600, '\0');
  c3d[0] = 2;
  c3d[1] = 0x50;
  struct Case {
    const char *name, *is;
    const std::string& bytes;
  };
  for (const Case& one :
       {Case{"/it.c3d", "bvh", bvh}, Case{"/it.glb", "bvh", bvh}, Case{"/it.trc", "bvh", bvh},
        Case{"/it.csv", "bvh", bvh}, Case{"/it.fbx", "bvh", bvh}, Case{"/it.bvh", "gltf", glb},
        Case{"/it.c3d", "gltf", glb}, Case{"/it.bvh", "c3d", c3d}, Case{"/it.asf", "c3d", c3d}}) {
    const Diagnostic said = refusal(one.name, one.bytes);
    EXPECT_NE(said.hint.find(std::string("begins as ") + one.is), std::string::npos)
        << one.name << ": " << said.message << " (" << said.hint << ")";
  }
}

TEST(MistakenFiles, ThatAreNoneOfThemAreRefusedInWordsATerminalCanShow) {
  std::string junk;
  for (int i = 0; i < 4000; ++i) junk += static_cast<char>((i * 7919 + i * i * 31) % 251 + 3);
  junk.replace(0, 8, "\x1b[2J\x07\xC5\x80\x9B");
  for (const char* ending : endings) {
    const Diagnostic said = refusal(std::string("/it.") + ending, junk);
    for (const std::string& text : {said.message, said.hint}) {
      bool changed = false;
      as_utf8(text, changed);
      EXPECT_FALSE(changed) << ending << ": " << text;
      for (char c : text) EXPECT_GE(static_cast<unsigned char>(c), ' ') << ending << ": " << text;
    }
    EXPECT_EQ((said.message + said.hint).find("kinegraph"), std::string::npos) << said.message << said.hint;
  }
  EXPECT_EQ(refusal("/it.glb", junk).code, "not-gltf");
}

// Of a glTF the evaluator asks for the files beside it before anything is read.
TEST(MistakenFiles, AreNamedAlsoWhereTheirCompanionsAreAskedFor) {
  for (const char* bytes : {"", "junk", "{", "glTF"}) {
    PlainFiles files;
    files.made["/it.glb"] = bytes;
    try {
      companions_of("/it.glb", {}, files);
      ADD_FAILURE() << bytes;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().file, "/it.glb") << bytes;
    }
  }
}

TEST(MistakenFiles, ThatEndTooSoonAreSaidToEndThere) {
  const std::string whole = small_bvh(two_frames());
  const Diagnostic said = refusal("/it.bvh", whole.substr(0, whole.find("OFFSET 0 -0.9")));
  EXPECT_NE(said.message.find("the end of the file"), std::string::npos) << said.message;
}

}  // namespace
}  // namespace kinegraph
