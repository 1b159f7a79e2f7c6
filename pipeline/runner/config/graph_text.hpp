#pragma once

#include <string>

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// The pipeline as "text", "mermaid" or "dot".
std::string graph_text(const Graph& graph, const std::string& format);

/// {"sources": [{name, kind, path}], "stages": [{name, params, reads: {role: producer}}]}
contract::Json graph_json(const Graph& graph);

}  // namespace sediment::runner
