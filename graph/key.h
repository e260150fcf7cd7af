// 128-bit keys of outputs, derived from declarations; no node author writes one.
#pragma once
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
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
std::optional<Key> key_from_text(
    std::string_view text);  // nothing where it isn't 32 lower-case hexadecimal digits

Key digest(std::string_view bytes);  // of a file's content

// The same digest, of bytes that come piece by piece.
class Digester {
 public:
  Digester();
  ~Digester();
  void add(std::string_view bytes);
  Key finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Feeds parts one after the other; each is framed by a tag and its length, so that no two sequences collide.
class KeyMaker {
 public:
  void add(std::string_view tag, std::string_view bytes);
  void add(std::string_view tag, const std::string& text) { add(tag, std::string_view(text)); }
  void add(std::string_view tag, const char* text) { add(tag, std::string_view(text)); }
  void add(std::string_view tag, const Key& key);
  void add_integer(std::string_view tag, std::uint64_t number);
  void add(std::string_view tag, const Json& value);  // canonical: equal meaning, equal key
  Key finish() const { return digester_.finish(); }

 private:
  void part(std::string_view tag, char kind, std::string_view bytes);
  Digester digester_;
};

}  // namespace kinegraph
