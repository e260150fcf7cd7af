#include "graph/key.h"

#include <xxhash.h>

#include <array>
#include <bit>
#include <new>

namespace kinegraph {

namespace {

static_assert(std::endian::native == std::endian::little, "big-endian machines need byte swaps here");

std::array<char, 8> eight_bytes(std::uint64_t number) {
  return std::bit_cast<std::array<char, 8>>(number);
}

void append(std::string& out, std::uint64_t number) {
  auto bytes = eight_bytes(number);
  out.append(bytes.data(), bytes.size());
}

void append(std::string& out, std::string_view text) {
  append(out, static_cast<std::uint64_t>(text.size()));
  out += text;
}

// Kind, then content; lengths before everything of varying length.
void append(std::string& out, const Json& value) {
  switch (value.kind()) {
    case Json::Kind::null:
      out += 'n';
      return;
    case Json::Kind::boolean:
      out += value.boolean() ? 't' : 'f';
      return;
    case Json::Kind::number:
      out += 'd';
      append(out, std::bit_cast<std::uint64_t>(value.number() == 0 ? 0.0 : value.number()));
      return;
    case Json::Kind::string:
      out += 's';
      append(out, std::string_view(value.string()));
      return;
    case Json::Kind::array:
      out += 'a';
      append(out, static_cast<std::uint64_t>(value.array().size()));
      for (const auto& element : value.array()) append(out, element);
      return;
    case Json::Kind::object:
      out += 'o';
      append(out, static_cast<std::uint64_t>(value.object().size()));
      for (const auto& [name, member] : value.object()) {
        append(out, std::string_view(name));
        append(out, member);
      }
      return;
  }
}

Key as_key(XXH128_hash_t hash) {
  return Key{hash.high64, hash.low64};
}

}  // namespace

std::string to_text(const Key& key) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(32, '0');
  for (int i = 0; i < 16; ++i) {
    text[static_cast<std::size_t>(15 - i)] = digits[key.high >> (4 * i) & 15];
    text[static_cast<std::size_t>(31 - i)] = digits[key.low >> (4 * i) & 15];
  }
  return text;
}

std::optional<Key> key_from_text(std::string_view text) {
  if (text.size() != 32) return std::nullopt;
  Key key;
  for (std::size_t i = 0; i < 32; ++i) {
    const char c = text[i];
    const bool number = c >= '0' && c <= '9';
    if (!number && (c < 'a' || c > 'f')) return std::nullopt;
    auto& half = i < 16 ? key.high : key.low;
    half = half << 4 | static_cast<std::uint64_t>(number ? c - '0' : c - 'a' + 10);
  }
  return key;
}

Key digest(std::string_view bytes) {
  return as_key(XXH3_128bits(bytes.data(), bytes.size()));
}

struct Digester::State {
  XXH3_state_t* hash = XXH3_createState();
  State() {
    if (!hash) throw std::bad_alloc();
    XXH3_128bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Digester::Digester() : state_(std::make_unique<State>()) {}
Digester::~Digester() = default;
void Digester::add(std::string_view bytes) {
  XXH3_128bits_update(state_->hash, bytes.data(), bytes.size());
}
Key Digester::finish() const {
  return as_key(XXH3_128bits_digest(state_->hash));
}

void KeyMaker::part(std::string_view tag, char kind, std::string_view bytes) {
  std::string frame;
  append(frame, tag);
  frame += kind;
  append(frame, static_cast<std::uint64_t>(bytes.size()));
  digester_.add(frame);
  digester_.add(bytes);
}

void KeyMaker::add(std::string_view tag, std::string_view bytes) {
  part(tag, 'b', bytes);
}

void KeyMaker::add(std::string_view tag, const Key& key) {
  std::string bytes;
  append(bytes, key.high);
  append(bytes, key.low);
  part(tag, 'k', bytes);
}

void KeyMaker::add_integer(std::string_view tag, std::uint64_t number) {
  auto bytes = eight_bytes(number);
  part(tag, 'u', {bytes.data(), bytes.size()});
}

void KeyMaker::add(std::string_view tag, const Json& value) {
  std::string bytes;
  append(bytes, value);
  part(tag, 'j', bytes);
}

}  // namespace kinegraph
