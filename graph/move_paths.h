// A graph's paths when its file moves to another folder: the files they name stay the same ones.
#pragma once
#include <string>

#include "graph/edit.h"
#include "graph/param.h"
#include "graph/registry.h"

namespace kinegraph {

// Absolute folders: where relative paths started and where they start now. `from` "" = nowhere: only absolute
// paths are looked at.
struct Move {
  std::string from, to;
};

// A path as it is written below the new folder. A file that is read: relative to it wherever it lies near (at
// most three folders up and down again), else absolute; one that is only found in the new folder under the
// same name is that one. A file that is written: where it was absolute and lies below the new folder,
// relative, else as it is, as results belong beside their graph. A path with "${" moves by what stands before
// it; one that begins with it doesn't.
std::string moved_path(const std::string& path, ParamType::Kind kind, const Move& move);

// All paths in a value, and in the document's nodes and in the variables that paths begin with.
Json moved_paths(const ParamType& type, const Json& value, const Move& move);
void move_paths(Document& document, const Registry& registry, const Move& move);
// What undo and redo would bring back moves as well, so that they name the same files before and after.
void move_paths(History& history, const Document& document, const Registry& registry, const Move& move);

}  // namespace kinegraph
