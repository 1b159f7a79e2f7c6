#include "benchmarks/runner/timed_call.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace sediment::benchmark {

namespace fs = std::filesystem;

Timed timed_call(const std::vector<std::string>& argv, const fs::path& folder) {
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const std::string log = folder / "log";
  const auto start = std::chrono::steady_clock::now();
  const pid_t pid = vfork();  // the memory of the child is not counted from ours
  if (pid == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (dup2(out, 1) >= 0 && dup2(out, 2) >= 0 && chdir(folder.c_str()) == 0) execvp(words[0], words.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(pid, &status, 0, &usage);
  Timed timed;
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  timed.peak_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  std::ifstream stream(log, std::ios::binary);
  timed.output.assign(std::istreambuf_iterator<char>(stream), {});
  if (status != 0) throw std::runtime_error(argv[0] + " failed: " + timed.output);
  return timed;
}

bool is_installed(const std::string& program) {
  std::istringstream path(std::getenv("PATH"));
  for (std::string folder; std::getline(path, folder, ':');)
    if (access((folder + '/' + program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace sediment::benchmark
