// Encoding values: of long lists whoever waits is asked again and again whether to go on.
#include "graph/value.h"

#include <gtest/gtest.h>

#include "graph/diagnostic.h"

namespace kinegraph {
namespace {

constexpr std::size_t many = std::size_t{1} << 20;  // numbers; 8 MiB

TEST(Encoding, OfLongListsAsksInEachMegabyteAndLosesNothing) {
  std::vector<double> numbers(many + 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  const std::vector<float> floats(3 * many, 0.5f);
  int asked = 0;
  Encoder out([&] { ++asked; }, 0);
  out.f64s(numbers);
  EXPECT_EQ(asked, 9);
  out.f32s(floats);
  out.bytes({});
  EXPECT_EQ(asked, 9 + 12);
  const std::string bytes = out.take();
  Encoder plain;
  plain.f64s(numbers);
  plain.f32s(floats);
  plain.bytes({});
  EXPECT_EQ(bytes, plain.take());

  asked = 0;
  Decoder in(bytes, [&] { ++asked; });
  EXPECT_EQ(in.f64s(), numbers);
  EXPECT_EQ(in.f32s(), floats);
  EXPECT_TRUE(in.bytes().empty());
  EXPECT_EQ(asked, 9 + 12);
  EXPECT_TRUE(in.at_end());
}

TEST(Encoding, EndsWhereItIsToldTo) {
  const std::vector<double> numbers(many);
  int asked = 0;
  const auto stop = [&] {
    if (++asked == 3) throw Cancelled();
  };
  Encoder out(stop, 0);
  EXPECT_THROW(out.f64s(numbers), Cancelled);
}

}  // namespace
}  // namespace kinegraph
