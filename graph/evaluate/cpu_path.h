// The name of the code path that a CPU takes, for the keys of node types whose last bits differ between them.
#pragma once
#include <string>

namespace kinegraph {

std::string cpu_path();  // "x86-64", "x86-64-avx2-fma", "x86-64-avx512" …, after the running CPU

}  // namespace kinegraph
