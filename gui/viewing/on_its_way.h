// What is said of a node whose value may come any moment.
#pragma once
#include <QString>
#include <string>

#include "graph/document.h"
#include "gui/evaluation/evaluation.h"

namespace kinegraph {

// "Evaluating soft…", or, where it waits for one before it, which one and how far that is.
QString on_its_way(const Document& document, const Evaluation& evaluation, const std::string& node);

}  // namespace kinegraph
