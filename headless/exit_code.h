// What the program's exit code says; see the contract's "Command line".
#pragma once

namespace kinegraph::exit_code {

inline constexpr int done = 0;
inline constexpr int failed = 1;   // a node failed or was blocked; a difference with --check
inline constexpr int usage = 2;    // the command line is wrong
inline constexpr int invalid = 3;  // a graph or a file given as an argument is invalid, or a write is refused
inline constexpr int checks_failed = 4;  // only checks failed
inline constexpr int cannot_write = 5;
inline constexpr int internal = 70;
inline constexpr int timed_out = 124;
inline constexpr int interrupted = 130;  // SIGINT
inline constexpr int terminated = 143;   // SIGTERM

// Of two that both hold, the one that is told: 130/143, 124, 70, 5, 3, 1, 4, 0. Usage is told before anything
// runs.
int graver(int a, int b);

}  // namespace kinegraph::exit_code
