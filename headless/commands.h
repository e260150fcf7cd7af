// One function a command; each returns the program's exit code. They throw UsageError for what is wrong on
// the command line (exit 2) and Failure for a file given as an argument that is invalid (exit 3).
#pragma once
#include <string>
#include <vector>

#include "headless/session.h"

namespace kinegraph {

int run_command(const Program& program, const RunArguments& arguments);
// One output in any of Export's formats.
int get_command(const Program& program, const RunArguments& arguments, const std::string& port,
                const std::string& file);

struct ValidateArguments {
  std::vector<std::string> graphs, vars;
  bool json = false, strict = false, no_files = false;
};
int validate_command(const Program& program, const ValidateArguments& arguments);

int fmt_command(const Program& program, const std::vector<std::string>& graphs, bool check);
int upgrade_command(const Program& program, const std::vector<std::string>& graphs, bool in_place);

// What changed in meaning between two graphs; with `textconv`, `a` alone as one line a unit, for git.
struct DiffArguments {
  std::string a, b;
  bool check = false, json = false, textconv = false;
};
int diff_command(const Program& program, const DiffArguments& arguments);

// Three-way, as git's merge driver asks for it.
struct MergeArguments {
  std::string base, ours, theirs, out;
  std::string path;  // where the graph stands, as git's files for a merge have made-up names; "" = at `out`
};
int merge_command(const Program& program, const MergeArguments& arguments);

int dot_command(const Program& program, const std::string& graph);
int explain_command(const Program& program, const RunArguments& arguments, const std::string& node);
int files_command(const Program& program, const RunArguments& arguments, bool json);

enum class ReferenceForm { text, json, markdown };
int nodes_command(const Program& program, const std::string& type, ReferenceForm form);

struct PictureArguments {
  RunArguments run;  // run.graph: a graph, or a file of a motion or an analysis
  std::vector<std::string>
      ports;         // of a graph: NODE.PORT, several motions make rows; of a file: an output of Load
  std::string file;  // .svg or .png
  std::string title;
  int moments = 0;
};
int picture_command(const Program& program, const PictureArguments& arguments);

struct CompareArguments {
  std::string a, b;
  std::vector<std::string> rules;
  bool json = false;
};
int compare_command(const Program& program, const CompareArguments& arguments);

// What a person wants to know of a motion file before using it.
struct InfoArguments {
  std::string file;
  bool json = false;
};
int info_command(const Program& program, const InfoArguments& arguments);

// One file format to another, by the endings.
struct ConvertArguments {
  std::string in, out;
  double fps = 0;              // 0 = as it is
  std::string unit, out_unit;  // as Load's and Export's; "" = their defaults
};
int convert_command(const Program& program, const ConvertArguments& arguments);

// One graph over many clips.
struct BatchArguments {
  RunArguments run;
  std::vector<std::string> each;  // "NODE.PARAM=GLOB"
  bool cross = false, resume = false;
  std::string table, shard;
  std::vector<std::string> merge_reports;  // then nothing runs, and
  std::string merged;                      // this is written
};
int batch_command(const Program& program, const BatchArguments& arguments);

// The graph, nested files and clips in a folder, with paths that lead there.
int pack_command(const Program& program, const RunArguments& arguments, const std::string& folder);

struct CacheArguments {
  std::string folder, limit;
};
int cache_stat_command(const Program& program, const CacheArguments& arguments);
int cache_gc_command(const Program& program, const CacheArguments& arguments);
int cache_clear_command(const Program& program, const CacheArguments& arguments);
int cache_verify_command(const Program& program, const CacheArguments& arguments);

}  // namespace kinegraph
