#include "pipeline/runner/commands/opened_config.hpp"

#include <map>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/resolve_sources.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/store/source_content.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;

/// Where the results go and where they are kept.
struct Places {
  fs::path out, store;
};

Places places_of(const Arguments& arguments, const std::string& name) {
  Places places{arguments.out.empty() ? fs::path("out") / name : arguments.out, arguments.store};
  places.out = fs::absolute(places.out).lexically_normal();
  if (!places.out.has_filename()) places.out = places.out.parent_path();
  if (places.store.empty())
    places.store = environment("SEDIMENT_STORE").value_or((places.out / ".sediment").string());
  return places;
}

std::string name_in(const fs::path& config) {
  const fs::path file = pipeline_file_of(config);
  Violations ignored(file);
  return is_sweep(file) ? file.stem().string() : read_pipeline(file, ignored).name;
}

/// Makes instances of one pipeline. Those with the same parameters and the same sources given share their
/// graph.
class Instances {
 public:
  Instances(const PipelineFile& pipeline, const Arguments& arguments, Store& store, Violations& violations)
      : pipeline_(pipeline),
        arguments_(arguments),
        violations_(violations),
        digests_(store.memory(), arguments.rehash),
        programs_(fs::absolute(arguments.stages.empty() ? own_folder() : arguments.stages).lexically_normal(),
                  store.memory(), digests_) {}

  Instance make(const std::vector<Setting>& sources, const std::vector<Setting>& parameters) {
    Instance instance;
    std::vector<Source> resolved = resolve_sources(pipeline_, sources, violations_);
    std::string shared;
    for (const Setting& setting : parameters) shared += setting.name + '=' + setting.value + '\n';
    for (const Source& source : resolved) {
      shared += source.path.empty() ? '0' : '1';
      instance.source_paths.push_back(source.path);
    }
    auto& graph = graphs_[shared];
    if (!graph)
      graph = std::make_shared<const Graph>(
          resolve(pipeline_, parameters, std::move(resolved), programs_, violations_));
    instance.graph = graph;
    return instance;
  }

  /// Reads the sources. Only once nothing is wrong: a mistake should not take a hundred gigabytes to be told.
  void digest(Instance& instance) {
    for (std::size_t i = 0; i < instance.source_paths.size(); ++i) {
      const fs::path& path = instance.source_paths[i];
      std::string& id = ids_[path.native()];
      if (id.empty() && !path.empty()) id = source_id(instance.graph->sources[i].kind, path, digests_);
      instance.source_ids.push_back(id);
    }
    select_stages(instance, arguments_.only, arguments_.from, arguments_.until);
  }

 private:
  const PipelineFile& pipeline_;
  const Arguments& arguments_;
  Violations& violations_;
  FileDigests digests_;
  Programs programs_;
  std::map<std::string, std::shared_ptr<const Graph>> graphs_;
  std::map<std::string, std::string> ids_;
};

}  // namespace

fs::path out_of(const Arguments& arguments) {
  return places_of(arguments, name_in(arguments.config)).out;
}

fs::path store_of(const Arguments& arguments) {
  const std::string name = arguments.config.empty() ? "" : name_in(arguments.config);
  const bool is_said =
      !arguments.store.empty() || !arguments.out.empty() || !name.empty() || environment("SEDIMENT_STORE");
  if (!is_said) throw contract::UsageError("which store? name a pipeline, --out DIR or --store DIR");
  fs::path store = places_of(arguments, name).store;
  if (!fs::exists(store / "VERSION")) throw contract::UsageError(store.string() + " is no store");
  return store;
}

namespace {

/// `--set` goes last: it overrides what the sweep says.
std::vector<Setting> together(const std::vector<Setting>& fixed, const std::vector<Setting>& point,
                              const std::vector<Setting>& said, bool sources) {
  std::vector<Setting> all;
  for (const auto* some : {&fixed, &point, &said})
    for (const Setting& setting : *some)
      if ((setting.name.find('.') == std::string::npos) == sources) all.push_back(setting);
  return all;
}

SweepFile sweep_in(const fs::path& file) {
  Violations violations(file);
  SweepFile sweep;
  if (is_sweep(file)) sweep = read_sweep(file, violations);
  violations.throw_if_any();
  return sweep;
}

}  // namespace

OpenedConfig open_config(const Arguments& arguments) {
  const fs::path file = pipeline_file_of(arguments.config);
  const SweepFile sweep = sweep_in(file);
  const bool sweeps = !sweep.file.empty();
  Violations violations(sweeps ? sweep.pipeline : file);
  const PipelineFile pipeline = read_pipeline(sweeps ? sweep.pipeline : file, violations);
  std::vector<Setting> said;
  for (const std::string& text : arguments.set) said.push_back(setting_from(text));

  OpenedConfig opened;
  const Places places = places_of(arguments, sweeps ? sweep.name : pipeline.name);
  opened.out = places.out;
  opened.store = std::make_shared<Store>(places.store);
  const std::vector<SweepPoint> points = sweeps ? points_of(sweep) : std::vector<SweepPoint>(1);
  check_source_settings(pipeline, together(sweep.set, points.front().sources, said, true), violations);

  Instances instances(pipeline, arguments, *opened.store, violations);
  for (const SweepPoint& point : points) {
    opened.instances.push_back(instances.make(together(sweep.set, point.sources, said, true),
                                              together(sweep.set, point.parameters, said, false)));
    opened.instances.back().name = point.name;
    opened.instances.back().out = point.name.empty() ? places.out : places.out / point.name;
  }
  violations.throw_if_any();
  for (Instance& instance : opened.instances) instances.digest(instance);
  if (sweeps) opened.points = points;
  return opened;
}

}  // namespace sediment::runner
