// Finding by a few typed letters.
#pragma once
#include <QString>
#include <QStringList>

namespace kinegraph {

// How well `typed` names the thing, 0 = not at all: its letters stand in `name` in order, better together and
// at starts of words; a keyword that starts with it counts less than the name. Empty finds everything.
double fuzzy_score(const QString& typed, const QString& name, const QStringList& keywords);

}  // namespace kinegraph
