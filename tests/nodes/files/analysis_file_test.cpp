#include "nodes/files/analysis_file.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/metrics.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"

namespace kinegraph {
namespace {

std::string bytes_of(const Value& value) {
  Encoder encoder;
  value.encode(encoder);
  return encoder.take();
}

Stats some_stats() {
  Stats stats;
  JointStats root{"Hips, \"the root\"", true, normalized(Quat{0.1, -0.2, 0.3, 0.4}), 1.0 / 3};
  JointStats leg{"Leg", false, {}, 0};
  stats.joints = {root, leg};
  stats.parents = {-1, 0};
  stats.offsets = {{0, 0.9, 0}, {0.1, -0.2, 1e-17}};
  stats.rests = {{}, normalized(Quat{0.5, 0, 0, 1})};
  stats.root_mean = {0.1, 1.2, 0.9, -1e-9};
  stats.root_spread = {1e-300, 0.2, 0.3, 2.0 / 7};
  stats.leg_length = 0.87;
  stats.frames = 277;
  return stats;
}
Warp some_warp() {
  Warp warp;
  warp.identity = false;
  warp.source_frames = 5;
  warp.reference_frames = 4;
  warp.paths = {{0, 1, 3, 4}};
  warp.skipped = {{2, 0.1, 0.2, 0.3, 0.4, {1.0 / 3, 2, 3}}};
  warp.energy = {10, 0.1};
  warp.rounds = 1;
  return warp;
}
Contacts some_contacts() {
  Contacts contacts;
  contacts.frames = 6;
  contacts.floor = -0.01;
  contacts.points = {
      {"LeftFoot", true, "heel", 3, "LeftFoot", {0, 0.1, 0}, {true, true, false, false, true, false}},
      {"RightFoot", false, "ball", 8, "RightToe", {}, {false, false, true, true, true, true}}};
  return contacts;
}
Metrics some_metrics() {
  Metrics metrics;
  metrics.all = {{"skate", 1.0 / 3, "m/s"}, {"style_distance", {}, "°"}};
  return metrics;
}

TEST(AnalysisFile, ReadsBackWithoutLoss) {
  Alone work;
  const Stats stats = some_stats();
  const Warp warp = some_warp();
  const Contacts contacts = some_contacts();
  const Metrics metrics = some_metrics();
  Stats euler = some_stats();
  euler.space = "euler";
  euler.joints[0].order = "ZYX";
  euler.joints[0].euler_mean = {0.1, 0.2, 1.0 / 3};
  for (const auto& [port, value] : {std::pair<const char*, const Value*>{"stats", &stats},
                                    {"stats", &euler},
                                    {"warp", &warp},
                                    {"contacts", &contacts},
                                    {"metrics", &metrics}}) {
    const AnalysisFile back = read_analysis(write_analysis(*kind_of_port(port), *value, work), work);
    EXPECT_EQ(back.kind->port, port);
    EXPECT_EQ(bytes_of(*back.value), bytes_of(*value)) << port;
  }
}

TEST(AnalysisFile, WritesTables) {
  Alone work;
  EXPECT_EQ(metrics_table(some_metrics(), work),
            "name,value,unit\nskate,0.3333333333333333,m/s\nstyle_distance,,°\n");
  EXPECT_EQ(warp_table(some_warp(), work), "row,frame\n0,0\n1,1\n2,3\n3,4\n");
  EXPECT_EQ(contacts_table(some_contacts(), work).substr(0, 47),
            "frame,time,LeftFoot.heel,RightFoot.ball\n0,0,1,0");
  const std::string stats = stats_table(some_stats(), work);
  EXPECT_EQ(stats.substr(0, stats.find('\n')), "name,mean.x,mean.y,mean.z,mean.w,spread");
  EXPECT_NE(stats.find("\n\"Hips, \"\"the root\"\"\","), std::string::npos);
  EXPECT_EQ(stats.find("Leg"), std::string::npos);  // not chosen
}

std::string code_of(const std::string& text) {
  Alone work;
  try {
    read_analysis(text, work);
  } catch (const Failure& failure) {
    return failure.diagnostic().code;
  }
  return "read";
}
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
  return text.replace(text.find(what), what.size(), by);
}

TEST(AnalysisFile, RefusesWhatItDoesNotKnow) {
  Alone work;
  const std::string good = write_analysis(*kind_of_port("contacts"), some_contacts(), work);
  EXPECT_EQ(code_of(good), "read");
  EXPECT_EQ(code_of("[]"), "not-an-analysis");
  EXPECT_EQ(code_of("{}"), "not-an-analysis");
  EXPECT_EQ(code_of(replaced(good, "kinegraph-contacts", "kinegraph-contact")), "not-an-analysis");
  EXPECT_EQ(code_of(replaced(good, "\"schema\": 1", "\"schema\": 2")), "newer-schema");
  EXPECT_EQ(code_of(replaced(good, "\"floor\"", "\"flor\"")), "bad-analysis");
  EXPECT_EQ(code_of(replaced(good, "\"frames\": 6", "\"frames\": 3")), "bad-analysis");
  EXPECT_EQ(code_of(replaced(good, "\"frames\": 6", "\"frames\": 1e300")), "bad-analysis");
  EXPECT_NE(code_of(good.substr(0, good.size() / 2)), "read");
}

}  // namespace
}  // namespace kinegraph
