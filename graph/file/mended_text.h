// A JSON text whose mistakes are read as they were meant, and places in it, which stay those of the text as
// it stands.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"

namespace kinegraph {

// A mistake that can only be meant in one way, and what to read in its place, so that the rest of the file
// can be judged as well.
struct Mend {
  std::size_t at = 0, length = 0;  // bytes of the text
  // A whole value or key; one comma, colon or blank between such; or brackets that close what is open.
  std::string text;
  bool unread = false;  // a value that isn't known: `text` only keeps its place
};

// A place in a text with mends, all that lie before it being counted as read. It only goes forward, so that
// one long line costs no more than many.
class JsonCursor {
 public:
  // `mends`: in the text's order, not overlapping; they live as long as the cursor, as the text does.
  explicit JsonCursor(std::string_view text, std::span<const Mend> mends = {}) : text_(text), mends_(mends) {}

  std::size_t offset() const { return offset_; }
  Place place() const { return place_; }  // columns in characters
  bool at_end() const { return offset_ >= text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[offset_]; }
  std::string_view rest() const { return text_.substr(offset_); }

  void advance();  // one byte
  void advance_to(std::size_t offset);
  void skip_space();
  bool skip(char separator);  // a comma or a colon; false: none is here

  // To where the mended text has its byte `offset`.
  void advance_to_mended(std::size_t offset);
  const Mend* mend() const;  // that begins here

 private:
  bool skip_mend(char text);
  void pass(const Mend& mend);

  std::string_view text_;
  std::span<const Mend> mends_;
  std::size_t offset_ = 0;
  std::size_t next_ = 0;    // the first mend that isn't passed
  std::size_t longer_ = 0;  // by how much passed mends make the mended text longer, modulo 2^64
  Place place_{1, 1};
};

// Keeps them in the text's order. False: something else is mended there already, so that the reading wouldn't
// get on.
bool put_in(std::vector<Mend>& mends, const Mend& mend);
// The text with its mends.
std::string mended(std::string_view text, std::span<const Mend> mends);

}  // namespace kinegraph
