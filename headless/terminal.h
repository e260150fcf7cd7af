// Standard output and standard error: results go to the one, messages to the other. Colours only on a
// terminal, and never under NO_COLOR.
#pragma once
#include <string>
#include <string_view>

#include "graph/diagnostic.h"

namespace kinegraph {

enum class Tint { plain, bold, faint, red, yellow, green, blue };

class Terminal {
 public:
  Terminal();  // looks at the environment and at what the streams are

  bool messages_on_terminal() const { return err_terminal_; }
  bool colored_messages() const { return err_color_; }
  bool colored_results() const { return out_color_; }
  int columns() const;  // of the terminal that shows messages

  void result(std::string_view text) const;   // to standard output, as it is
  void message(std::string_view text) const;  // to standard error, as it is
  void say(const Diagnostic& diagnostic) const;
  void say(const Diagnostics& diagnostics) const;
  // Whether everything so far could be written to standard output (a full disk, a closed pipe).
  bool results_written() const;

  std::string tinted(std::string_view text, Tint tint) const;          // for standard output
  std::string tinted_message(std::string_view text, Tint tint) const;  // for standard error

 private:
  bool err_terminal_, out_color_, err_color_;
};

std::string size_text(std::uint64_t bytes);  // "1.2 MiB"
// "512M", "2G", powers of 1024; throws Failure ("bad-size").
std::uint64_t parse_size(std::string_view text);

}  // namespace kinegraph
