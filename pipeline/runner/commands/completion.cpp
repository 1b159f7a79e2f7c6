#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/config/pipeline_file.hpp"
#include "pipeline/runner/config/program.hpp"
#include "pipeline/runner/store/stat_memory.hpp"
#include "pipeline/runner/sweep/sweep_file.hpp"

namespace sediment::runner {
namespace {

/// Asks the tables below; what depends on a pipeline it asks `sediment completion` itself.
constexpr const char* kScript = R"bash(_sediment() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command='' config='' place=0 i wanted
  COMPREPLY=()
  # bash parts words at "=": --flag = value
  if [[ $cur == = ]]; then cur=''
  elif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    local word=${COMP_WORDS[i]}
    if [[ -z $command ]]; then [[ $word == -* ]] || command=$word
    elif [[ $word == -* ]]; then
      if [[ -n $(_sediment_value "$command" "$word") ]]; then
        [[ ${COMP_WORDS[i+1]-} != = ]] || ((++i))
        ((++i))
        # name=value of a --set
        [[ ${COMP_WORDS[i+1]-} != = ]] || ((i += 2))
      fi
    else
      ((++place == 1)) && config=$word
    fi
  done
  if [[ -z $command ]]; then wanted="words $(_sediment_commands)"
  elif [[ $prev == -* && -n $(_sediment_value "$command" "$prev") ]]; then wanted=$(_sediment_value "$command" "$prev")
  elif [[ $cur == -* ]]; then wanted="words $(_sediment_flags "$command")"
  else wanted=$(_sediment_place "$command" "$((place + 1))"); fi
  case $wanted in
    files) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- "$cur") ;;
    folders) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "$cur") ;;
    stages) mapfile -t COMPREPLY < <(compgen -W "$(sediment completion stages "$config" 2>/dev/null)" -- "$cur") ;;
    settings)
      compopt -o nospace
      mapfile -t COMPREPLY < <(compgen -W "$(sediment completion settings "$config" 2>/dev/null)" -- "$cur") ;;
    words*) mapfile -t COMPREPLY < <(compgen -W "${wanted#words }" -- "$cur") ;;
  esac
}
complete -F _sediment sediment
)bash";

/// What can stand for a value: "files", "folders", "stages", "settings", "words a b c", or "any".
std::string wanted_by(const CLI::Option& option) {
  const std::string type = option.get_type_name(), name = option.get_name(true);
  const std::size_t choices = type.find('{');
  if (choices != std::string::npos) {
    std::string words = type.substr(choices + 1, type.find('}') - choices - 1);
    std::replace(words.begin(), words.end(), ',', ' ');
    return "words " + words;
  }
  if (type == "DIR" || name == "folder" || name == "other") return "folders";
  if (type == "STAGE" || name == "stage") return "stages";
  if (!option.get_lnames().empty() && option.get_lnames().front() == "set") return "settings";
  return type == "CONFIG" || name == "config" ? "files" : "any";
}

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

std::string in_one(const std::vector<std::string>& words, const char* separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// Three functions of bash: the flags of a command, what the value of a flag can be, and what stands at a
/// place.
void print_tables(const CLI::App& app) {
  std::vector<std::string> names;
  std::string flags, values, places;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    std::vector<std::string> known;
    int place = 0;
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) {
        places += fmt::format("    {}.{}) echo '{}' ;;\n", names.back(), ++place, wanted_by(*option));
        continue;
      }
      const std::vector<std::string> own = flags_of(*option);
      known.insert(known.end(), own.begin(), own.end());
      if (option->get_items_expected_max() == 0) continue;
      for (const std::string& flag : own)
        values += fmt::format("    {}.{}) echo '{}' ;;\n", names.back(), flag, wanted_by(*option));
    }
    flags += fmt::format("    {}) echo '{}' ;;\n", names.back(), in_one(known, " "));
  }
  fmt::print("_sediment_commands() {{ echo '{}'; }}\n", in_one(names, " "));
  fmt::print("_sediment_flags() {{\n  case $1 in\n{}  esac\n}}\n", flags);
  fmt::print("_sediment_value() {{\n  case $1.$2 in\n{}  esac\n}}\n", values);
  fmt::print("_sediment_place() {{\n  case $1.$2 in\n{}  esac\n}}\n", places);
}

/// The pipeline that a file is or varies.
PipelineFile pipeline_in(const std::filesystem::path& config) {
  const std::filesystem::path file = pipeline_file_of(config);
  Violations ignored(file);
  return read_pipeline(is_sweep(file) ? read_sweep(file, ignored).pipeline : file, ignored);
}

void print_settings(const PipelineFile& pipeline) {
  for (const SourceEntry& source : pipeline.sources) fmt::print("{}=\n", source.name);
  StatMemory memory("");
  FileDigests digests(memory, false);
  Programs programs(own_folder(), memory, digests);
  for (const StageEntry& stage : pipeline.stages)
    for (const contract::Parameter& parameter : programs.find(stage.name)->description.parameters)
      fmt::print("{}.{}=\n", stage.name, parameter.name);
}

}  // namespace

int print_completion(const Arguments& arguments) {
  if (arguments.what == "bash") {
    CLI::App app;
    Arguments ignored;
    declare_commands(app, ignored);
    fmt::print("# Completion of sediment: source <(sediment completion bash)\n");
    print_tables(app);
    fmt::print("{}", kScript);
    return contract::kDone;
  }
  const PipelineFile pipeline = pipeline_in(arguments.config);
  if (arguments.what == "settings")
    print_settings(pipeline);
  else
    for (const StageEntry& stage : pipeline.stages) fmt::print("{}\n", stage.name);
  return contract::kDone;
}

}  // namespace sediment::runner
