#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "graph/cache/disk_cache.h"
#include "headless/commands.h"
#include "headless/exit_code.h"

namespace kinegraph {

namespace {

std::string folder_of(const Program& program, const CacheArguments& arguments) {
  std::string folder = arguments.folder;
  if (const char* usual = std::getenv("KINEGRAPH_CACHE"); folder.empty() && usual) folder = usual;
  if (folder.empty())
    throw UsageError(Diagnostic(
        error("no-cache", "no cache folder was named").hinting("--cache DIR or $KINEGRAPH_CACHE")));
  std::error_code problem;
  if (std::filesystem::exists(folder, problem) && !std::filesystem::is_directory(folder, problem))
    throw Failure(Diagnostic(error("not-a-folder", fmt::format("'{}' is not a folder", folder))
                                 .hinting("--cache names the folder that `run --cache` fills")));
  if (!std::filesystem::exists(folder, problem))
    program.terminal.say(warning("missing-folder", fmt::format("there is no folder '{}' (yet)", folder))
                             .hinting("the first `run --cache` makes it"));
  return absolute_path(folder);
}

std::string told(const DiskCache::Stat& stat) {
  return fmt::format(
      "{} {}, {}{}{}", stat.entries, stat.entries == 1 ? "entry" : "entries", size_text(stat.bytes),
      stat.damaged ? fmt::format(", {} damaged", stat.damaged) : "",
      stat.leftovers ? fmt::format(", {} left by killed writers or being written", stat.leftovers) : "");
}

}  // namespace

int cache_stat_command(const Program& program, const CacheArguments& arguments) {
  program.terminal.result(told(DiskCache::stat(folder_of(program, arguments))) + "\n");
  return exit_code::done;
}

int cache_gc_command(const Program& program, const CacheArguments& arguments) {
  auto folder = folder_of(program, arguments);
  std::uint64_t limit = 0;
  if (!arguments.limit.empty()) {
    try {
      limit = parse_size(arguments.limit);
    } catch (const Failure& failure) {
      throw UsageError(failure.diagnostic());
    }
  }
  program.terminal.result("kept " + told(DiskCache::collect(folder, limit)) + "\n");
  return exit_code::done;
}

int cache_clear_command(const Program& program, const CacheArguments& arguments) {
  program.terminal.result("removed " + told(DiskCache::clear(folder_of(program, arguments))) + "\n");
  return exit_code::done;
}

int cache_verify_command(const Program& program, const CacheArguments& arguments) {
  auto stat = DiskCache::verify(folder_of(program, arguments), [&](const std::string& path) {
    program.terminal.message(fmt::format("damaged: {}\n", path));
  });
  program.terminal.result(told(stat) + "\n");
  return stat.damaged ? exit_code::failed : exit_code::done;
}

}  // namespace kinegraph
