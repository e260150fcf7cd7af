// Objects of several forms told apart by their first field, such as a ComponentEdit's edits: a row of a table
// that is a choice and the rest as words, "component 3, factor 0.5".
#pragma once
#include <QString>
#include <optional>

#include "graph/param.h"

namespace kinegraph {

// Whether the type is such: alternatives that are all objects whose first field is a choice of one key.
bool has_variants(const ParamType& type);
// One choice of all keys.
ParamType choice_of_variants(const ParamType& type);
QString variant_key(const ParamType& type, const Json& value);
// All fields but the first; those at their default are left out.
QString variant_text(const ParamType& type, const Json& value);
// The object of a key with the fields of a text; nothing where it can't be read or doesn't fit (`why` says).
std::optional<Json> variant_of(const ParamType& type, const QString& key, const QString& text, QString* why);
// What a fresh row of a key says: its required fields with values to begin with, or those that `before` has.
QString fresh_variant_text(const ParamType& type, const QString& key, const Json& before);

}  // namespace kinegraph
