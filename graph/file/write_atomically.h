// Writing a file so that a reader never sees half of it.
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// Writes aside, syncs and renames: after a crash the old or the new file is there, whole. Throws Failure
// ("cannot-write") that names the path; the aside file is removed then. Keeps the permissions of a file it replaces and
// follows a symbolic link to the file it names.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace kinegraph
