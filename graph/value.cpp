#include "graph/value.h"

#include <bit>
#include <cstring>

#include "graph/diagnostic.h"

namespace kinegraph {

static_assert(std::endian::native == std::endian::little, "big-endian machines need byte swaps here");

namespace {

template <class T>
void put(std::string& out, const T* values, std::size_t count) {
  if (count) out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class T>
std::vector<T> numbers(std::string_view bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace

void Encoder::u8(std::uint8_t value) {
  put(out_, &value, 1);
}
void Encoder::u32(std::uint32_t value) {
  put(out_, &value, 1);
}
void Encoder::u64(std::uint64_t value) {
  put(out_, &value, 1);
}
void Encoder::f64(double value) {
  put(out_, &value, 1);
}
void Encoder::text(std::string_view value) {
  u64(value.size());
  out_.append(value);
}
void Encoder::f64s(std::span<const double> values) {
  u64(values.size());
  put(out_, values.data(), values.size());
}
void Encoder::f32s(std::span<const float> values) {
  u64(values.size());
  put(out_, values.data(), values.size());
}
void Encoder::u32s(std::span<const std::uint32_t> values) {
  u64(values.size());
  put(out_, values.data(), values.size());
}
void Encoder::bytes(std::span<const std::uint8_t> values) {
  u64(values.size());
  put(out_, values.data(), values.size());
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

}  // namespace

std::uint8_t Decoder::u8() {
  return static_cast<std::uint8_t>(take(1)[0]);
}
std::uint32_t Decoder::u32() {
  return numbers<std::uint32_t>(take(4))[0];
}
std::uint64_t Decoder::u64() {
  return numbers<std::uint64_t>(take(8))[0];
}
double Decoder::f64() {
  return numbers<double>(take(8))[0];
}
std::string Decoder::text() {
  auto count = u64();
  return std::string(take(length_in_bytes(count, 1, rest_.size())));
}
std::vector<double> Decoder::f64s() {
  auto count = u64();
  return numbers<double>(take(length_in_bytes(count, sizeof(double), rest_.size())));
}
std::vector<float> Decoder::f32s() {
  auto count = u64();
  return numbers<float>(take(length_in_bytes(count, sizeof(float), rest_.size())));
}
std::vector<std::uint32_t> Decoder::u32s() {
  auto count = u64();
  return numbers<std::uint32_t>(take(length_in_bytes(count, sizeof(std::uint32_t), rest_.size())));
}
std::vector<std::uint8_t> Decoder::bytes() {
  auto count = u64();
  return numbers<std::uint8_t>(take(length_in_bytes(count, 1, rest_.size())));
}

}  // namespace kinegraph
