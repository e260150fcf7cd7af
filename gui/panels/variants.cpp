#include "gui/panels/variants.h"

#include <QObject>
#include <algorithm>

#include "graph/diagnostic.h"
#include "gui/panels/typed_words.h"

namespace kinegraph {
namespace {

using Kind = ParamType::Kind;

const ParamType* variant(const ParamType& type, const QString& key) {
  for (const ParamType& part : type.parts)
    if (QString::fromStdString(part.parts[0].choices[0].key) == key) return &part;
  return nullptr;
}

bool holds_list(const ParamType& type) {
  return type.kind == Kind::list ||
         (type.kind == Kind::either && std::any_of(type.parts.begin(), type.parts.end(), holds_list));
}

Json begin_of(const ParamType& type) {
  switch (type.kind) {
    case Kind::number:
    case Kind::integer:
      return std::clamp(1.0, type.min, type.max);
    case Kind::boolean:
      return true;
    case Kind::choice:
      return type.choices.front().key;
    case Kind::range:
      return Json::Array{0, 10};
    case Kind::either:
      return begin_of(type.parts.front());
    case Kind::list:
      return Json::Array{begin_of(type.parts.front())};
    case Kind::tuple: {
      Json::Array all;
      for (const ParamType& part : type.parts) all.push_back(begin_of(part));
      return all;
    }
    default:
      return "name";
  }
}

}  // namespace

bool has_variants(const ParamType& type) {
  return type.kind == Kind::either && !type.parts.empty() &&
         std::all_of(type.parts.begin(), type.parts.end(), [](const ParamType& part) {
           return part.kind == Kind::object && !part.parts.empty() && part.parts[0].kind == Kind::choice &&
                  part.parts[0].choices.size() == 1;
         });
}

ParamType choice_of_variants(const ParamType& type) {
  std::vector<ParamType::Choice> choices;
  for (const ParamType& part : type.parts) choices.push_back(part.parts[0].choices[0]);
  ParamType all = choice(std::move(choices));
  all.name = type.parts[0].parts[0].name;
  all.help = type.parts[0].parts[0].help;
  return all;
}

QString variant_key(const ParamType& type, const Json& value) {
  const Json* key = value.find(type.parts[0].parts[0].name);
  return key && key->is_string() ? QString::fromStdString(key->string()) : QString();
}

QString variant_text(const ParamType& type, const Json& value) {
  const ParamType* form = variant(type, variant_key(type, value));
  if (!form) return typed_text(type, value);
  QStringList parts;
  for (std::size_t i = 1; i < form->parts.size(); ++i) {
    const ParamType& field = form->parts[i];
    const Json* own = value.find(field.name);
    if (!own || (field.fallback && *field.fallback == *own)) continue;
    parts << QString::fromStdString(field.name) + " " + typed_text(field, *own);
  }
  return parts.join(", ");
}

std::optional<Json> variant_of(const ParamType& type, const QString& key, const QString& text, QString* why) {
  const ParamType* form = variant(type, key);
  if (!form) {
    *why = QObject::tr("“%1” is none of the choices.").arg(key);
    return {};
  }
  Json::Object object;
  object[form->parts[0].name] = key.toStdString();
  const auto field_of = [&](const QString& words) {
    return std::find_if(form->parts.begin() + 1, form->parts.end(), [&](const ParamType& one) {
      return QString::fromStdString(one.name) == words.section(' ', 0, 0);
    });
  };
  QStringList said;
  for (const QString& part : parted(text)) {
    const QString words = part.trimmed();
    // What begins with no field's name goes on with the list before it.
    if (!said.isEmpty() && field_of(words) == form->parts.end() && holds_list(*field_of(said.back())))
      said.back() += ", " + words;
    else if (!words.isEmpty())
      said << words;
    if (said.isEmpty() || field_of(said.back()) != form->parts.end()) continue;
    QStringList names;
    for (std::size_t i = 1; i < form->parts.size(); ++i) names << QString::fromStdString(form->parts[i].name);
    *why =
        QObject::tr("%1 has no “%2”; it has %3.").arg(key, said.back().section(' ', 0, 0), names.join(", "));
    return {};
  }
  for (const QString& words : said) {
    const auto field = field_of(words);
    const QString name = words.section(' ', 0, 0), rest = words.section(' ', 1).trimmed();
    const auto value = typed_value(*field, rest, why);
    if (!value) {
      *why = name + ": " + *why;
      return {};
    }
    object[field->name] = *value;
  }
  const Json made(std::move(object));
  for (const Diagnostic& problem : check(*form, made, key.toStdString()))
    if (problem.severity == Severity::error) {
      *why = QString::fromStdString(problem.message);
      return {};
    }
  return made;
}

QString fresh_variant_text(const ParamType& type, const QString& key, const Json& before) {
  const ParamType* form = variant(type, key);
  if (!form) return {};
  Json::Object object;
  object[form->parts[0].name] = key.toStdString();
  for (std::size_t i = 1; i < form->parts.size(); ++i) {
    const ParamType& field = form->parts[i];
    const Json* kept = before.find(field.name);
    if (kept && !has_error(check(field, *kept, field.name)))
      object[field.name] = *kept;
    else if (!field.fallback)
      object[field.name] = begin_of(field);
  }
  return variant_text(type, Json(std::move(object)));
}

}  // namespace kinegraph
