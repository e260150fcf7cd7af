#include "graph/cache/entry.h"

#include <zstd.h>

#include <algorithm>
#include <memory>

namespace kinegraph {

namespace {

constexpr std::string_view magic = "kinecach";
constexpr std::uint32_t format_version = 1;
constexpr std::size_t header_size = magic.size() + 4 + 16;  // magic, format version, checksum
constexpr std::size_t piece = std::size_t{1} << 20;
constexpr int fast_level = 1;

void ask(const std::function<bool()>& give_up) {
  if (give_up && give_up()) throw Cancelled();
}

Failure damaged(const char* why) {
  return Failure(error("damaged-entry", why));
}

void encode(Encoder& out, const Key& key) {
  out.u64(key.high);
  out.u64(key.low);
}

Key decode_key(Decoder& in) {
  Key key;
  key.high = in.u64();
  key.low = in.u64();
  return key;
}

void encode(Encoder& out, const Diagnostic& note) {
  out.u8(static_cast<std::uint8_t>(note.severity));
  for (const auto* text :
       {&note.code, &note.message, &note.hint, &note.file, &note.port, &note.param, &note.joint})
    out.text(*text);
  out.i64(note.place.line);
  out.i64(note.place.column);
  out.boolean(note.frame.has_value());
  out.i64(note.frame.value_or(0));
}

Diagnostic decode_note(Decoder& in) {
  Diagnostic note;
  const auto severity = in.u8();
  if (severity > static_cast<std::uint8_t>(Severity::error)) throw damaged("unknown severity");
  note.severity = static_cast<Severity>(severity);
  for (auto* text : {&note.code, &note.message, &note.hint, &note.file, &note.port, &note.param, &note.joint})
    *text = in.text();
  note.place.line = static_cast<int>(in.i64());
  note.place.column = static_cast<int>(in.i64());
  const bool at_frame = in.boolean();
  const auto frame = in.i64();
  if (at_frame) note.frame = frame;
  return note;
}

// Memory is made room for and only touched piece by piece: filling a hundred megabytes at once takes as long
// as whoever asks to stop may have to wait.
void append_compressed(std::string& out, std::string_view raw, const std::function<bool()>& give_up) {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, fast_level);
  ZSTD_CCtx_setPledgedSrcSize(context.get(), raw.size());
  const std::size_t room = ZSTD_compressBound(piece);
  out.reserve(out.size() + ZSTD_compressBound(raw.size()) + room);
  std::size_t begin = 0;
  do {
    const std::size_t end = std::min(raw.size(), begin + piece);
    ZSTD_inBuffer from{raw.data() + begin, end - begin, 0};
    const bool last = end == raw.size();
    std::size_t rest = 0;
    do {
      ask(give_up);
      const std::size_t written = out.size();
      out.resize(written + room);
      ZSTD_outBuffer to{out.data() + written, room, 0};
      rest = ZSTD_compressStream2(context.get(), &to, &from, last ? ZSTD_e_end : ZSTD_e_continue);
      if (ZSTD_isError(rest)) throw damaged(ZSTD_getErrorName(rest));
      out.resize(written + to.pos);
    } while (last ? rest != 0 : from.pos < from.size);
    begin = end;
  } while (begin < raw.size());
}

std::string decompressed(std::string_view packed, std::uint64_t raw_size,
                         const std::function<bool()>& give_up) {
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != raw_size) throw damaged("wrong length");
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  std::string raw;
  raw.reserve(raw_size);
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  std::size_t done = 0;
  while (true) {
    ask(give_up);
    const std::size_t end = std::min<std::size_t>(raw_size, done + piece);
    raw.resize(end);
    ZSTD_outBuffer to{raw.data() + done, end - done, 0};
    const std::size_t rest = ZSTD_decompressStream(context.get(), &to, &from);
    if (ZSTD_isError(rest)) throw damaged(ZSTD_getErrorName(rest));
    done += to.pos;
    if (rest == 0) break;
    if (to.pos == 0 && (from.pos == from.size || done == raw_size)) throw damaged("ends early");
  }
  if (done != raw_size || from.pos != from.size) throw damaged("wrong length");
  raw.resize(done);
  return raw;
}

Key checksum(std::string_view body, const std::function<bool()>& give_up) {
  Digester digester;
  for (std::size_t begin = 0; begin < body.size(); begin += piece) {
    ask(give_up);
    digester.add(body.substr(begin, piece));
  }
  return digester.finish();
}

std::string header(const Key& sum) {
  Encoder out;
  out.u32(format_version);
  encode(out, sum);
  return std::string(magic) + out.take();
}

// What follows a header that agrees with it.
std::string_view checked_body(std::string_view bytes, const std::function<bool()>& give_up) {
  if (bytes.size() < header_size || !bytes.starts_with(magic)) throw damaged("not a cache entry");
  const auto body = bytes.substr(header_size);
  if (bytes.substr(0, header_size) != header(checksum(body, give_up))) throw damaged("checksum differs");
  return body;
}

}  // namespace

std::string encode_entry(const Key& key, const Cached& cached, const std::function<bool()>& give_up) {
  const auto asking = [&] { ask(give_up); };
  Encoder body;
  encode(body, key);
  body.text(cached.value ? cached.value->type() : std::string_view{});
  body.u64(cached.notes.size());
  for (const auto& note : cached.notes) encode(body, note);
  std::string raw;
  if (cached.value) {
    Encoder out(asking, cached.value->bytes());
    cached.value->encode(out);
    raw = out.take();
  }
  body.u64(raw.size());
  std::string whole = std::string(header_size, '\0') + body.take();
  append_compressed(whole, raw, give_up);
  whole.replace(0, header_size, header(checksum(std::string_view(whole).substr(header_size), give_up)));
  return whole;
}

Cached decode_entry(const Key& key, std::string_view bytes, const Registry& registry,
                    const std::function<bool()>& give_up) {
  const auto body = checked_body(bytes, give_up);
  Decoder in(body);
  if (decode_key(in) != key) throw damaged("holds another key");
  const std::string type = in.text();
  Cached cached;
  const auto notes = in.u64();
  if (notes > body.size()) throw damaged("wrong length");
  for (std::uint64_t i = 0; i < notes; ++i) cached.notes.push_back(decode_note(in));
  const auto raw_size = in.u64();
  if (type.empty()) return cached;
  const auto* value_type = registry.find_value(type);
  if (!value_type || !value_type->decode) throw damaged("of an unknown type");
  const std::string raw = decompressed(in.rest(), raw_size, give_up);
  Decoder value(raw, [&] { ask(give_up); });
  cached.value = value_type->decode(value);
  if (!cached.value || cached.value->type() != type || !value.at_end()) throw damaged("does not decode");
  return cached;
}

bool is_whole_entry(const Key& key, std::string_view bytes) {
  try {
    Decoder in(checked_body(bytes, {}));
    return decode_key(in) == key;
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace kinegraph
