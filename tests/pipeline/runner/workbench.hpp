#pragma once

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace sediment::test {

struct Outcome {
  int code;
  std::string out, err;
};

/// A folder with fake stages (stages/), a pipeline of them (pipeline.yaml: scan -> smooth -> thin -> chart),
/// a sequence (data/sequence.yaml) and a results folder (out/).
class Workbench {
 public:
  Workbench();

  std::filesystem::path operator/(const std::filesystem::path& name) const { return folder_ / name; }
  /// `sediment FLAGS` in the folder, with SEQUENCE set.
  Outcome sediment(const std::string& flags) const;
  /// `sediment run pipeline.yaml --out out --stages stages FLAGS`.
  Outcome run(const std::string& flags = "") const;
  /// The same for another command: "plan", "why", ...
  Outcome call(const std::string& command, const std::string& flags = "") const;
  /// Any shell command in the folder.
  Outcome shell(const std::string& command) const;
  void write(const std::filesystem::path& name, const std::string& text) const;
  std::string read(const std::filesystem::path& name) const;
  /// The stages that were started since the last call, in order, from the diaries that `noted()` asks for.
  std::string started() const;
  /// Flags that make every stage write a diary.
  std::string noted() const;

 private:
  TemporaryFolder folder_;
};

inline constexpr const char* kPipeline = R"(sources:
  sequence: {kind: sequence, path: ${SEQUENCE}}
  model: {kind: file, path: "${MODEL}", optional: true}
stages:
  scan: {reads: {sequence: sequence, model: model}}
  smooth: {reads: {cloud: scan.cloud}}
  thin: {reads: {cloud: smooth.cloud}, params: {factor: 0.25}}
  chart: {reads: {cloud: thin.cloud, second: smooth.cloud}}
)";

}  // namespace sediment::test
