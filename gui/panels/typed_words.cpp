#include "gui/panels/typed_words.h"

#include <QObject>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

#include "gui/document/problem_text.h"
#include "gui/panels/arithmetic.h"

namespace kinegraph {
namespace {

using Kind = ParamType::Kind;

const QString arrow = QStringLiteral(" → ");

bool is_pair(const ParamType& type) {
  return type.kind == Kind::tuple && type.parts.size() == 2;
}

bool is_structured(const ParamType& type) {
  return type.kind == Kind::list || type.kind == Kind::tuple || type.kind == Kind::object ||
         type.kind == Kind::table || type.kind == Kind::range;
}

// Tuples hold commas themselves.
QChar between_elements(const ParamType& list) {
  return list.parts[0].kind == Kind::tuple && !is_pair(list.parts[0]) ? QChar(';') : QChar(',');
}

QString json_text(const Json& value) {
  return QString::fromStdString(compact(value));
}

QString end_text(const Json& end) {
  return end.is_null() ? QObject::tr("end") : QString::fromStdString(shortest_number(end.number()));
}

// `inside`: one of several, where commas and arrows part them.
QString written(const ParamType& type, const Json& value, bool inside) {
  const bool is_list = value.is_array();
  if (value.is_null()) return {};
  if (value.is_number()) return QString::fromStdString(shortest_number(value.number()));
  if (value.is_boolean()) return value.boolean() ? QObject::tr("yes") : QObject::tr("no");
  if (value.is_string()) {
    const QString text = QString::fromStdString(value.string());
    static const QRegularExpression parting("[,;\"→\\[\\]{}]|^\\s|\\s$|^$");
    return inside && text.contains(parting) ? json_text(value) : text;
  }
  if (type.kind == Kind::either) {
    for (const ParamType& part : type.parts)
      if (!has_error(check(part, value, {}))) return written(part, value, inside);
  } else if (type.kind == Kind::range && is_list && value.array().size() == 2 &&
             value.array()[0].is_number()) {
    return end_text(value.array()[0]) + "–" + end_text(value.array()[1]);
  } else if (type.kind == Kind::tuple && is_list && value.array().size() == type.parts.size()) {
    QStringList parts;
    for (std::size_t i = 0; i < type.parts.size(); ++i)
      parts << written(type.parts[i], value.array()[i], true);
    return parts.join(is_pair(type) ? arrow : QStringLiteral(", "));
  } else if (type.kind == Kind::list && is_list) {
    QStringList parts;
    for (const Json& one : value.array()) parts << written(type.parts[0], one, true);
    return parts.join(QString(between_elements(type)) + " ");
  }
  return json_text(value);
}

std::optional<Json> read(const ParamType& type, const QString& text, QString* why);

std::optional<Json> read_json(const ParamType& type, const QString& text, QString* why) {
  try {
    return parse_value(type, text.toStdString());
  } catch (const Failure& failure) {
    *why = problem_text(failure.diagnostic());
    return {};
  }
}

std::optional<Json> read_range(const QString& text, QString* why) {
  static const QRegularExpression between("\\s*(?:–|:|\\bto\\b|\\.\\.)\\s*|\\s*-\\s*");
  const QStringList ends = text.split(between);
  const bool open = ends.size() == 2 && (ends[1].isEmpty() || ends[1] == QObject::tr("end"));
  const auto first = ends[0].isEmpty() ? std::optional<double>(0) : calculated(ends[0]);
  const auto last = open || ends.size() != 2 ? std::optional<double>() : calculated(ends[1]);
  if (ends.size() == 2 && first && (open || last))
    return Json(Json::Array{Json(*first), open ? Json() : Json(*last)});
  *why = QObject::tr(
             "“%1” is no range of frames. Wanted is the first frame and the one after the last, such as "
             "“10–50” or “10–end”.")
             .arg(text);
  return {};
}

std::optional<Json> read_tuple(const ParamType& type, const QString& text, QString* why) {
  static const QRegularExpression arrows("\\s*(?:→|->|×|:|,)\\s*"), blanks("\\s*[,;]\\s*|\\s+");
  QStringList parts = is_pair(type) ? text.split(arrows) : text.split(blanks);
  if (is_pair(type) && parts.size() == 1) parts = text.split(QRegularExpression("\\s+"));
  if (parts.size() != qsizetype(type.parts.size())) {
    QStringList such;
    for (std::size_t i = 0; i < type.parts.size(); ++i) such << QString::number(i + 1);
    *why = QObject::tr("“%1” isn't %2 values. Wanted is such as “%3”.")
               .arg(text)
               .arg(type.parts.size())
               .arg(such.join(is_pair(type) ? arrow : QStringLiteral(", ")));
    return {};
  }
  Json::Array all;
  for (std::size_t i = 0; i < type.parts.size(); ++i) {
    auto one = read(type.parts[i], parts[qsizetype(i)].trimmed(), why);
    if (!one) return {};
    all.push_back(std::move(*one));
  }
  return Json(std::move(all));
}

std::optional<Json> read_list(const ParamType& type, const QString& text, QString* why) {
  Json::Array all;
  for (const QString& part : parted(text, between_elements(type))) {
    if (part.trimmed().isEmpty()) continue;
    auto one = read(type.parts[0], part.trimmed(), why);
    if (!one) return {};
    all.push_back(std::move(*one));
  }
  return Json(std::move(all));
}

// The first alternative that fits; a comma speaks of a list.
std::optional<Json> read_either(const ParamType& type, const QString& text, QString* why) {
  const bool several = parted(text).size() > 1;
  for (const bool lists : {several, !several})
    for (const ParamType& part : type.parts) {
      QString unused;
      if ((part.kind == Kind::list) != lists) continue;
      if (auto value = read(part, text, &unused); value && !has_error(check(part, *value, {}))) return value;
    }
  *why = QObject::tr("“%1” doesn't fit.").arg(text) + " " + what_fits(type);
  return {};
}

std::optional<Json> read(const ParamType& type, const QString& text, QString* why) {
  if (is_structured(type) && (text.startsWith('[') || text.startsWith('{')))
    return read_json(type, text, why);
  switch (type.kind) {
    case Kind::number:
    case Kind::integer:
      if (const auto number = calculated(text)) return Json(*number);
      *why =
          text.isEmpty() ? QObject::tr("A number is missing.") : QObject::tr("“%1” is no number.").arg(text);
      *why += " " + what_fits(type);
      return {};
    case Kind::boolean:
      for (const auto& [word, value] :
           {std::pair("yes", true), std::pair("true", true), std::pair("on", true), std::pair("no", false),
            std::pair("false", false), std::pair("off", false)})
        if (text.compare(word, Qt::CaseInsensitive) == 0) return Json(value);
      *why = QObject::tr("“%1” is neither yes nor no.").arg(text);
      return {};
    case Kind::range:
      return read_range(text, why);
    case Kind::tuple:
      return read_tuple(type, text, why);
    case Kind::list:
      return read_list(type, text, why);
    case Kind::either:
      return read_either(type, text, why);
    default:
      return read_json(type, text, why);
  }
}

}  // namespace

QStringList parted(const QString& text, QChar at) {
  QStringList parts{QString()};
  int depth = 0;
  bool quoted = false;
  for (const QChar c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == '[' || c == '{')) ++depth;
    if (!quoted && (c == ']' || c == '}')) --depth;
    if (c == at && depth == 0 && !quoted)
      parts << QString();
    else
      parts.back() += c;
  }
  return parts;
}

QString what_fits(const ParamType& type) {
  return QObject::tr("Wanted is %1.").arg(QString::fromStdString(described(type)));
}

QString typed_text(const ParamType& type, const Json& value) {
  const QString words = written(type, value, false);
  if (!value.is_array() && !value.is_object()) return words;
  QString why;
  const auto again = read(type, words, &why);
  return again && *again == value ? words : json_text(value);
}

std::optional<Json> typed_value(const ParamType& type, const QString& text, QString* why) {
  auto value = read(type, text, why);
  if (!value) return {};
  const Diagnostics problems = check(type, *value, type.name);
  const auto wrong = std::find_if(problems.begin(), problems.end(),
                                  [](const Diagnostic& one) { return one.severity == Severity::error; });
  if (wrong == problems.end()) return value;
  const QString advice = advice_on(*wrong);
  *why = problem_text(*wrong) + (advice.isEmpty() ? "" : " " + advice);
  return {};
}

}  // namespace kinegraph
