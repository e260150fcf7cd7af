#include "graph/evaluate/note_paths.h"

namespace kinegraph {

namespace {

std::string mark(std::size_t index) {
  return "\x1f" + std::to_string(index) + "\x1f";
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  if (from.size() < 2) return;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

Diagnostic without_paths(Diagnostic note, const std::vector<NodeFile>& files) {
  note.node.clear();
  for (std::size_t i = 0; i < files.size(); ++i)
    for (auto* text : {&note.message, &note.hint, &note.file}) replace_all(*text, files[i].path, mark(i));
  const bool in_a_file = !note.file.empty() || note.place.line > 0;
  if (in_a_file && !files.empty() && !note.file.starts_with('\x1f')) note.file = mark(0);
  return note;
}

Diagnostic with_paths(Diagnostic note, const std::vector<NodeFile>& files) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (auto* text : {&note.message, &note.hint, &note.file}) replace_all(*text, mark(i), files[i].shown);
  return note;
}

}  // namespace kinegraph
