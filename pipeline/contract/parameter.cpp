#include "pipeline/contract/parameter.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pipeline/contract/errors.hpp"

namespace sediment::contract {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// "a whole number in 1 .. 100": what the parameter takes.
std::string expectation(const Parameter& parameter) {
  const auto bound = [&](double value) {
    return parameter.type == ParameterType::integer ? std::to_string(static_cast<std::int64_t>(value))
                                                    : Json(value).dump();
  };
  const bool low = std::isfinite(parameter.range.min), high = std::isfinite(parameter.range.max);
  std::string range;
  if (low && high) range = " in " + bound(parameter.range.min) + " .. " + bound(parameter.range.max);
  if (low && !high) range = " of at least " + bound(parameter.range.min);
  if (!low && high) range = " of at most " + bound(parameter.range.max);
  switch (parameter.type) {
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::integer:
      return "a whole number" + range;
    case ParameterType::number:
      return "a number" + range;
    case ParameterType::text:
      return "a text";
    case ParameterType::choice:
      return "one of " + joined(parameter.choices);
    case ParameterType::list:
      return "a list of texts";
  }
  return {};
}

[[noreturn]] void refuse(const Parameter& parameter, const std::string& found) {
  throw UsageError(parameter.name + ": expected " + expectation(parameter) + ", found " + found);
}

Json canonical_number(const Parameter& parameter, const Json& value) {
  double number = value.get<double>();
  if (!std::isfinite(number) || number < parameter.range.min || number > parameter.range.max)
    refuse(parameter, value.dump());
  if (parameter.type == ParameterType::number) return number == 0 ? 0.0 : number;
  if (number != std::floor(number)) refuse(parameter, value.dump());
  return value.is_number_integer() ? value : Json(static_cast<std::int64_t>(number));
}

/// The whole text as a number, or refuses.
template <class Number>
Number number_from(const Parameter& parameter, std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    refuse(parameter, '"' + std::string(text) + '"');
  return number;
}

Json list_from(std::string_view text) {
  Json list = Json::array();
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    std::string item(text.substr(0, comma));
    item.erase(0, item.find_first_not_of(' '));
    item.erase(item.find_last_not_of(' ') + 1);
    if (!item.empty()) list.push_back(item);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return list;
}

}  // namespace

std::string_view name_of(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return "boolean";
    case ParameterType::integer:
      return "integer";
    case ParameterType::number:
      return "number";
    case ParameterType::text:
      return "text";
    case ParameterType::choice:
      return "choice";
    case ParameterType::list:
      return "list";
  }
  return "";
}

Json canonical(const Parameter& parameter, const Json& value) {
  switch (parameter.type) {
    case ParameterType::boolean:
      if (!value.is_boolean()) refuse(parameter, value.dump());
      return value;
    case ParameterType::integer:
    case ParameterType::number:
      if (!value.is_number()) refuse(parameter, value.dump());
      return canonical_number(parameter, value);
    case ParameterType::text:
      if (!value.is_string()) refuse(parameter, value.dump());
      return value;
    case ParameterType::choice:
      if (!value.is_string() || std::find(parameter.choices.begin(), parameter.choices.end(),
                                          value.get<std::string>()) == parameter.choices.end())
        refuse(parameter, value.dump());
      return value;
    case ParameterType::list:
      if (!value.is_array() ||
          !std::all_of(value.begin(), value.end(), [](const Json& j) { return j.is_string(); }))
        refuse(parameter, value.dump());
      return value;
  }
  return value;
}

Json parse(const Parameter& parameter, std::string_view text) {
  switch (parameter.type) {
    case ParameterType::boolean:
      if (text == "true" || text == "on" || text == "yes" || text == "1") return true;
      if (text == "false" || text == "off" || text == "no" || text == "0") return false;
      refuse(parameter, '"' + std::string(text) + '"');
    case ParameterType::integer:
      return canonical(parameter, number_from<std::int64_t>(parameter, text));
    case ParameterType::number:
      return canonical(parameter, number_from<double>(parameter, text));
    case ParameterType::list:
      return canonical(parameter, list_from(text));
    case ParameterType::text:
    case ParameterType::choice:
      return canonical(parameter, std::string(text));
  }
  return {};
}

}  // namespace sediment::contract
