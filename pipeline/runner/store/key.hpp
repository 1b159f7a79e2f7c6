#pragma once

#include <string>
#include <vector>

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// The fingerprint of a result, as named parts in clear: {"format", "stage", "exe", "params", "inputs",
/// "outputs"}. Never in it: paths, times, host, environment.
struct Key {
  std::string text;  ///< canonical JSON of the parts (names sorted, no spaces)
  std::string id;    ///< "x3:..." of the text
};

/// The key of a stage with the content ids of its inputs left open: what thousands of instances share is put
/// into words once.
class KeyWords {
 public:
  explicit KeyWords(const PlannedStage& stage);
  /// `input_ids`: one for each of the stage's inputs, in their order.
  Key key(const std::vector<std::string>& input_ids) const;

 private:
  std::string before_, after_;
  std::vector<std::string> roles_;
};

/// The key of a stage, given the content id of each of its inputs in their order.
Key key_of(const PlannedStage& stage, const std::vector<std::string>& input_ids);

/// One part in which two keys differ: "params/neighbors: 50 -> 30".
struct Difference {
  std::string part;
  std::string before, after;
  std::string text() const { return part + ": " + before + " -> " + after; }
};

/// The parts of two keys that differ, in the order stage, exe, params, inputs, outputs.
std::vector<Difference> differences(const contract::Json& before, const contract::Json& after);

/// The differences in a few words: "neighbors: 50 -> 30, and 2 more".
std::string in_short(const std::vector<Difference>& all);

}  // namespace sediment::runner
