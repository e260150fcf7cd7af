// For tests and measurements only: which of the vector units compiled into the program it uses.
#pragma once

namespace kinegraph {

// $KINEGRAPH_CPU names one of Highway's targets ("sse2", "avx2"): only that one is used from here on. Call it
// before anything computes. Throws UsageError ("unknown-cpu"), whose hint lists those that this CPU runs.
void choose_cpu_from_environment();

}  // namespace kinegraph
