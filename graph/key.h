// 128-bit keys of outputs, derived from declarations; no node author writes one.
#pragma once
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "graph/json.h"

namespace kinegraph {

struct Key {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  auto operator<=>(const Key&) const = default;
};
std::string to_text(const Key& key);  // 32 hexadecimal digits

Key digest(std::string_view bytes);  // of a file's content

// Feeds parts one after the other; each is framed by a tag and its length, so that no two sequences collide.
class KeyMaker {
 public:
  KeyMaker();
  ~KeyMaker();
  KeyMaker(const KeyMaker&) = delete;
  KeyMaker& operator=(const KeyMaker&) = delete;
  void add(std::string_view tag, std::string_view bytes);
  void add(std::string_view tag, const Key& key);
  void add(std::string_view tag, const Json& value);  // canonical: equal meaning, equal key
  Key finish() const;

 private:
  void* state_;
};

}  // namespace kinegraph
