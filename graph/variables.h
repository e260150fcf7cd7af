// Variables, "${name}", in parameters.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "graph/diagnostic.h"
#include "graph/json.h"
#include "graph/param.h"

namespace kinegraph {

struct Variables {
  // With --var: before all files. A string stands as it was typed and is read as the parameter's type asks.
  std::map<std::string, Json> given;
  // Of the files, outermost first. They outlive this.
  std::vector<const std::map<std::string, Json, std::less<>>*> files;
  // `${item}` and `${index}` in a path that is written stay as they are, for a batch to fill in.
  bool batch_fills_in = false;

  const Json* find(std::string_view name) const;
  std::vector<std::string> names() const;
};

// "name" of a text that is "${name}" and nothing else, or "".
std::string_view whole_variable(std::string_view text);
// Names of all variables that stand in `value` as a `type`, in the order they stand there.
std::vector<std::string> variables_in(const Json& value, const ParamType& type);

// `value` with its variables replaced: where a whole value is "${name}", also of an element or a field, and inside
// paths. "$${" becomes "${". Elsewhere inside a text a variable has no meaning; that is a warning
// ("variable-not-replaced"). Errors: "undefined-variable", "bad-variable" (in a path: "${" without a name, or a variable
// that is no text or number), "bad-value" (given text that the type can't read). `where` is the parameter.
Json substituted(const Json& value, const ParamType& type, const Variables& variables, const std::string& where,
                 Diagnostics& problems);

}  // namespace kinegraph
