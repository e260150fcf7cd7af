// One entry of the disk cache as bytes.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "graph/cache/memory_cache.h"
#include "graph/registry.h"

namespace kinegraph {

// Both ask `give_up` (may be empty) every few megabytes and throw Cancelled when it says so.
std::string encode_entry(const Key& key, const Cached& cached, const std::function<bool()>& give_up);
// Throws Failure ("damaged-entry") for anything that encode_entry did not write for this key.
Cached decode_entry(const Key& key, std::string_view bytes, const Registry& registry,
                    const std::function<bool()>& give_up);
// Whether header, checksum and key agree; nothing is decoded.
bool is_whole_entry(const Key& key, std::string_view bytes);

}  // namespace kinegraph
