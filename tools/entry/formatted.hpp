#pragma once

#include <string>

namespace sediment::tools {

/// What printf would print, up to 255 characters: a field of a text report.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace sediment::tools
