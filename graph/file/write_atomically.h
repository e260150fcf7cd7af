// Writing a file so that a reader never sees half of it.
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// Whether a file is synced, so that after a crash of the machine the old or the new one is there, whole. Waiting for the
// disk takes tens of milliseconds where others write too, and what is made again at every run need not last so.
enum class Lasting { yes, no };

// Writes aside, syncs and renames. Throws Failure ("cannot-write") that names the path; the aside file is removed then.
// Keeps the permissions of a file it replaces and follows a symbolic link to the file it names.
void write_file_atomically(const std::string& path, std::string_view bytes, Lasting lasting = Lasting::yes);

}  // namespace kinegraph
