// Port types and helpers for tests of the core, which know nothing about motion.
#pragma once
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "graph/registry.h"
#include "graph/value.h"

namespace kinegraph::toys {

// A list of numbers; with `extra` bytes of pretended size.
class Numbers : public Value {
 public:
  explicit Numbers(std::vector<double> numbers, std::size_t extra = 0)
      : all(std::move(numbers)), extra_(extra) {}
  std::string_view type() const override { return "Numbers"; }
  std::size_t bytes() const override { return all.size() * sizeof(double) + extra_; }
  void encode(Encoder& out) const override { out.f64s(all); }
  std::optional<NonFinite> non_finite() const override {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!std::isfinite(all[i])) return NonFinite{"number", "Hips", static_cast<std::int64_t>(i)};
    return std::nullopt;
  }
  static ValuePtr decode(Decoder& in) { return std::make_shared<const Numbers>(in.f64s()); }

  const std::vector<double> all;

 private:
  std::size_t extra_;
};

// What Numbers are turned into where only a Sum is taken.
class Sum : public Value {
 public:
  explicit Sum(double number) : total(number) {}
  std::string_view type() const override { return "Sum"; }
  std::size_t bytes() const override { return sizeof(double); }
  void encode(Encoder& out) const override { out.f64(total); }
  std::optional<NonFinite> non_finite() const override { return std::nullopt; }
  static ValuePtr decode(Decoder& in) { return std::make_shared<const Sum>(in.f64()); }
  static ValuePtr from_numbers(const Value& value) {
    double total = 0;
    for (double number : dynamic_cast<const Numbers&>(value).all) total += number;
    return std::make_shared<const Sum>(total);
  }

  const double total;
};

inline void add_toy_values(Registry& registry) {
  registry.add(ValueType{"Numbers", "a list of numbers", &Numbers::decode, "", nullptr});
  registry.add(ValueType{"Sum", "one number", &Sum::decode, "Numbers", &Sum::from_numbers});
}

// A folder of its own, gone at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kinegraph-XXXXXX").string();
    path = std::filesystem::canonical(::mkdtemp(pattern.data())).string();
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path + "/" + name; }

  std::string path;
};

inline void write(const std::string& path, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}
inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace kinegraph::toys
