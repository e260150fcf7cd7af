#include "nodes/files/decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <random>

namespace kinegraph {
namespace {

// What std::from_chars makes of the start of `text`: the same bits and the same end are wanted.
void expect_as_from_chars(const std::string& text) {
  for (const std::string& padded : {text, text + " 777777777777777777777777777777777777777777777777"}) {
    double expected = 0, found = 0;
    auto [stop, problem] = std::from_chars(padded.data(), padded.data() + padded.size(), expected);
    const char* end = parse_decimal(padded.data(), padded.data() + padded.size(), found);
    if (problem != std::errc{}) continue;
    ASSERT_EQ(end, stop) << padded;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(found), std::bit_cast<std::uint64_t>(expected)) << padded;
  }
}

TEST(Decimal, ReadsTheSameBitsAsFromChars) {
  for (const char* text : {"0",
                           "-0",
                           "-0.0",
                           "1",
                           ".5",
                           "5.",
                           "-.0083333",
                           "8.88178e-016",
                           "1E5",
                           "1e+22",
                           "1e-22",
                           "9007199254740993",
                           "9007199254740992.5",
                           "0.1234567890123456789",
                           "12345678",
                           "1234567.12345678",
                           "1234567.1234567812345678",
                           "123456789.5",
                           "1e23",
                           "4.9e-324",
                           "1.7976931348623157e308",
                           "00012.500"})
    expect_as_from_chars(text);
  std::mt19937_64 random(7);
  for (int i = 0; i < 40000; ++i) {
    const auto bits = random();
    char text[64];
    int length = 0;
    switch (i % 4) {
      case 0:
        length = std::snprintf(text, 64, "%.*f", int(bits % 12), double(std::int64_t(bits) >> 34) / 1e6);
        break;
      case 1:
        length = std::snprintf(text, 64, "%.*e", int(bits % 20), std::bit_cast<double>(bits >> 2));
        break;
      case 2:
        length = std::snprintf(text, 64, "-%u.%llu", unsigned(bits % 10000),
                               (unsigned long long)(random() >> (bits % 60)));
        break;
      default:
        length = std::snprintf(text, 64, "%llue%d", (unsigned long long)(bits >> (bits % 60)),
                               int(random() % 60) - 30);
    }
    expect_as_from_chars(std::string(text, static_cast<std::size_t>(length)));
  }
}

TEST(Decimal, TakesAPlusAndStopsAtWhatIsNoNumber) {
  const std::string text = "+2.5,7";
  double value = 0;
  EXPECT_EQ(parse_decimal(text.data(), text.data() + text.size(), value), text.data() + 4);
  EXPECT_EQ(value, 2.5);
}

TEST(Decimal, RefusesWhatIsNoFiniteNumber) {
  for (const std::string text : {"nan", "-inf", "", "-", "+-1", ".", "e5", "1e999", "abc"}) {
    double value = 0;
    EXPECT_EQ(parse_decimal(text.data(), text.data() + text.size(), value), nullptr) << text;
  }
}

TEST(Decimal, TakesTooSmallANumberAsZero) {
  double value = 1;
  const std::string text = "1e-400";
  EXPECT_NE(parse_decimal(text.data(), text.data() + text.size(), value), nullptr);
  EXPECT_EQ(value, 0);
}

std::string fixed(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

TEST(Decimal, WritesFixedNumbersRoundedExactly) {
  EXPECT_EQ(fixed(1.005, 2), "1.00");          // the double lies just below the tie
  EXPECT_EQ(fixed(1.0000005, 6), "1.000001");  // and this just above
  EXPECT_EQ(fixed(0.5, 0), "0");
  EXPECT_EQ(fixed(1.5, 0), "2");
  EXPECT_EQ(fixed(-0.0000001, 6), "0.000000");
  EXPECT_EQ(fixed(-1.25, 3), "-1.250");
  EXPECT_EQ(fixed(1e300, 2).size(), 304u);
  std::mt19937_64 random(3);
  for (int i = 0; i < 40000; ++i) {
    double value = double(std::int64_t(random()) >> 20) / double(1 + (random() >> 40));
    if (i % 3 == 0) value = std::round(value * 1e7) / 1e7;
    const int decimals = i % 12;
    char expected[400];
    auto end = std::to_chars(expected, expected + 400, value, std::chars_format::fixed, decimals).ptr;
    std::string text(expected, end);
    if (text.find_first_of("123456789") == std::string::npos && text[0] == '-') text.erase(0, 1);
    ASSERT_EQ(fixed(value, decimals), text);
  }
}

TEST(Decimal, WritesTheShortestThatReadsBack) {
  std::string text;
  append_shortest(text, 0.1);
  append_shortest(text += ' ', -0.0);
  append_shortest(text += ' ', 1e22);
  EXPECT_EQ(text, "0.1 0 1e+22");
}

}  // namespace
}  // namespace kinegraph
