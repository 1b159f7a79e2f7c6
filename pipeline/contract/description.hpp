#pragma once

#include <string>
#include <vector>

#include "pipeline/contract/nearest_name.hpp"
#include "pipeline/contract/parameter.hpp"

namespace sediment::contract {

/// Kinds of artifacts, by the name used in YAML. One kind is one folder format
/// (pipeline/artifacts/README.md); "file" is any file or folder that a stage takes as it is (a network, masks
/// of the user's own).
namespace kind {
inline constexpr const char* kSequence = "sequence";
inline constexpr const char* kMasks = "masks";
inline constexpr const char* kDynamicMasks = "dynamic-masks";
inline constexpr const char* kTrajectory = "trajectory";
inline constexpr const char* kCloud = "cloud";
inline constexpr const char* kOctree = "octree";
inline constexpr const char* kGridMap = "grid-map";
inline constexpr const char* kFile = "file";
}  // namespace kind

/// An input or an output of a stage.
struct Port {
  std::string role;  ///< the flag is --role
  std::string kind;
  bool optional = false;
  std::string help;
};

/// What a stage promises; `STAGE --describe` prints it as JSON.
struct Description {
  std::string stage;
  std::string version;
  std::string summary;
  std::vector<Port> reads;
  std::vector<Port> writes;
  std::vector<Parameter> parameters;

  const Port* find_input(std::string_view role) const;
  const Port* find_output(std::string_view role) const;
  const Parameter* find_parameter(std::string_view name) const;
};

Json to_json(const Description& description);
/// Throws std::runtime_error if the JSON is not a description.
Description description_from(const Json& json);

}  // namespace sediment::contract
