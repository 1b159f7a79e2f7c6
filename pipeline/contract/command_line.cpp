#include "pipeline/contract/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "pipeline/contract/errors.hpp"

namespace sediment::contract {
namespace {

std::string flag_of(const std::string& name) {
  std::string kebab = name;
  std::replace(kebab.begin(), kebab.end(), '_', '-');
  return kebab == name ? "--" + name : "--" + kebab + ",--" + name;
}

std::string default_text(const Parameter& parameter) {
  const Json& value = parameter.default_value;
  if (value.is_string()) return value.get<std::string>().empty() ? "\"\"" : value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : ",") + item.get<std::string>();
  return text.empty() ? "none" : text;
}

std::string help_of(const Parameter& parameter) {
  std::string text = parameter.help + " [" + default_text(parameter) + "]";
  for (std::size_t i = 0; i < parameter.choices.size(); ++i)
    text += (i == 0 ? " {" : "|") + parameter.choices[i];
  return parameter.choices.empty() ? text : text + "}";
}

/// The known flags, to name the nearest one to a mistyped flag.
std::string suggestion(const Description& description, const CLI::App& app) {
  std::vector<std::string> known{"--out", "--threads", "--help", "--describe"};
  for (const Port& port : description.reads) known.push_back("--" + port.role);
  for (const Parameter& parameter : description.parameters)
    known.push_back(flag_of(parameter.name).substr(0, flag_of(parameter.name).find(',')));
  for (const std::string& extra : app.remaining()) {
    const std::string nearest = nearest_name(extra.substr(0, extra.find('=')), known);
    return "unknown argument " + extra + (nearest.empty() ? "" : " (did you mean " + nearest + "?)");
  }
  return {};
}

}  // namespace

std::optional<Call> parse_call(const Description& description, int argc, char** argv) {
  CLI::App app(description.summary, description.stage);
  app.allow_extras();
  app.get_formatter()->column_width(36);
  bool describe = false;
  app.add_flag("--describe", describe, "Print what this stage reads, writes and tunes, as JSON");
  app.set_version_flag("--version", description.version);

  Call call;
  std::map<std::string, std::string> inputs, values;
  std::string out;
  for (const Port& port : description.reads)
    app.add_option("--" + port.role, inputs[port.role], port.help + (port.optional ? " (optional)" : ""))
        ->type_name("PATH:" + port.kind)
        ->group("Reads");
  app.add_option("--out", out, "Folder of the result; it appears whole or not at all")
      ->type_name("DIR")
      ->group("Writes");
  for (const Parameter& parameter : description.parameters)
    app.add_option(flag_of(parameter.name), values[parameter.name], help_of(parameter))
        ->type_name(std::string(name_of(parameter.type)))
        ->group("Tunes");
  app.add_option("--threads", call.threads, "Threads to use, 0 = all; never changes the result [0]")
      ->check(CLI::Range(0, 1024))
      ->type_name("integer");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return std::nullopt;
  } catch (const CLI::CallForVersion&) {
    std::cout << description.version << '\n';
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  if (describe) {
    std::cout << to_json(description).dump(1) << '\n';
    return std::nullopt;
  }
  if (!app.remaining().empty()) throw UsageError(suggestion(description, app));
  for (const Port& port : description.reads) {
    if (!inputs[port.role].empty())
      call.inputs[port.role] = inputs[port.role];
    else if (!port.optional)
      throw UsageError("--" + port.role + " is required: " + port.help);
  }
  if (out.empty()) throw UsageError("--out is required: the folder of the result");
  call.out = out;
  for (const Parameter& parameter : description.parameters)
    if (app.count(flag_of(parameter.name).substr(0, flag_of(parameter.name).find(','))) > 0)
      call.values[parameter.name] = parse(parameter, values[parameter.name]);
  return call;
}

}  // namespace sediment::contract
