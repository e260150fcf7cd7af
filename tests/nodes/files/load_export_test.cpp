// Load and Export as nodes: what they declare and what they do with files.
#include <gtest/gtest.h>

#include <set>

#include "nodes/all_nodes.h"
#include "nodes/files/file_ports.h"
#include "nodes/files/motion_file.h"
#include "nodes/motion/resample.h"
#include "tests/nodes/files/bvh_texts.h"
#include "tests/nodes/files/plain_files.h"

namespace kinegraph {
namespace {

// Runs one node without a graph.
class OneNode : public Compute {
 public:
  OneNode(const NodeType& type, Json::Object given) : type_(type) {
    Json::Object values;
    for (const Param& param : type.params) values[param.name] = completed(param, *param.fallback);
    for (auto& [name, value] : given) values[name] = value;
    if (type.resolve) type.resolve(values);
    params_ = Params(values);
  }
  void run() { type_.compute(*this); }

  const Params& params() const override { return params_; }
  Work& work() override { return work_; }
  FileAccess& files() override { return files_; }
  std::span<const ValuePtr> values(std::string_view port) const override {
    auto found = inputs_.find(std::string(port));
    return found == inputs_.end() ? std::span<const ValuePtr>() : std::span<const ValuePtr>(found->second);
  }
  bool wanted(std::string_view output) const override { return wanted_.count(std::string(output)) > 0; }
  void set_output(std::string_view port, ValuePtr value) override {
    outputs_[std::string(port)] = std::move(value);
  }
  void write_file(std::string_view, std::string_view bytes, std::string_view companion) override {
    written_[std::string(companion)] = bytes;
  }
  void rule(std::string_view, double, double, bool) override {}

  const NodeType& type_;
  Params params_;
  Alone work_;
  PlainFiles files_;
  std::map<std::string, std::vector<ValuePtr>> inputs_;
  std::set<std::string> wanted_;
  std::map<std::string, ValuePtr> outputs_;
  std::map<std::string, std::string> written_;
};

std::string code_of(OneNode& node) {
  try {
    node.run();
  } catch (const Failure& failure) {
    return failure.diagnostic().code;
  }
  return "done";
}

TEST(Load, GivesTheFilesMotionAndRefusesWhatItHasNot) {
  const Registry registry = all_nodes();
  OneNode load(*registry.find("Load"), {{"file", "/clip.bvh"}, {"unit", "m"}, {"fps", 50.0}});
  load.files_.made["/clip.bvh"] = small_bvh(two_frames());
  load.wanted_ = {"motion"};
  ASSERT_EQ(code_of(load), "done");
  const auto motion = std::dynamic_pointer_cast<const Motion>(load.outputs_["motion"]);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->fps(), 50);
  EXPECT_EQ(motion->frames(), 3u);
  load.wanted_ = {"stats"};
  EXPECT_EQ(code_of(load), "no-such-content");
}

TEST(Load, ResolvesTheFormatSoThatKeysHoldNoName) {
  const Registry registry = all_nodes();
  const NodeType& type = *registry.find("Load");
  EXPECT_EQ(OneNode(type, {{"file", "/a/CLIP.BVH"}}).params().text("format"), "bvh");
  EXPECT_EQ(OneNode(type, {{"file", "/a/clip.amc"}}).params().text("format"), "asf-amc");
  EXPECT_EQ(OneNode(type, {{"file", "/a/clip.xyz"}}).params().text("format"), "auto");
  EXPECT_EQ(OneNode(type, {{"file", "/a/clip.amc"}, {"format", "bvh"}}).params().text("format"), "bvh");
}

TEST(Load, TellsTheFormatByContentWhereTheNameDoesNot) {
  const Registry registry = all_nodes();
  OneNode load(*registry.find("Load"), {{"file", "/clip.txt"}});
  load.files_.made["/clip.txt"] = small_bvh(two_frames());
  EXPECT_EQ(code_of(load), "done");
  load.files_.made["/clip.txt"] = "what is this";
  EXPECT_EQ(code_of(load), "unknown-format");
}

TEST(Load, NamesTheSkeletonOfAnAmcAsCompanion) {
  const Registry registry = all_nodes();
  const NodeType& type = *registry.find("Load");
  PlainFiles files;
  files.made["/a/16.asf"] = "";
  EXPECT_EQ(type.companions(OneNode(type, {{"file", "/a/16_45.amc"}}).params(), files),
            std::vector<std::string>{"/a/16.asf"});
  EXPECT_TRUE(
      type.companions(OneNode(type, {{"file", "/a/16_45.amc"}, {"skeleton", "/b.asf"}}).params(), files)
          .empty());
  EXPECT_TRUE(type.companions(OneNode(type, {{"file", "/a/16_45.bvh"}}).params(), files).empty());
}

TEST(Load, SaysWhatCanBeReadOfAFormatItCannotTell) {
  const Registry registry = all_nodes();
  OneNode load(*registry.find("Load"), {{"file", "/clip.xyz"}});
  load.files_.made["/clip.xyz"] = "who knows";
  try {
    load.run();
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "unknown-format");
    EXPECT_NE(failure.diagnostic().hint.find("bvh"), std::string::npos);
  }
}

TEST(Export, WritesWhatLoadReads) {
  const Registry registry = all_nodes();
  OneNode load(*registry.find("Load"), {{"file", "/clip.bvh"}});
  load.files_.made["/clip.bvh"] = small_bvh(two_frames());
  load.run();
  OneNode save(*registry.find("Export"), {{"file", "/out/result.bvh"}});
  EXPECT_EQ(code_of(save), "nothing-to-write");
  save.inputs_["motion"] = {load.outputs_["motion"]};
  ASSERT_EQ(code_of(save), "done");
  OneNode again(*registry.find("Load"), {{"file", "/back.bvh"}});
  again.files_.made["/back.bvh"] = save.written_.at("");
  again.run();
  const auto& was = dynamic_cast<const Motion&>(*load.outputs_["motion"]);
  const auto& is = dynamic_cast<const Motion&>(*again.outputs_["motion"]);
  EXPECT_EQ(*was.source().read, *is.source().read);
}

TEST(Export, RefusesWhatAFormatCannotHold) {
  const Registry registry = all_nodes();
  OneNode load(*registry.find("Load"), {{"file", "/clip.bvh"}});
  load.files_.made["/clip.bvh"] = small_bvh(two_frames());
  load.run();
  for (const auto& [file, code] : {std::pair{"/out/a.json", "wrong-content"},
                                   {"/out/a.trc", "wrong-content"},
                                   {"/out/a", "unknown-format"}}) {
    OneNode save(*registry.find("Export"), {{"file", file}});
    save.inputs_["motion"] = {load.outputs_["motion"]};
    EXPECT_EQ(code_of(save), code) << file;
  }
  OneNode both(*registry.find("Export"), {{"file", "/out/a.bvh"}});
  both.inputs_["motion"] = both.inputs_["points"] = {load.outputs_["motion"]};
  EXPECT_EQ(code_of(both), "several-inputs");
}

TEST(Resampled, KeepsLengthAndPassesThroughTheFrames) {
  Alone work;
  auto skeleton = std::make_shared<Skeleton>();
  skeleton->joints = {{"a", -1, {}, {}}};
  Motion motion(skeleton, nullptr, 30, 31, {true});
  for (std::size_t t = 0; t < 31; ++t) {
    motion.translation(0).set(t, {double(t), double(t * t), 0});
    motion.rotation(0).set(t, about_y(0.1 * double(t)));
  }
  const Motion finer = resampled(motion, 120, work);
  ASSERT_EQ(finer.frames(), 121u);
  for (std::size_t t = 0; t < 31; ++t) {
    EXPECT_EQ(finer.translation(0)[4 * t], motion.translation(0)[t]);
    EXPECT_LT(turn(finer.rotation(0)[4 * t], motion.rotation(0)[t]), 1e-7);
  }
  EXPECT_NEAR(finer.translation(0)[6].x, 1.5, 1e-12);
  EXPECT_NEAR(finer.translation(0)[6].y, 2.25, 1e-12);  // a parabola stays one
  EXPECT_NEAR(heading_of(finer.rotation(0)[6]), 0.15, 1e-9);
  EXPECT_EQ(resampled(motion, 15, work).frames(), 16u);
}

}  // namespace
}  // namespace kinegraph
