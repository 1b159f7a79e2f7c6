#pragma once

#include <map>
#include <memory>
#include <string>

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner::slurm {

using FrozenPrograms = std::map<std::string, std::shared_ptr<const Program>>;

/// The programs of stages, by name, as JSON and back.
contract::Json to_json(const FrozenPrograms& programs);
FrozenPrograms programs_from(const contract::Json& json);

/// A checked pipeline as JSON and back: what is submitted does not change when its YAML is edited.
contract::Json to_json(const Graph& graph);
Graph graph_from(const contract::Json& json, const FrozenPrograms& programs);

}  // namespace sediment::runner::slurm
