#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sediment::contract {

/// Of `known` the name nearest to `name` by edit distance, empty if none is near: for "did you mean".
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace sediment::contract
