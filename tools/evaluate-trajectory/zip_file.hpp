#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sediment::tools {

/// A ZIP archive of files that are stored as they are, without times: equal files give equal bytes. For
/// archives of less than 4 GiB.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace sediment::tools
