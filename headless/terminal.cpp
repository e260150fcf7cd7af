#include "headless/terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace kinegraph {

namespace {

std::string with_tint(std::string_view text, Tint tint) {
  const char* code = tint == Tint::bold     ? "1"
                     : tint == Tint::faint  ? "2"
                     : tint == Tint::red    ? "31"
                     : tint == Tint::yellow ? "33"
                     : tint == Tint::green  ? "32"
                     : tint == Tint::blue   ? "34"
                                            : "0";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

}  // namespace

Terminal::Terminal() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  bool allowed = !(no_color && *no_color) && !(term && std::string_view(term) == "dumb");
  err_terminal_ = isatty(STDERR_FILENO) != 0;
  err_color_ = allowed && err_terminal_;
  out_color_ = allowed && isatty(STDOUT_FILENO) != 0;
}

int Terminal::columns() const {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

void Terminal::result(std::string_view text) const {
  std::fwrite(text.data(), 1, text.size(), stdout);
}
void Terminal::message(std::string_view text) const {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void Terminal::say(const Diagnostic& diagnostic) const {
  std::string text = to_text(diagnostic);
  if (err_color_) {
    std::string word = name_of(diagnostic.severity);
    auto tint = diagnostic.severity == Severity::error ? Tint::red : Tint::yellow;
    auto at = text.find(word + ":");
    if (diagnostic.severity == Severity::info)
      text = with_tint(text, Tint::faint);
    else if (at != std::string::npos)
      text.replace(at, word.size(), with_tint(word, tint));
  }
  message(text + "\n");
}

void Terminal::say(const Diagnostics& diagnostics) const {
  for (const auto& diagnostic : diagnostics) say(diagnostic);
}

bool Terminal::results_written() const {
  return std::fflush(stdout) == 0 && !std::ferror(stdout);
}

std::string Terminal::tinted(std::string_view text, Tint tint) const {
  return out_color_ ? with_tint(text, tint) : std::string(text);
}
std::string Terminal::tinted_message(std::string_view text, Tint tint) const {
  return err_color_ ? with_tint(text, tint) : std::string(text);
}

std::string size_text(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  double size = static_cast<double>(bytes);
  const char* units[] = {"KiB", "MiB", "GiB", "TiB"};
  int unit = -1;
  while (size >= 1024 && unit < 3) size /= 1024, ++unit;
  return fmt::format("{:.{}f} {}", size, size < 10 ? 1 : 0, units[unit]);
}

std::uint64_t parse_size(std::string_view text) {
  auto refuse = [&] {
    return Failure(
        error("bad-size", fmt::format("'{}' is not a size", text)).hinting("write it as 512M or 2G"));
  };
  double number = 0;
  auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || !(number >= 0) || !std::isfinite(number)) throw refuse();
  std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (rest.ends_with("iB")) rest.remove_suffix(2);
  double unit = 1;
  if (rest == "K" || rest == "k")
    unit = 1024.0;
  else if (rest == "M")
    unit = 1024.0 * 1024;
  else if (rest == "G")
    unit = 1024.0 * 1024 * 1024;
  else if (rest == "T")
    unit = 1024.0 * 1024 * 1024 * 1024;
  else if (!rest.empty() && rest != "B")
    throw refuse();
  if (number * unit >= 9e18) throw refuse();
  return static_cast<std::uint64_t>(number * unit);
}

}  // namespace kinegraph
