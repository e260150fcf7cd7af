// What the window says of a diagnostic, everywhere in the same words.
#pragma once
#include <QString>

#include "graph/diagnostic.h"

namespace kinegraph {

// With the quotes of the editor's own words around what stands in "", '' or ``.
QString with_quotes(const QString& text);
// How much it weighs for who draws a graph: a node that waits for its links is no failure, every node begins
// so. It keeps the graph from running all the same.
Severity shown_severity(const Diagnostic& problem);
// What was found, with joint, frame, and the line of the file where they are known.
QString problem_text(const Diagnostic& problem);
// Where in a graph it is: "walk.speed, line 12". Empty where that isn't known.
QString place_of(const Diagnostic& problem);
// What to do about it: the hint that came with it; for a file that can't be read, how to go on.
QString advice_on(const Diagnostic& problem);

}  // namespace kinegraph
