#pragma once

#include <string>

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// The pipeline as "text", "mermaid" or "dot".
std::string graph_text(const Graph& graph, const std::string& format);

}  // namespace sediment::runner
