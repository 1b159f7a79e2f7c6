// A small stage that is whatever its file is called: scan reads a sequence, smooth and thin read and write
// clouds, chart makes a grid map. Its result is a line of text behind the text of its input.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "pipeline/contract/stage.hpp"

using namespace sediment::contract;
namespace fs = std::filesystem;

namespace {

enum class Manner { plain, loud };

struct Parameters {
  int neighbors = 50;  ///< the result shows its tens only: 50 and 51 give the same bytes
  double factor = 0.5;
  Manner manner = Manner::plain;
  std::vector<std::string> words;
  std::string fault;  ///< fail, crash, hang, deaf (to SIGTERM), twice, lie (a manifest that does not match),
                      ///< link, orphan, daemon
  double sleep_s = 0;
  int padding_mb = 0;  ///< size of one more file, written piece by piece over sleep_s
  std::string diary;   ///< file that gets a line per start
};

std::string content_of(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(fs::is_directory(path) ? path / "text.txt" : path).rdbuf();
  return text.str();
}

/// The bytes depend on the name alone. Without padding just sleeps.
void write_slowly(const fs::path& file, const std::string& name, int megabytes, double seconds) {
  constexpr int kPieces = 16;
  std::ofstream out;
  if (megabytes > 0) out.open(file, std::ios::binary);
  std::uint64_t state = std::hash<std::string>{}(name);
  for (int piece = 0; piece < kPieces; ++piece) {
    std::vector<std::uint64_t> words(static_cast<std::size_t>(megabytes) * 1'000'000 / 8 / kPieces);
    for (std::uint64_t& word : words) word = state = state * 6364136223846793005u + 1442695040888963407u;
    out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(8 * words.size()));
    out.flush();
    if (megabytes > 0 && !out)
      throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds / kPieces));
  }
}

void misbehave(const std::string& fault, const fs::path& out, const fs::path& diary) {
  if (fault == "fail") throw std::runtime_error("frame 7: asked to fail");
  if (fault == "crash") std::abort();
  if (fault == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
  if (fault == "link") fs::create_symlink("/etc/hostname", out / "link");
  if (fault == "deaf") {
    std::system("trap '' TERM; sleep 3600");
  }
  // Fails until its third start; needs a diary.
  if (fault == "twice") {
    std::ifstream lines(diary);
    const auto starts = std::count(std::istreambuf_iterator<char>(lines), {}, '\n');
    if (starts < 3) throw std::runtime_error("not yet");
  }
  // A grandchild that outlives us and goes on writing into our result.
  const pid_t stage = getpid();
  if ((fault == "orphan" || fault == "daemon") && fork() == 0) {
    if (fault == "daemon") setsid();
    std::ofstream late(out / "text.txt", std::ios::app);
    while (getppid() == stage) usleep(1000);
    usleep(500'000);
    for (int i = 0; i < 100; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      late << "late\n" << std::flush;
    }
    _exit(0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  const std::string name = fs::path(argv[0]).filename();
  Stage stage(name, "A stage for tests");
  const bool scans = name == "scan";
  stage.reads(scans ? "sequence" : "cloud", scans ? kind::kSequence : kind::kCloud, "what to begin with");
  if (scans) stage.reads_optional("model", kind::kFile, "a network");
  if (name == "chart") stage.reads_optional("second", kind::kCloud, "another cloud");
  stage.writes(name == "chart" ? "grid" : "cloud", name == "chart" ? kind::kGridMap : kind::kCloud,
               "text.txt");
  stage.tunes("neighbors", parameters.neighbors, "how many", {1, 100});
  stage.tunes("factor", parameters.factor, "a number", {0, 1});
  stage.tunes("manner", parameters.manner, "how", {{"plain", Manner::plain}, {"loud", Manner::loud}});
  stage.tunes("words", parameters.words, "words");
  stage.tunes("fault", parameters.fault, "what goes wrong");
  stage.tunes("sleep_s", parameters.sleep_s, "time to take", {0, 3600});
  stage.tunes("padding_mb", parameters.padding_mb, "size of another file", {0, 10000});
  stage.tunes("diary", parameters.diary, "file for notes");
  const int code = stage.run(argc, argv, [&](Work& work) {
    if (!parameters.diary.empty()) std::ofstream(parameters.diary, std::ios::app) << name << '\n';
    std::ofstream out(work.out() / "text.txt");
    for (const char* role : {"sequence", "model", "cloud", "second"})
      if (work.has(role)) out << content_of(work.in(role));
    out << name << ' ' << parameters.neighbors / 10 * 10 << ' ' << parameters.factor << '\n' << std::flush;
    write_slowly(work.out() / "padding.bin", name, parameters.padding_mb, parameters.sleep_s);
    misbehave(parameters.fault, work.out(), parameters.diary);
    work.metrics()["neighbors"] = parameters.neighbors / 10 * 10;
  });
  for (int i = 1; parameters.fault == "lie" && i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--out") std::ofstream(fs::path(argv[i + 1]) / "text.txt") << "another";
  return code;
}
