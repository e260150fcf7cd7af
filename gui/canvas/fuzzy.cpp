#include "gui/canvas/fuzzy.h"

#include <algorithm>

namespace kinegraph {
namespace {

double letters_in_order(const QString& typed, const QString& name) {
  double score = 0;
  qsizetype at = 0;
  qsizetype last = -2;
  for (const QChar wanted : typed) {
    qsizetype found = -1;
    for (qsizetype i = at; i < name.size(); ++i)
      if (name[i].toLower() == wanted.toLower()) {
        // The start of a later word is worth more than a letter inside this one.
        if (found < 0) found = i;
        if (i == last + 1 || i == 0 || name[i].isUpper()) {
          found = i;
          break;
        }
      }
    if (found < 0) return 0;
    const bool starts_word = found == 0 || name[found].isUpper() || !name[found - 1].isLetterOrNumber();
    score += found == last + 1 ? 3 : starts_word ? 2.5 : 0.5;
    last = found;
    at = found + 1;
  }
  return score / (3.0 * double(typed.size())) * 0.8;
}

}  // namespace

double fuzzy_score(const QString& typed, const QString& name, const QStringList& keywords) {
  const QString text = typed.trimmed();
  if (text.isEmpty()) return 1;
  const double shorter = 0.01 * std::min(1.0, double(text.size()) / std::max<double>(1, double(name.size())));
  if (name.startsWith(text, Qt::CaseInsensitive)) return 2 + shorter;
  if (name.contains(text, Qt::CaseInsensitive)) return 1.5 + shorter;
  double best = letters_in_order(text, name);
  if (best < 0.45) best = 0;
  // The family counts before other words that a node is found by, a whole word before its start.
  for (const QString& keyword : keywords) {
    const bool is_family = &keyword == &keywords.front();
    if (keyword.compare(text, Qt::CaseInsensitive) == 0)
      best = std::max(best, is_family ? 1.4 : 1.3);
    else if (keyword.startsWith(text, Qt::CaseInsensitive))
      best = std::max(best, 1.2);
    else if (text.size() > 2 && keyword.contains(text, Qt::CaseInsensitive))
      best = std::max(best, 1.0);
  }
  return best > 0 ? best + shorter : 0;
}

}  // namespace kinegraph
