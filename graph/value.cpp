#include "graph/value.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "graph/diagnostic.h"

namespace kinegraph {

static_assert(std::endian::native == std::endian::little, "big-endian machines need byte swaps here");

namespace {

constexpr std::size_t piece = std::size_t{1} << 20;          // bytes
constexpr std::size_t most_reserved = std::size_t{1} << 30;  // a value may count what others share with it

template <class T>
void put_number(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Encoder::Encoder(std::function<void()> ask, std::size_t expected) : ask_(std::move(ask)) {
  // With lengths and names it is a little more than the value; growing at the very end would copy it all.
  out_.reserve(std::min(expected + expected / 64 + 65536, most_reserved));
}

template <class T>
void Encoder::put(std::span<const T> values) {
  u64(values.size());
  for (std::size_t begin = 0; begin < values.size(); begin += piece / sizeof(T)) {
    if (ask_) ask_();
    const auto part = values.subspan(begin, std::min(piece / sizeof(T), values.size() - begin));
    out_.append(reinterpret_cast<const char*>(part.data()), part.size_bytes());
  }
}

void Encoder::u8(std::uint8_t value) {
  put_number(out_, value);
}
void Encoder::u32(std::uint32_t value) {
  put_number(out_, value);
}
void Encoder::u64(std::uint64_t value) {
  put_number(out_, value);
}
void Encoder::f64(double value) {
  put_number(out_, value);
}
void Encoder::text(std::string_view value) {
  u64(value.size());
  out_.append(value);
}
void Encoder::f64s(std::span<const double> values) {
  put(values);
}
void Encoder::f32s(std::span<const float> values) {
  put(values);
}
void Encoder::u32s(std::span<const std::uint32_t> values) {
  put(values);
}
void Encoder::bytes(std::span<const std::uint8_t> values) {
  put(values);
}

std::string_view Decoder::take(std::size_t count) {
  if (count > rest_.size()) throw Failure(error("damaged-entry", "an encoded value ends early"));
  auto taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

namespace {

// A length of `size`-byte elements that can't be in what is left would overflow or ask for absurd memory.
std::size_t length_in_bytes(std::uint64_t count, std::size_t size, std::size_t left) {
  if (count > left / size) throw Failure(error("damaged-entry", "an encoded value ends early"));
  return static_cast<std::size_t>(count) * size;
}

template <class T>
T number_in(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

}  // namespace

template <class T>
std::vector<T> Decoder::numbers() {
  const auto count = u64();
  const std::string_view bytes = take(length_in_bytes(count, sizeof(T), rest_.size()));
  std::vector<T> values;
  values.reserve(bytes.size() / sizeof(T));
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
    ask();
    const std::string_view part = bytes.substr(begin, piece);
    const std::size_t before = values.size();
    values.resize(before + part.size() / sizeof(T));
    std::memcpy(values.data() + before, part.data(), part.size());
  }
  return values;
}

std::uint8_t Decoder::u8() {
  return static_cast<std::uint8_t>(take(1)[0]);
}
std::uint32_t Decoder::u32() {
  return number_in<std::uint32_t>(take(4));
}
std::uint64_t Decoder::u64() {
  return number_in<std::uint64_t>(take(8));
}
double Decoder::f64() {
  return number_in<double>(take(8));
}
std::string Decoder::text() {
  auto count = u64();
  return std::string(take(length_in_bytes(count, 1, rest_.size())));
}
std::vector<double> Decoder::f64s() {
  return numbers<double>();
}
std::vector<float> Decoder::f32s() {
  return numbers<float>();
}
std::vector<std::uint32_t> Decoder::u32s() {
  return numbers<std::uint32_t>();
}
std::vector<std::uint8_t> Decoder::bytes() {
  return numbers<std::uint8_t>();
}

}  // namespace kinegraph
