#include "nodes/files/number_row.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <bit>
#include <random>
#include <string>

#include "nodes/files/decimal.h"

namespace kinegraph {
namespace {

// What a line of a file is followed by.
const std::string more = "\n" + std::string(200, '1');

const char* read_row(const std::string& text, std::size_t count, std::vector<double>& out) {
  out.assign(count, -7);
  return NumberRow(count).read(text.data(), text.data() + text.size(), out.data());
}

bool reads(const std::string& line, std::size_t count) {
  std::vector<double> out;
  return read_row(line + more, count, out) != nullptr;
}

TEST(NumberRow, reads_each_number_as_alone_wherever_it_falls_among_the_blocks) {
  std::mt19937 random(7);
  const auto any = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  const auto digits = [&](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += static_cast<char>('0' + any(10));
    return text;
  };
  for (int round = 0; round < 3000; ++round) {
    const int count = 1 + any(40);
    std::string line;
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i) {
      std::string word = any(3) == 0 ? "-" : any(30) == 0 ? "+" : "";
      const int form = any(8);
      if (form == 0)
        word += digits(1 + any(4));
      else if (form == 1)
        word += "." + digits(1 + any(9));
      else if (form == 2)
        word += digits(1 + any(3)) + ".";
      else if (form == 3)
        word += digits(1) + "." + digits(any(12)) + (any(2) ? "e" : "E") +
                (any(2)   ? "-"
                 : any(2) ? "+"
                          : "") +
                digits(1 + any(2));
      else if (form == 4)
        word += digits(1 + any(12)) + "." + digits(any(20));
      else
        word += digits(1 + any(3)) + "." + digits(any(8));
      words.push_back(word);
      line += word + (any(5) == 0 ? " \t " : any(2) ? " " : "\t");
    }
    if (any(2)) line.pop_back();
    const std::string text = line + (any(2) ? "\r" : "") + more;
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      std::vector<double> out;
      const char* stop = read_row(text, words.size(), out);
      ASSERT_NE(stop, nullptr) << line;
      EXPECT_EQ(line.find_last_not_of(" \t") + 1, static_cast<std::size_t>(stop - text.data()));
      for (std::size_t i = 0; i < words.size(); ++i) {
        double alone = 0;
        ASSERT_TRUE(whole_number_text(words[i], alone)) << words[i];
        EXPECT_EQ(std::bit_cast<std::uint64_t>(out[i]), std::bit_cast<std::uint64_t>(alone)) << words[i];
      }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
}

TEST(NumberRow, leaves_to_others_what_is_not_its_count_of_numbers) {
  EXPECT_TRUE(reads("1 2.5 -3", 3));
  EXPECT_FALSE(reads("1 2.5 -3", 2));
  EXPECT_FALSE(reads("1 2.5 -3", 4));
  for (const char* word :
       {"nan", "-inf",    "1.#QNAN", "-",     ".",     "-.",   "e5",   "1e",   "1e-", "1,5", "1.2.3",
        "1-2", "1.5-2.5", "--1",     "1e5e3", "1e5.3", "0x10", "1.5f", "\x1A", "1.#", "+-1"}) {
    EXPECT_FALSE(reads(std::string("1 ") + word + " 3", 3)) << word;
    EXPECT_FALSE(reads(std::string(61, ' ').replace(0, 1, "1") + " " + word + " 3", 3)) << word;
  }
}

TEST(NumberRow, reads_nothing_near_the_end_of_the_text) {
  std::vector<double> out;
  EXPECT_EQ(read_row("1 2 3\n", 3, out), nullptr);
  EXPECT_EQ(read_row("1 2 3", 3, out), nullptr);
  EXPECT_EQ(read_row(std::string(90, '1'), 1, out), nullptr);
}

}  // namespace
}  // namespace kinegraph
