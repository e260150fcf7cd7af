#include "graph/file/bracket_rescue.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace kinegraph {

namespace {

constexpr std::size_t most_mends = 200;

char closer_of(char opener) {
  return opener == '{' ? '}' : ']';
}

class Rescuer {
 public:
  explicit Rescuer(std::string_view text) : text_(text), loose_(loose_tokens(text)), tokens_(loose_.tokens) {}

  Rescue rescue() {
    laid_out_ = is_laid_out();
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      const LooseToken& token = tokens_[at_];
      if (open_.empty() && at_ > 0) {
        if (!after_the_end(token)) break;
        if (token.closes()) continue;
      }
      if (token.first && laid_out_) by_indentation(token);
      by_what_follows(token);
      if (token.kind == 's' && kind(at_ + 1) == ':') by_shape(token);
      if (token.opens()) {
        open_.push_back({token.kind, at_, token.indent, name_before(at_),
                         kind(at_ + 1) == '\0' || tokens_[at_ + 1].first});
        continue;
      }
      if (token.closes()) close(token);
      if (token.kind == ':' && !open_.empty()) open_.back().colon = at_;
      if (!open_.empty() && token.first && !token.closes() && open_.back().inner == npos)
        open_.back().inner = token.indent;
    }
    finish();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t npos = std::string_view::npos;

  struct Open {
    char kind = 0;
    std::size_t token = 0;     // of one that is missing: the last before it
    std::size_t indent = 0;    // of its line
    std::string_view name;     // of the member it is, or ""
    bool ends_line = false;    // it stands last in its line
    std::size_t inner = npos;  // indentation of the first line inside
    std::size_t colon = npos;  // token, the last one directly inside
  };

  char kind(std::size_t i) const { return i < tokens_.size() ? tokens_[i].kind : '\0'; }
  std::string_view text_of(std::size_t i) const {
    return i < tokens_.size() ? text_.substr(tokens_[i].at, tokens_[i].end - tokens_[i].at) : "";
  }
  std::string_view name_in(std::size_t i) const {
    std::string_view name = text_of(i);
    while (!name.empty() && (name.front() == '"' || name.front() == '\'')) name.remove_prefix(1);
    while (!name.empty() && (name.back() == '"' || name.back() == '\'')) name.remove_suffix(1);
    return name;
  }
  std::string_view name_before(std::size_t i) const {
    return i >= 2 && kind(i - 1) == ':' ? name_in(i - 2) : "";
  }
  const LooseToken& opener(const Open& open) const { return tokens_[open.token]; }
  int line_of(std::size_t at) const {
    return 1 +
           static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

  // Whether most brackets that stand last in their line are closed by the first line that is indented no
  // deeper.
  bool is_laid_out() const {
    std::vector<std::pair<std::size_t, std::size_t>> waiting;  // indentations of lines that end in a bracket
    int agree = 0, differ = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const LooseToken& token = tokens_[i];
      if (token.first) {
        bool closes = token.closes();
        while (!waiting.empty() && waiting.back().first >= token.indent) {
          (closes && waiting.back().first == token.indent ? agree : differ)++;
          waiting.pop_back();
        }
      }
      if (token.opens() && (kind(i + 1) == '\0' || tokens_[i + 1].first))
        waiting.push_back({token.indent, i});
    }
    return agree > 0 && agree >= differ;
  }

  void by_indentation(const LooseToken& token) {
    if (token.closes()) {
      if (open_.empty() || (open_.back().ends_line && open_.back().indent == token.indent)) return;
      for (std::size_t i = open_.size(); i-- > 0;)
        if (open_[i].ends_line && open_[i].indent == token.indent) return close_to(i + 1, token);
      if (open_.back().ends_line && token.indent > open_.back().indent) drop_closer(token);
      return;
    }
    std::size_t outer = open_.size();
    while (outer > 0 && open_[outer - 1].indent >= token.indent &&
           opener(open_[outer - 1]).line != token.line)
      --outer;
    if (outer == 0) return;  // the text itself is less indented than it began
    if (outer < open_.size()) return close_to(outer, token);
    if (last_closed_ && open_.back().inner != npos && token.indent > open_.back().inner &&
        last_closed_->inner == token.indent && is_after_last_closer())
      reopen();
  }

  // Before something that only an opening bracket can stand before.
  void by_what_follows(const LooseToken& token) {
    const bool is_key = token.kind == 's' && kind(at_ + 1) == ':';
    const char before = at_ > 0 ? kind(at_ - 1) : '\0';
    if (is_key && at_ == 0) return open_missing('{', token.at, at_, token);
    if (open_.empty()) return;
    if (is_key && before == ':') {
      const bool inside =
          token.first ? token.indent > tokens_[at_ - 1].indent : closers_left() > opened_in(token.line);
      if (inside) open_missing('{', token.at, at_ - 1, token);
    } else if (is_key && open_.back().kind == '[') {
      const bool no_element = before == ',' && !token.first && opener(open_.back()).line == token.line;
      if (no_element)
        close_to(open_.size() - 1, token);
      else
        open_missing('{', token.at, at_, token);
    } else if (!is_key && before == ',' && open_.back().kind == '{' && open_.back().colon != npos &&
               token.kind != ',' && !token.closes() && next_closer() == ']') {
      open_missing('[', tokens_[open_.back().colon].end, open_.back().colon, token);
    }
  }
  // How many more brackets close than open from here to the end of the line.
  std::ptrdiff_t closers_left() const {
    std::ptrdiff_t count = 0;
    for (std::size_t i = at_; i < tokens_.size() && tokens_[i].line == tokens_[at_].line; ++i)
      count += tokens_[i].closes() ? 1 : tokens_[i].opens() ? -1 : 0;
    return count;
  }
  std::ptrdiff_t opened_in(std::size_t line) const {
    return std::count_if(open_.begin(), open_.end(),
                         [&](const Open& one) { return opener(one).line == line; });
  }
  // What closes the list or object that the token lies in, if nothing is missing until there.
  char next_closer() const {
    int depth = 0;
    for (std::size_t i = at_; i < tokens_.size(); ++i) {
      if (tokens_[i].opens()) ++depth;
      if (tokens_[i].closes() && depth-- == 0) return tokens_[i].kind;
    }
    return '\0';
  }
  // `token_before`: which then counts as the bracket.
  void open_missing(char bracket, std::size_t at, std::size_t token_before, const LooseToken& seen_at) {
    mend({at, 0, std::string(1, bracket)});
    tell(seen_at.at, error("syntax", fmt::format("there is no {} before this", bracket))
                         .hinting(fmt::format("a {} is missing", bracket)));
    const std::size_t indent = token_before > 0 ? tokens_[token_before].indent : 0;
    open_.push_back(
        {bracket, token_before, indent, token_before > 0 ? name_in(token_before - 1) : "", seen_at.first});
    if (seen_at.first) open_.back().inner = seen_at.indent;
  }

  // A node, or a part of the graph, that can't stand here.
  void by_shape(const LooseToken& token) {
    const std::size_t value = at_ + 2;
    if (kind(value) != '{' || (laid_out_ && token.first)) return;
    const std::string_view name = name_in(at_), first = kind(value + 2) == ':' ? name_in(value + 1) : "";
    const bool in_nodes = open_.size() > 1 && open_[1].name == "nodes";
    const bool in_part = open_.size() == 4 && (open_[3].name == "params" || open_[3].name == "inputs");
    const auto is_one_of = [](std::string_view one, std::initializer_list<std::string_view> all) {
      return std::find(all.begin(), all.end(), one) != all.end();
    };
    const bool top = (name == "publish" && is_one_of(first, {"params", "inputs", "outputs"})) ||
                     (name == "ui" && is_one_of(first, {"nodes", "frames", "notes"}));
    if (first == "type" && in_nodes && (open_.size() == 3 || in_part))
      close_to(2, token);
    else if (is_one_of(name, {"params", "inputs"}) && in_nodes && in_part)
      close_to(3, token);
    else if (top && in_nodes)
      close_to(1, token);
    else if (first == "type" && open_.size() == 1 && last_closed_ && last_closed_->name == "nodes" &&
             is_after_last_closer())
      reopen();
  }

  bool is_after_last_closer() const {
    return at_ >= 1 && (last_closer_ + 1 == at_ || (last_closer_ + 2 == at_ && kind(at_ - 1) == ','));
  }

  // Closes all but the `count` outermost before `token`.
  void close_to(std::size_t count, const LooseToken& token) {
    std::string closers;
    const Open innermost = open_.back();
    while (open_.size() > count) {
      closers += closer_of(open_.back().kind);
      open_.pop_back();
    }
    const std::size_t before = at_ - 1;  // a token is there: the bracket itself at least
    const bool comma = kind(before) == ',';
    if (kind(before) == ':') closers.insert(0, "null");
    if (!comma && !token.closes() && token.kind != ',') closers += ',';
    mend({comma ? tokens_[before].at : tokens_[before].end, 0, closers});
    tell(token.at, error("syntax", fmt::format("the {} in line {} isn't closed before this", innermost.kind,
                                               line_of(opener(innermost).at)))
                       .hinting(fmt::format("a {} is missing above it", closer_of(innermost.kind))));
    last_closed_.reset();
  }

  void drop_closer(const LooseToken& token) {
    const bool comma = at_ > 0 && kind(at_ - 1) == ',' && kind(at_ + 1) == ',';
    const std::size_t end = comma ? tokens_[at_ + 1].end : token.end;
    mend({token.at, end - token.at, " "});
    tell(token.at, error("syntax", fmt::format("this {} closes nothing", token.kind))
                       .hinting("remove it, or a bracket before it closes too early"));
    dropped_ = at_;
  }

  // What the last bracket closed goes on.
  void reopen() {
    const LooseToken& closer = tokens_[last_closer_];
    const bool comma = kind(last_closer_ + 1) == ',';
    mend({closer.at, 1, comma ? " " : ","});
    tell(closer.at,
         error("syntax", fmt::format("this {} closes the {} in line {}, which goes on after it", closer.kind,
                                     last_closed_->kind, line_of(opener(*last_closed_).at)))
             .hinting("remove it"));
    open_.push_back(*last_closed_);
    last_closed_.reset();
  }

  void close(const LooseToken& token) {
    if (laid_out_ && closes_within_its_line(token)) drop_closer(token);
    if (dropped_ == at_ || open_.empty()) return;
    if (closer_of(open_.back().kind) != token.kind) {
      const std::size_t colon = open_.back().colon;
      if (token.kind == ']' && opened_in(token.line) == 0 && colon != npos &&
          tokens_[colon].line == token.line) {
        open_missing('[', tokens_[colon].end, colon, token);
        open_.pop_back();
        return;
      }
      const auto other = std::find_if(open_.rbegin(), open_.rend(),
                                      [&](const Open& one) { return closer_of(one.kind) == token.kind; });
      if (other == open_.rend() || is_of_other_kind(token)) {
        const char meant = closer_of(open_.back().kind);
        mend({token.at, 1, std::string(1, meant)});
        tell(token.at, error("syntax", fmt::format("a {} closes the {} in line {}", token.kind,
                                                   open_.back().kind, line_of(opener(open_.back()).at)))
                           .hinting(fmt::format("write {}", meant)));
      } else {
        close_to(static_cast<std::size_t>(open_.rend() - other), token);
      }
    }
    last_closed_ = open_.back();
    last_closer_ = at_;
    open_.pop_back();
  }

  // Whether it closes, behind something else, what the next line shows to be open still.
  bool closes_within_its_line(const LooseToken& token) const {
    if (token.first || open_.empty() || !open_.back().ends_line || opener(open_.back()).line == token.line)
      return false;
    const auto next = std::find_if(tokens_.begin() + static_cast<std::ptrdiff_t>(at_) + 1, tokens_.end(),
                                   [](const LooseToken& one) { return one.first; });
    return next != tokens_.end() &&
           (next->indent > open_.back().indent || (next->indent == open_.back().indent && next->closes()));
  }

  // Whether a bracket that doesn't fit is the other kind by mistake, and none is missing before it.
  bool is_of_other_kind(const LooseToken& token) const {
    const LooseToken& top = opener(open_.back());
    if (token.first && laid_out_) return open_.back().ends_line && open_.back().indent == token.indent;
    if (top.line != token.line) return false;
    return closers_left() >= opened_in(token.line);  // as many close in this line as are open
  }

  // Something where all is closed. False: there is no knowing what was meant.
  bool after_the_end(const LooseToken& token) {
    if (token.closes()) {
      drop_closer(token);
      return true;
    }
    const bool goes_on = token.kind == ',' && kind(at_ + 1) == 's' && kind(at_ + 2) == ':';
    if (!goes_on || !last_closed_) {
      result_.in_doubt = true;
      return false;
    }
    reopen();
    return true;
  }

  void finish() {
    if (!open_.empty()) {
      if (open_.size() > 1 || !laid_out_) result_.in_doubt = true;
      std::string closers;
      for (std::size_t i = open_.size(); i-- > 0;) closers += closer_of(open_[i].kind);
      std::size_t from = end_of_whole_tokens();
      const bool comma = from > 0 && kind(from - 1) == ',';
      from -= comma;
      cut_ = from < tokens_.size() ? tokens_[from].at : text_.size();
      mend({cut_, text_.size() - cut_, closers});
      tell(text_.size(), error("syntax", "the file ends too early")
                             .hinting(fmt::format("a {} is missing: the {} in line {} isn't closed",
                                                  closer_of(open_.back().kind), open_.back().kind,
                                                  line_of(opener(open_.back()).at))));
    }
    for (const Mend& mend : loose_.mends)
      if (mend.at < cut_) this->mend(mend);
    for (Slip& slip : loose_.slips)
      if (slip.at < cut_) tell(slip.at, std::move(slip.problem));
    std::stable_sort(result_.slips.begin(), result_.slips.end(),
                     [](const Slip& a, const Slip& b) { return a.at < b.at; });
    if (too_many_) result_ = {};
  }

  // Of a text that ends too early: where its last member or element begins, if that isn't whole.
  std::size_t end_of_whole_tokens() const {
    std::size_t end = tokens_.size();
    const LooseToken& last = tokens_[end - 1];
    const bool unclosed = std::any_of(loose_.mends.begin(), loose_.mends.end(),
                                      [&](const Mend& mend) { return mend.at == last.at; });
    const bool cut = last.end == text_.size() && (last.kind == 'w' || unclosed);
    if (cut) --end;
    if (open_.back().kind != '{') return end;
    if (end > 1 && kind(end - 1) == ':') return end - 2;
    const bool only_a_name =
        end > 1 && kind(end - 1) == 's' && (kind(end - 2) == '{' || kind(end - 2) == ',');
    return only_a_name ? end - 1 : end;
  }

  void mend(const Mend& mend) {
    if (result_.mends.size() >= most_mends || !put_in(result_.mends, mend)) too_many_ = true;
  }
  void tell(std::size_t at, Diagnostic problem) { result_.slips.push_back({at, std::move(problem)}); }

  std::string_view text_;
  LooseText loose_;
  const std::vector<LooseToken>& tokens_;
  bool laid_out_ = false, too_many_ = false;
  std::size_t at_ = 0;      // the token looked at
  std::size_t cut_ = npos;  // the byte from which a text that ends too early is left out
  std::vector<Open> open_;
  std::optional<Open> last_closed_;
  std::size_t last_closer_ = 0, dropped_ = npos;  // tokens
  Rescue result_;
};

}  // namespace

Rescue rescue_brackets(std::string_view text) {
  return Rescuer(text).rescue();
}

}  // namespace kinegraph
