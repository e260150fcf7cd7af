// What docks say of a node that has nothing to show.
#pragma once
#include <QString>
#include <string>

#include "gui/document/session.h"
#include "gui/evaluation/evaluation.h"

namespace kinegraph {

// Why a node has no value and what to do about it, or, where it may come any moment, what it waits for and
// how far that is.
QString why_no_value(const Session& session, const Evaluation& evaluation, const std::string& node);
// Whether it may come any moment.
bool is_on_its_way(const Session& session, const Evaluation& evaluation, const std::string& node);

}  // namespace kinegraph
