#include "pipeline/runner/config/resolve_sources.hpp"

#include <algorithm>

#include "pipeline/contract/description.hpp"
#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/store/source_content.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
namespace kind = contract::kind;

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> all{kind::kSequence,   kind::kMasks, kind::kDynamicMasks,
                                            kind::kTrajectory, kind::kCloud, kind::kOctree,
                                            kind::kGridMap,    kind::kFile};
  return all;
}

const Setting* last_setting(const std::vector<Setting>& settings, const std::string& name) {
  const auto found =
      std::find_if(settings.rbegin(), settings.rend(), [&](const Setting& one) { return one.name == name; });
  return found == settings.rend() ? nullptr : &*found;
}

std::string unset_message(const SourceEntry& entry, const std::vector<std::string>& unset) {
  std::string text = "source " + entry.name + ": ";
  for (const std::string& name : unset) text += "${" + name + "} is not set; ";
  return text + "set it in the environment or give --set " + entry.name + "=PATH";
}

/// The path as given, empty if there is none.
fs::path given_path(const SourceEntry& entry, const PipelineFile& pipeline,
                    const std::vector<Setting>& settings, Violations& violations) {
  if (const Setting* set = last_setting(settings, entry.name)) return set->value;
  const Expansion expansion = expand(entry.path, environment);
  if (!expansion.unset.empty()) {
    if (!entry.optional) violations.add(entry.line, unset_message(entry, expansion.unset));
    return {};
  }
  return begins_with_variable(entry.path) ? fs::path(expansion.text)
                                          : fs::absolute(pipeline.file).parent_path() / expansion.text;
}

}  // namespace

void check_source_settings(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                           Violations& violations) {
  std::vector<std::string> names;
  for (const SourceEntry& entry : pipeline.sources) names.push_back(entry.name);
  for (const Setting& setting : settings)
    if (setting.name.find('.') == std::string::npos &&
        std::find(names.begin(), names.end(), setting.name) == names.end())
      violations.add_call(setting.text() + ": unknown source \"" + setting.name + "\"" +
                          did_you_mean(setting.name, names) +
                          "; parameters are set as stage.parameter=value");
}

std::vector<Source> resolve_sources(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                                    Violations& violations) {
  std::vector<Source> sources;
  for (const SourceEntry& entry : pipeline.sources) {
    const auto& all = kinds();
    if (!entry.kind.empty() && std::find(all.begin(), all.end(), entry.kind) == all.end())
      violations.add(entry.line, "source " + entry.name + ": unknown kind \"" + entry.kind + "\"" +
                                     did_you_mean(entry.kind, all));
    if (entry.name.find('.') != std::string::npos)
      violations.add(entry.line, "source " + entry.name + ": the name of a source has no dot");
    Source source{entry.name, entry.kind, {}};
    try {
      const fs::path given = given_path(entry, pipeline, settings, violations);
      if (!given.empty()) source.path = source_path(entry.kind, given);
    } catch (const contract::UsageError& error) {
      violations.add(entry.line, "source " + entry.name + ": " + error.what());
    }
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace sediment::runner
