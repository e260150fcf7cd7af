// Numbers as people type them: "1/3", "2*(0.4+1)", "24*60".
#pragma once
#include <QString>
#include <optional>

namespace kinegraph {

// + - * / ^ and brackets, with a decimal point or comma; nothing where it is no such expression or isn't
// finite.
std::optional<double> calculated(const QString& text);

}  // namespace kinegraph
