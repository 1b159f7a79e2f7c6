#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/progress.hpp"
#include "tools/synthesize/sequence_writer.hpp"

using namespace sediment;

namespace {

std::string scene_list() {
  std::string text = "Scenes:\n";
  for (const auto& title : synthetic::titles())
    text += "  " + title.name + std::string(14 - title.name.size(), ' ') + title.summary + "\n";
  return text;
}

/// The path without a slash at its end.
std::string folder_name(const std::filesystem::path& path) {
  return path.has_filename() ? path.string() : path.parent_path().string();
}

}  // namespace

int main(int argc, char** argv) {
  synthetic::Settings settings;
  std::filesystem::path out;
  synthetic::Extras extras;
  bool no_noise = false;
  int threads = 0;
  CLI::App app(
      "Writes a synthetic RGB-D sequence of a furnished room in TUM's layout, with exact truth beside it.");
  app.footer(scene_list());
  app.add_option("scene", settings.scene, "name of the scene, see below")->required();
  app.add_option("--out", out, "folder to write; must not exist or be empty")->required();
  app.add_option("--frames", settings.frames, "number of frames (default: the scene's own)")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", settings.seed, "textures, people, motion and noise; equal seeds give equal bytes")
      ->capture_default_str();
  app.add_option("--width", settings.width, "pixels")->capture_default_str();
  app.add_option("--height", settings.height, "pixels")->capture_default_str();
  app.add_option("--rate", settings.rate_hz, "frames a second")->capture_default_str();
  app.add_flag("--no-noise", no_noise, "ideal depth and colour");
  app.add_flag("--clean-depth", extras.clean_depth, "also write truth/depth: exact depth");
  app.add_flag("--degrade-masks", extras.degraded_masks,
               "also write truth/degraded_instances: masks as of a poor network (30 % of the frames missed)");
  app.add_option("--threads", threads, "0 = all cores; does not change the result")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? contract::kDone : contract::kWrongCall;
  }
  settings.noise = !no_noise;
  try {
    if (std::filesystem::exists(out) && !std::filesystem::is_empty(out))
      throw std::invalid_argument("--out " + out.string() + " is not empty");
    const std::size_t cores =
        threads > 0 ? static_cast<std::size_t>(threads)
                    : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, cores);
    const synthetic::Recording recording(settings);
    contract::Progress progress("synthesize", recording.size(), "frames");
    // Whole or absent.
    const std::filesystem::path partial = folder_name(out) + ".partial";
    std::filesystem::remove_all(partial);
    synthetic::write_recording(recording, partial, extras, [&] { progress.advance(); });
    std::filesystem::remove(out);  // empty, if it is there
    std::filesystem::rename(partial, out);
  } catch (const std::invalid_argument& error) {
    std::cerr << "synthesize: " << error.what() << "\n";
    return contract::kWrongCall;
  } catch (const std::exception& error) {
    std::cerr << "synthesize: " << error.what() << "\n";
    return contract::kFailed;
  }
  return contract::kDone;
}
