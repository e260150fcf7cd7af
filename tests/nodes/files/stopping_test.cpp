// Writing and reading long files can be stopped: both ask as they go on, and what they throw comes out.
#include <gtest/gtest.h>

#include "nodes/files/motion_file.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/files/plain_files.h"
#include "tests/nodes/time/walks.h"

namespace kinegraph {
namespace {

// Counts how often it is asked, and stops at the last that is allowed.
class Counted : public Alone {
 public:
  explicit Counted(long last = -1) : last_(last) {}
  void check() override {
    if (++asked == last_) throw Cancelled();
  }
  void progress(double) override { check(); }
  long asked = 0;

 private:
  long last_;
};

struct Long {
  const char* name;
  const char* port;
  const char* path;
};
void PrintTo(const Long& one, std::ostream* out) {
  *out << one.name;
}

// Some megabytes of each.
const ValuePtr& value_of(const std::string& port) {
  static const auto motion = std::make_shared<const Motion>(gait("walk", 40, 120));
  static const ValuePtr points = points_of_motion(*motion);
  static const ValuePtr components = [] {
    Alone work;
    const Clips clips{motion, motion};
    return std::make_shared<const Components>(analysed(clips, Representation::points, 2, work));
  }();
  static const ValuePtr plain = motion;
  return port == "motion" ? plain : port == "points" ? points : components;
}

const Long all[] = {
    {"Bvh", "motion", "/x/long.bvh"},        {"Glb", "motion", "/x/long.glb"},
    {"Csv", "points", "/x/long.csv"},        {"Trc", "points", "/x/long.trc"},
    {"C3d", "points", "/x/long.c3d"},        {"Json", "components", "/x/long.json"},
    {"Table", "components", "/x/table.csv"},
};

class Stopping : public testing::TestWithParam<Long> {
 protected:
  std::string written(Work& work) const {
    return encode_motion_file(GetParam().path, "auto", {{GetParam().port, value_of(GetParam().port)}}, {},
                              work)
        .bytes;
  }
};
INSTANTIATE_TEST_SUITE_P(Formats, Stopping, testing::ValuesIn(all),
                         [](const auto& each) { return std::string(each.param.name); });

// A quarter of a megabyte takes no writer more than some milliseconds.
long least_for(std::size_t bytes) {
  return static_cast<long>(bytes / (std::size_t{256} << 10));
}

TEST_P(Stopping, AWriterAsksAllAlongAndEndsWhenItIsTold) {
  value_of(GetParam().port);
  Counted counted;
  const std::string bytes = written(counted);
  ASSERT_GT(bytes.size(), 400'000u);
  EXPECT_GE(counted.asked, least_for(bytes.size()));
  for (const long last : {1L, counted.asked / 2, counted.asked}) {
    Counted stopped(last);
    EXPECT_THROW(written(stopped), Cancelled) << last;
    EXPECT_EQ(stopped.asked, last);
  }
}

TEST_P(Stopping, AReaderAsksAllAlongAndEndsWhenItIsTold) {
  if (std::string(GetParam().name) == "Table") return;  // nothing reads it
  Alone alone;
  PlainFiles files;
  files.made[GetParam().path] = written(alone);
  const std::size_t size = files.made[GetParam().path].size();
  Counted counted;
  read_motion_file(GetParam().path, {}, files, counted);
  EXPECT_GE(counted.asked, least_for(size));
  for (const long last : {1L, counted.asked / 2, counted.asked}) {
    Counted stopped(last);
    EXPECT_THROW(read_motion_file(GetParam().path, {}, files, stopped), Cancelled) << last;
  }
}

}  // namespace
}  // namespace kinegraph
