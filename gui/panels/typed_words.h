// Values of parameters as people read and type them: "10–end" for a range, "0.45, 1.7, 0.1" for a tuple,
// "1 → 0.5, 2 → 1" for a list of pairs. What can't be said so stands as JSON, which is taken everywhere too.
#pragma once
#include <QString>
#include <optional>

#include "graph/param.h"

namespace kinegraph {

// A value as it is typed: typed_value() of it gives the value again. Nothing (null) is an empty text.
QString typed_text(const ParamType& type, const Json& value);
// Nothing where the text can't be read or the value doesn't fit; `why` then says what is wrong and what fits.
std::optional<Json> typed_value(const ParamType& type, const QString& text, QString* why);
// Where commas (or semicolons) part it that stand in no brackets or quotes.
QStringList parted(const QString& text, QChar at = ',');
// What fits, as a sentence: "Wanted is a number from 0 to 1 (s)."
QString what_fits(const ParamType& type);

}  // namespace kinegraph
