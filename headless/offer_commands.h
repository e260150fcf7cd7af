#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace kinegraph {

struct Program;

// What the command line asks for: does it, and gives the exit code.
using Choice = std::function<int(const Program&)>;

// Tells CLI11 of every command, its arguments and its help. Parsing puts the command that was named into
// `choice`, which must live as long as `app`.
void offer_commands(CLI::App& app, Choice& choice);

}  // namespace kinegraph
