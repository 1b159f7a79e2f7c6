#include "pipeline/contract/stage.hpp"

#include <tbb/global_control.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "pipeline/contract/command_line.hpp"
#include "pipeline/contract/manifest.hpp"

namespace sediment::contract {
namespace {

namespace fs = std::filesystem;

/// The folder must be absent, empty or an earlier result of ours: nothing else is ever replaced.
void check_replaceable(const fs::path& out) {
  if (!fs::exists(out) && !fs::is_symlink(out)) return;
  if (fs::is_directory(out) && (fs::is_empty(out) || fs::exists(out / kManifestName))) return;
  throw UsageError(out.string() +
                   " exists and is no result of a stage (it has no manifest.json): name another --out");
}

void write_metrics(const Json& metrics, const fs::path& folder) {
  std::ofstream stream(folder / "metrics.json", std::ios::binary);
  stream << metrics.dump(1) << '\n';
  stream.close();
  if (!stream)
    throw std::runtime_error("cannot write " + (folder / "metrics.json").string() + ": " +
                             std::strerror(errno));
}

/// Puts the finished folder in the place of `out`. An earlier result steps aside first, so that at no moment
/// a mixture of both can be seen.
void publish(const fs::path& partial, const fs::path& out) {
  const fs::path aside = out.string() + ".replaced";
  fs::remove_all(aside);
  if (fs::exists(out)) fs::rename(out, aside);
  fs::rename(partial, out);
  fs::remove_all(aside);
}

fs::path without_trailing_slash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

Stage::Stage(std::string name, std::string summary) {
  description_.stage = std::move(name);
  description_.version = SEDIMENT_VERSION;
  description_.summary = std::move(summary);
}

void Stage::reads(std::string role, std::string kind, std::string help) {
  description_.reads.push_back({std::move(role), std::move(kind), false, std::move(help)});
}

void Stage::reads_optional(std::string role, std::string kind, std::string help) {
  description_.reads.push_back({std::move(role), std::move(kind), true, std::move(help)});
}

void Stage::writes(std::string role, std::string kind, std::string help) {
  description_.writes.push_back({std::move(role), std::move(kind), false, std::move(help)});
}

void Stage::tunes(std::string name, bool& value, std::string help) {
  add({std::move(name), ParameterType::boolean, Json(value), {}, {}, std::move(help)},
      [&value](const Json& json) { value = json.get<bool>(); });
}

void Stage::tunes(std::string name, std::string& value, std::string help) {
  add({std::move(name), ParameterType::text, Json(value), {}, {}, std::move(help)},
      [&value](const Json& json) { value = json.get<std::string>(); });
}

void Stage::tunes(std::string name, std::vector<std::string>& value, std::string help) {
  add({std::move(name), ParameterType::list, Json(value), {}, {}, std::move(help)},
      [&value](const Json& json) { value = json.get<std::vector<std::string>>(); });
}

void Stage::add(Parameter parameter, std::function<void(const Json&)> assign) {
  parameter.default_value = canonical(parameter, parameter.default_value);
  description_.parameters.push_back(std::move(parameter));
  assign_.push_back(std::move(assign));
}

int Stage::run(int argc, char** argv, const std::function<void(Work&)>& body) try {
  const auto call = parse_call(description_, argc, argv);
  if (!call) return kDone;
  for (const auto& [role, path] : call->inputs)
    if (!fs::exists(path)) throw UsageError("--" + role + ": " + path.string() + " does not exist");
  for (std::size_t i = 0; i < assign_.size(); ++i)
    if (const auto given = call->values.find(description_.parameters[i].name); given != call->values.end())
      assign_[i](given->second);

  const fs::path out = without_trailing_slash(call->out);
  check_replaceable(out);
  const fs::path partial = out.string() + ".partial";
  fs::remove_all(partial);
  fs::create_directories(partial);

  const int threads =
      call->threads > 0 ? call->threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  Work work(call->inputs, partial, threads);
  body(work);
  write_metrics(work.metrics(), partial);
  write_manifest(manifest_of(partial, description_.stage), partial);
  publish(partial, out);
  return kDone;
} catch (const UsageError& error) {
  std::cerr << description_.stage << ": " << error.what() << "\n(" << description_.stage
            << " --help explains)\n";
  return kWrongCall;
} catch (const std::exception& error) {
  std::cerr << description_.stage << ": " << error.what() << '\n';
  return kFailed;
}

}  // namespace sediment::contract
