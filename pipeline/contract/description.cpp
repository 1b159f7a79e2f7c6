#include "pipeline/contract/description.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sediment::contract {
namespace {

constexpr const char* kStageFormat = "sediment-stage 1";

Json to_json(const Port& port) {
  return {{"role", port.role}, {"kind", port.kind}, {"optional", port.optional}, {"help", port.help}};
}

Port port_from(const Json& json) {
  return {json.at("role"), json.at("kind"), json.at("optional"), json.at("help")};
}

Json to_json(const Parameter& parameter) {
  Json json = {{"name", parameter.name},
               {"type", name_of(parameter.type)},
               {"default", parameter.default_value},
               {"help", parameter.help},
               {"affects_result", parameter.affects_result}};
  if (std::isfinite(parameter.range.min)) json["min"] = parameter.range.min;
  if (std::isfinite(parameter.range.max)) json["max"] = parameter.range.max;
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  return json;
}

ParameterType type_from(const std::string& name) {
  for (const auto type : {ParameterType::boolean, ParameterType::integer, ParameterType::number,
                          ParameterType::text, ParameterType::choice, ParameterType::list})
    if (name_of(type) == name) return type;
  throw std::runtime_error("unknown parameter type \"" + name + "\"");
}

Parameter parameter_from(const Json& json) {
  Parameter parameter;
  parameter.name = json.at("name");
  parameter.type = type_from(json.at("type"));
  parameter.default_value = json.at("default");
  parameter.help = json.at("help");
  parameter.affects_result = json.at("affects_result");
  parameter.range.min = json.value("min", parameter.range.min);
  parameter.range.max = json.value("max", parameter.range.max);
  parameter.choices = json.value("choices", parameter.choices);
  return parameter;
}

template <class T, class Key>
const T* find_in(const std::vector<T>& all, std::string_view wanted, Key key) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.*key == wanted; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

const Port* Description::find_input(std::string_view role) const {
  return find_in(reads, role, &Port::role);
}
const Port* Description::find_output(std::string_view role) const {
  return find_in(writes, role, &Port::role);
}
const Parameter* Description::find_parameter(std::string_view name) const {
  return find_in(parameters, name, &Parameter::name);
}

Json to_json(const Description& description) {
  Json json = {{"format", kStageFormat},         {"stage", description.stage},
               {"version", description.version}, {"summary", description.summary},
               {"reads", Json::array()},         {"writes", Json::array()},
               {"parameters", Json::array()}};
  for (const Port& port : description.reads) json["reads"].push_back(to_json(port));
  for (const Port& port : description.writes) json["writes"].push_back(to_json(port));
  for (const Parameter& parameter : description.parameters) json["parameters"].push_back(to_json(parameter));
  return json;
}

Description description_from(const Json& json) {
  try {
    if (json.at("format") != kStageFormat)
      throw std::runtime_error("unknown format " + json.at("format").dump());
    Description description{json.at("stage"), json.at("version"), json.at("summary"), {}, {}, {}};
    for (const Json& port : json.at("reads")) description.reads.push_back(port_from(port));
    for (const Json& port : json.at("writes")) description.writes.push_back(port_from(port));
    for (const Json& parameter : json.at("parameters"))
      description.parameters.push_back(parameter_from(parameter));
    return description;
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("not the description of a stage: ") + error.what());
  }
}

}  // namespace sediment::contract
