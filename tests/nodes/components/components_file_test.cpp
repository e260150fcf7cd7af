#include <gmock/gmock.h>

#include "nodes/components/component_edit.h"
#include "nodes/files/analysis_file.h"
#include "nodes/files/clip_json.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/motion/sample_motion.h"

namespace kinegraph {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const AnalysisKind& components_kind() {
  return *kind_of_port("components");
}

Components grouped(Representation representation) {
  Alone work;
  ComponentEditParams params;
  params.edits = {edits::Merge{"both", {{{1, ""}, 0.5}, {{2, ""}, 1}}}, edits::Substitute{{1, ""}}};
  const Components found =
      analysed({shared(gait("walk", 1)), shared(gait("sneak", 1.3))}, representation, 2, work);
  return edit_components(found, params, {nullptr, shared(gait("run", 1)), nullptr}, work).components;
}

TEST(ComponentsFile, ReadsBackEveryBit) {
  Alone work;
  for (Representation representation : {Representation::points, Representation::quaternions,
                                        Representation::euler, Representation::logarithm}) {
    const Components components = grouped(representation);
    ASSERT_FALSE(components.segments[0].added.data.empty());
    const AnalysisFile read = read_analysis(write_analysis(components_kind(), components, work), work);
    EXPECT_TRUE(encoded(*read.value) == encoded(components)) << name_of(representation);
  }
}

TEST(ComponentsFile, ReadsBackPoints) {
  Alone work;
  auto clip = std::make_shared<Points>(std::vector<std::string>{"a", "b", "c", "d"}, 60, 30);
  for (int i = 0; i < 4; ++i)
    for (std::size_t t = 0; t < 30; ++t)
      clip->track(i).set(
          t, {sine(0.1 * static_cast<double>(t * (i + 1))), 1.0 * i, 0.01 * static_cast<double>(t)});
  clip->links = {{0, 1}};
  clip->set_missing(3, 7);
  IcaParams params;
  params.components = 2;
  const auto space = space_of_points({clip}, Stabilise::none, {true, true, true, false});
  const Components components = components_of_points(space, {clip}, params, work);
  EXPECT_EQ(encoded(*read_analysis(write_analysis(components_kind(), components, work), work).value),
            encoded(components));
}

TEST(ComponentsFile, KeepsAFilesOwnAnglesForExport) {
  KINEGRAPH_NEEDS_MOCAP();
  Alone work;
  const Components components = analysed({real_clip("cmu/bvh/09_06.bvh")}, Representation::points, 2, work);
  const std::string text = write_analysis(components_kind(), components, work);
  const AnalysisFile read = read_analysis(text, work);
  EXPECT_TRUE(write_analysis(components_kind(), *read.value, work) == text);
  const auto& clip = *dynamic_cast<const Components&>(*read.value).segments[0].motion;
  ASSERT_TRUE(clip.source().read);
  EXPECT_TRUE(*clip.source().read == *components.segments[0].motion->source().read);
}

TEST(ComponentsFile, IsATableOfSignals) {
  Alone work;
  const Components components = grouped(Representation::points);
  const std::string table = components_table(components, work);
  EXPECT_THAT(table, StartsWith("frame,segment,u1,u2\n0,0,"));
  EXPECT_THAT(table, HasSubstr("\n0,1,"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'),
            static_cast<std::ptrdiff_t>(components.frames() + 1));
}

TEST(ComponentsFile, SaysWhatIsWrongAndWhere) {
  Alone work;
  const std::string good = write_analysis(components_kind(), grouped(Representation::points), work);
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    text.replace(at, from.size(), to);
    try {
      read_analysis(text, work);
    } catch (const Failure& failure) {
      EXPECT_GT(failure.diagnostic().place.line, 0);
      return failure.diagnostic().code;
    }
    return std::string("read");
  };
  EXPECT_EQ(refused("\"representation\": \"points\"", "\"representation\": \"marks\""), "bad-analysis");
  EXPECT_EQ(refused("\"mean\"", "\"meen\""), "bad-analysis");
  EXPECT_EQ(refused("\"shares\": [", "\"shares\": [1, "), "bad-analysis");
  EXPECT_EQ(refused("\"parent\": 0", "\"parent\": 12"), "bad-analysis");
  EXPECT_EQ(refused("AAAA", "?AAA"), "bad-analysis");
}

TEST(ComponentsFile, CarriesBytesAsBase64) {
  for (const char* bytes : {"", "M", "Ma", "Man", "Many"}) {
    std::string back;
    EXPECT_TRUE(from_base64(base64(bytes), back));
    EXPECT_EQ(back, bytes);
  }
  EXPECT_EQ(base64("Many"), "TWFueQ==");
  std::string back;
  for (const char* bad : {"TWF", "TW=u", "TW!u", "=WFu"}) EXPECT_FALSE(from_base64(bad, back)) << bad;
}

}  // namespace
}  // namespace kinegraph
