// Values that flow along links. A value is immutable once it is shared, holds no path, no file name and no clock, and
// encodes itself for the disk cache.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinegraph {

// Little-endian binary, the same bytes on every machine.
class Encoder {
 public:
  Encoder() = default;
  // Long lists are written in pieces, before each of which `ask` is called; it may throw. `expected` bytes are made
  // room for.
  Encoder(std::function<void()> ask, std::size_t expected);
  void u8(std::uint8_t value);
  void u32(std::uint32_t value);
  void u64(std::uint64_t value);
  void i64(std::int64_t value) { u64(static_cast<std::uint64_t>(value)); }
  void boolean(bool value) { u8(value ? 1 : 0); }
  void f64(double value);
  void text(std::string_view value);
  void f64s(std::span<const double> values);        // length, then values
  void f32s(std::span<const float> values);
  void u32s(std::span<const std::uint32_t> values);
  void bytes(std::span<const std::uint8_t> values);
  std::string take() { return std::move(out_); }

 private:
  template <class T>
  void put(std::span<const T> values);
  std::string out_;
  std::function<void()> ask_;
};

// Reads what Encoder wrote; throws Failure ("damaged-entry") when the bytes end early or a length is impossible.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes, std::function<void()> ask = {})
      : rest_(bytes), ask_(std::move(ask)) {}
  // For whoever makes something large of what was read; long lists do it themselves, as Encoder's.
  void ask() const {
    if (ask_) ask_();
  }
  std::uint8_t u8();
  std::uint32_t u32();
  std::uint64_t u64();
  std::int64_t i64() { return static_cast<std::int64_t>(u64()); }
  bool boolean() { return u8() != 0; }
  double f64();
  std::string text();
  std::vector<double> f64s();
  std::vector<float> f32s();
  std::vector<std::uint32_t> u32s();
  std::vector<std::uint8_t> bytes();
  bool at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view take(std::size_t count);
  template <class T>
  std::vector<T> numbers();
  std::string_view rest_;
  std::function<void()> ask_;
};

struct NonFinite {
  std::string what;  // "rotation", "u3", "style_distance"
  std::string joint;
  std::optional<std::int64_t> frame;
};

class Value {
 public:
  virtual ~Value() = default;
  virtual std::string_view type() const = 0;  // the port type's name: "Motion"
  virtual std::size_t bytes() const = 0;      // memory it holds, for the cache's limit
  virtual void encode(Encoder& out) const = 0;
  virtual std::optional<NonFinite> non_finite() const = 0;  // the first number that isn't finite
};
using ValuePtr = std::shared_ptr<const Value>;

// A port type. `convert_from`: how a value of another type is taken where this one is wanted (a Motion as Points).
struct ValueType {
  std::string name;
  std::string help;
  ValuePtr (*decode)(Decoder&) = nullptr;
  std::string convert_from;  // "" = from no other
  ValuePtr (*convert)(const Value&) = nullptr;
};

}  // namespace kinegraph
