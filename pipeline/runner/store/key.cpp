#include "pipeline/runner/store/key.hpp"

#include "pipeline/contract/digest.hpp"

namespace sediment::runner {
namespace {

using contract::Json;

constexpr const char* kKeyFormat = "sediment-key 1";
constexpr std::size_t kShortId = 11;  ///< "x3:" and eight digits

std::string shown(const Json& value) {
  if (value.is_null()) return "none";
  if (value == "") return "\"\"";
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  return text.starts_with("x3:") ? text.substr(0, kShortId) : text;
}

/// A list of [name, value] pairs as an object.
Json by_name(const Json& pairs) {
  Json object = Json::object();
  for (const Json& pair : pairs) object[pair.at(0).get<std::string>()] = pair.at(1);
  return object;
}

void compare_named(const std::string& group, const Json& before, const Json& after,
                   std::vector<Difference>& all) {
  for (const auto& [name, value] : before.items()) {
    const Json now = after.value(name, Json());
    if (now != value) all.push_back({group + '/' + name, shown(value), shown(now)});
  }
  for (const auto& [name, value] : after.items())
    if (!before.contains(name)) all.push_back({group + '/' + name, shown(Json()), shown(value)});
}

}  // namespace

KeyWords::KeyWords(const PlannedStage& stage) {
  const contract::Description& description = stage.program->description;
  Json params = Json::object(), outputs = Json::array();
  for (const contract::Parameter& parameter : description.parameters)
    if (parameter.affects_result) params[parameter.name] = stage.params.at(parameter.name);
  for (const contract::Port& port : description.writes) outputs.push_back({port.role, port.kind});
  before_ = "{\"exe\":" + Json(stage.exe).dump() + ",\"format\":" + Json(kKeyFormat).dump() + ",\"inputs\":[";
  for (const Input& input : stage.inputs)
    roles_.push_back((roles_.empty() ? "[" : ",[") + Json(input.role).dump() + ",\"");
  after_ = "],\"outputs\":" + outputs.dump() + ",\"params\":" + params.dump() +
           ",\"stage\":" + Json(stage.name).dump() + '}';
}

Key KeyWords::key(const std::vector<std::string>& input_ids) const {
  Key key{before_, ""};
  for (std::size_t i = 0; i < input_ids.size(); ++i)
    key.text.append(roles_[i]).append(input_ids[i]).append("\"]");
  key.text += after_;
  key.id = contract::digest_bytes(key.text);
  return key;
}

Key key_of(const PlannedStage& stage, const std::vector<std::string>& input_ids) {
  return KeyWords(stage).key(input_ids);
}

std::vector<Difference> differences(const Json& before, const Json& after) {
  std::vector<Difference> all;
  for (const char* part : {"format", "stage", "exe"})
    if (before.at(part) != after.at(part))
      all.push_back({part, shown(before.at(part)), shown(after.at(part))});
  compare_named("params", before.at("params"), after.at("params"), all);
  compare_named("inputs", by_name(before.at("inputs")), by_name(after.at("inputs")), all);
  compare_named("outputs", by_name(before.at("outputs")), by_name(after.at("outputs")), all);
  return all;
}

std::string in_short(const std::vector<Difference>& all) {
  if (all.empty()) return "";
  const Difference& first = all.front();
  std::string text = first.part == "exe"                 ? "the program changed"
                     : first.part.starts_with("params/") ? first.text().substr(7)
                     : first.part.starts_with("inputs/") ? first.part.substr(7) + " changed"
                                                         : first.text();
  return all.size() == 1 ? text : text + ", and " + std::to_string(all.size() - 1) + " more";
}

}  // namespace sediment::runner
