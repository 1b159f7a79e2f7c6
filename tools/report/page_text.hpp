#pragma once

#include <string_view>

namespace sediment::report {

/// The page without its content: tools/report/web, bundled when this program was built. Empty if it was built
/// without what the bundle needs (scripts/fetch_web.sh).
std::string_view page_text();

}  // namespace sediment::report
