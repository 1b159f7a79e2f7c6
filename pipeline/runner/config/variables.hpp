#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sediment::runner {

/// `${NAME}` in a YAML text. Braces would end a plain scalar of a flow mapping ({path: ${SEQUENCE}}), and a
/// value put in before parsing could change the structure of the document. So each variable is first replaced
/// by a mark that YAML reads as an ordinary word, and the scalars are expanded after parsing. Lines stay
/// where they are.
std::string mark_variables(const std::string& yaml_text);

/// The value of a variable; nothing if it is not set.
using Lookup = std::function<std::optional<std::string>(const std::string& name)>;

struct Expansion {
  std::string text;
  std::vector<std::string> unset;  ///< variables without a value
};

/// A scalar with its marks replaced by values.
Expansion expand(const std::string& scalar, const Lookup& lookup);

/// Whether the scalar begins with a variable.
bool begins_with_variable(const std::string& scalar);

/// The environment of this program. An empty variable counts as not set.
std::optional<std::string> environment(const std::string& name);

}  // namespace sediment::runner
