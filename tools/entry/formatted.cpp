#include "tools/entry/formatted.hpp"

#include <cstdarg>
#include <cstdio>

namespace sediment::tools {

std::string formatted(const char* format, ...) {
  char text[256];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

}  // namespace sediment::tools
