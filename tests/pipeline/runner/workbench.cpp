#include "tests/pipeline/runner/workbench.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sediment::test {

namespace fs = std::filesystem;

Workbench::Workbench() {
  fs::create_directories(folder_ / "stages");
  for (const char* stage : {"scan", "smooth", "thin", "chart"})
    fs::create_symlink(SEDIMENT_BINARY_DIR "/fake_stage", folder_ / "stages" / stage);
  write("pipeline.yaml", kPipeline);
  write("data/sequence.yaml", "root: .\ncamera: {width: 4}\n");
  write("data/rgb.txt", "# stamp file\n1.0 rgb/1.png\n2.0 rgb/2.png\n");
  write("data/depth.txt", "1.0 depth/1.png\n");
  for (const char* image : {"rgb/1.png", "rgb/2.png", "depth/1.png"}) write(fs::path("data") / image, image);
  // Older than the two seconds for which the stat memory trusts nobody.
  shell("find data stages -exec touch -h -d '1 hour ago' {} +");
}

Outcome Workbench::shell(const std::string& command) const {
  const std::string line = "cd '" + folder_.path().string() + "' && { " + command + "\n} >'" +
                           (folder_ / "stdout").string() + "' 2>'" + (folder_ / "stderr").string() + "'";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read("stdout"), read("stderr")};
}

Outcome Workbench::sediment(const std::string& flags) const {
  return shell("SEQUENCE=data exec '" SEDIMENT_BINARY_DIR "/sediment' " + flags);
}

Outcome Workbench::call(const std::string& command, const std::string& flags) const {
  return sediment(command + " pipeline.yaml --out out --stages stages " + flags);
}

Outcome Workbench::run(const std::string& flags) const {
  return call("run", flags);
}

void Workbench::write(const fs::path& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Workbench::read(const fs::path& name) const {
  std::stringstream text;
  text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
  return text.str();
}

std::string Workbench::noted() const {
  std::string flags;
  for (const char* stage : {"scan", "smooth", "thin", "chart"})
    flags += std::string(" --set ") + stage + ".diary=" + (folder_ / "diary").string();
  return flags + ' ';
}

std::string Workbench::started() const {
  std::istringstream lines(read("diary"));
  fs::remove(folder_ / "diary");
  std::string all;
  for (std::string line; std::getline(lines, line);) all += (all.empty() ? "" : " ") + line;
  return all;
}

}  // namespace sediment::test
