// The keys of a plan's nodes: made from what the registry declares, the contents of files and the keys of
// inputs. No name of a node, no path and no clock enters.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/evaluate/file_store.h"
#include "graph/key.h"
#include "graph/plan.h"

namespace kinegraph {

// A file that a node may read: named by an open_file parameter, or a companion of one.
struct NodeFile {
  std::string path;           // absolute
  std::string shown;          // as the user wrote it
  std::string param;          // "" for a companion
  std::optional<Key> digest;  // nothing where it can't be read; computing will say why
};

// What a key is made of, for `explain`.
struct KeyPart {
  std::string what;  // "type", "code version", "param omega", "input motion", "file"
  std::string value;
};

struct NodeKey {
  std::optional<Key> key;  // of the node; nothing where something before it has none, or `failure` says why
  std::vector<NodeFile> files;
  std::optional<Diagnostic> failure;
  std::vector<KeyPart> parts;
};

Key output_key(const Key& node, std::string_view port);
Key constant_key(std::string_view id);

// Files are looked at once, when a node's key is first asked for. Different nodes may be made by different
// threads, each after the nodes it depends on.
class NodeKeys {
 public:
  // `cpu_path` enters the keys of node types that aren't the same on every CPU. `check` (may be empty) is
  // called while files are hashed, and throws to stop.
  NodeKeys(const Plan& plan, const Registry& registry, FileStore& files, std::string cpu_path,
           std::function<void()> check = {});

  const NodeKey& of(int node) const { return keys_.at(static_cast<std::size_t>(node)); }
  // Makes the key from the present keys of its inputs. `look`: also looks at its files anew, which happens in
  // any case the first time.
  void make(int node, bool look = false);
  // The key of what a source gives; nothing where it has none.
  std::optional<Key> of(const Source& source) const;

 private:
  void look_at_files(int node);

  const Plan& plan_;
  const Registry& registry_;
  FileStore& files_;
  std::string cpu_path_;
  std::function<void()> check_;
  std::vector<NodeKey> keys_;
  std::vector<char> looked_;  // not bool: neighbours may be set by two threads
};

// The nodes that `wanted` and everything before them, each after what it depends on. Throws Failure
// ("cycle").
std::vector<int> in_order(const Plan& plan, const std::vector<int>& wanted);

}  // namespace kinegraph
