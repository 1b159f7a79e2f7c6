#include "pipeline/runner/commands/opened_pipeline.hpp"

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/store/source_content.hpp"

namespace sediment::runner {

namespace fs = std::filesystem;

Places places_of(const Arguments& arguments, const std::string& pipeline_name) {
  Places places{arguments.out.empty() ? fs::path("out") / pipeline_name : arguments.out, arguments.store};
  places.out = fs::absolute(places.out).lexically_normal();
  if (!places.out.has_filename()) places.out = places.out.parent_path();
  if (places.store.empty())
    places.store = environment("SEDIMENT_STORE").value_or((places.out / ".sediment").string());
  return places;
}

fs::path store_of(const Arguments& arguments) {
  std::string name;
  if (!arguments.config.empty()) {
    const fs::path file = pipeline_file_of(arguments.config);
    Violations ignored(file);
    name = read_pipeline(file, ignored).name;
  }
  const bool is_said =
      !arguments.store.empty() || !arguments.out.empty() || !name.empty() || environment("SEDIMENT_STORE");
  if (!is_said) throw contract::UsageError("which store? name a pipeline, --out DIR or --store DIR");
  fs::path store = places_of(arguments, name).store;
  if (!fs::exists(store / "VERSION")) throw contract::UsageError(store.string() + " is no store");
  return store;
}

OpenedPipeline open_pipeline(const Arguments& arguments) {
  OpenedPipeline opened;
  opened.file = pipeline_file_of(arguments.config);
  Violations violations(opened.file);
  const PipelineFile file = read_pipeline(opened.file, violations);
  const Places places = places_of(arguments, file.name);
  opened.store = std::make_shared<Store>(places.store);

  StatMemory& memory = opened.store->memory();
  FileDigests digests(memory, arguments.rehash);
  Programs programs(
      fs::absolute(arguments.stages.empty() ? own_folder() : arguments.stages).lexically_normal(), memory,
      digests);
  std::vector<Setting> settings;
  for (const std::string& text : arguments.set) settings.push_back(setting_from(text));
  auto graph = std::make_shared<Graph>(resolve(file, settings, programs, violations));
  violations.throw_if_any();

  Instance& instance = opened.instance;
  instance.out = places.out;
  for (const Source& source : graph->sources)
    instance.source_ids.push_back(source.path.empty() ? "" : source_id(source.kind, source.path, digests));
  instance.graph = std::move(graph);
  select_stages(instance, arguments.only, arguments.from, arguments.until);
  return opened;
}

}  // namespace sediment::runner
