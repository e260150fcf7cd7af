// What stands where a file was looked for and isn't.
#pragma once
#include <filesystem>
#include <string>

namespace kinegraph {

// For a hint: that the path is a link that leads nowhere, the name beside it that was meant, or that the
// folder isn't there either; "" where nothing can be said.
std::string what_is_instead_of(const std::filesystem::path& file);

}  // namespace kinegraph
