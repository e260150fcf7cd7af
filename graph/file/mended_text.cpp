#include "graph/file/mended_text.h"

#include <algorithm>

namespace kinegraph {

void JsonCursor::advance() {
  const char c = text_[offset_++];
  if (c == '\n')
    place_ = {place_.line + 1, 1};
  else if (!at_end() && (static_cast<unsigned char>(text_[offset_]) & 0xC0) == 0x80)
    return;  // the next byte continues this character
  else
    ++place_.column;
}

void JsonCursor::advance_to(std::size_t offset) {
  while (offset_ < offset && !at_end()) advance();
}

const Mend* JsonCursor::mend() const {
  return next_ < mends_.size() && mends_[next_].at == offset_ ? &mends_[next_] : nullptr;
}

void JsonCursor::pass(const Mend& mend) {
  advance_to(mend.at + mend.length);
  longer_ += mend.text.size() - mend.length;
  ++next_;
}

void JsonCursor::advance_to_mended(std::size_t offset) {
  while (next_ < mends_.size() && mends_[next_].at + longer_ + mends_[next_].text.size() <= offset)
    pass(mends_[next_]);
  // Within what a mend puts in there is no place but its own.
  const bool inside = next_ < mends_.size() && mends_[next_].at + longer_ < offset;
  advance_to(inside ? mends_[next_].at : offset - longer_);
}

bool JsonCursor::skip_mend(char text) {
  const Mend* here = mend();
  if (!here || here->text.size() != 1 || here->text.front() != text || here->unread) return false;
  pass(*here);
  return true;
}

void JsonCursor::skip_space() {
  const auto at_space = [&] {
    return !mend() && (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r');
  };
  for (;;)
    if (at_space())
      advance();
    else if (!skip_mend(' '))
      return;
}

bool JsonCursor::skip(char separator) {
  if (skip_mend(separator)) return true;
  if (mend() || peek() != separator) return false;
  advance();
  return true;
}

bool put_in(std::vector<Mend>& mends, const Mend& mend) {
  const auto next = std::find_if(mends.begin(), mends.end(), [&](const Mend& other) {
    return other.at > mend.at || (other.at == mend.at && other.length > 0 && mend.length == 0);
  });
  if (next != mends.end() && mend.at + mend.length > next->at) return false;
  if (next != mends.begin()) {
    const Mend& before = *std::prev(next);
    if (before.at + before.length > mend.at) return false;
    if (before.at == mend.at && mend.length == 0) return false;
  }
  mends.insert(next, mend);
  return true;
}

std::string mended(std::string_view text, std::span<const Mend> mends) {
  std::string whole;
  whole.reserve(text.size() + mends.size());
  std::size_t from = 0;
  for (const Mend& mend : mends) {
    whole.append(text, from, mend.at - from);
    whole += mend.text;
    from = mend.at + mend.length;
  }
  return whole.append(text, from);
}

}  // namespace kinegraph
