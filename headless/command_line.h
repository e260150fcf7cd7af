#pragma once

#include "headless/offer_commands.h"

namespace kinegraph {

// What the words of the command line ask for. Asked for help or the version it prints these, and what comes
// back has nothing left to do. Wrong usage is a UsageError that names the nearest right one.
Choice read_command_line(const Program& program, int argc, char** argv);

}  // namespace kinegraph
