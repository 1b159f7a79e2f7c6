// A small stage: writes its text parameter `times` over, with the content of its input before it.
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "pipeline/contract/stage.hpp"

using namespace sediment::contract;

namespace {

enum class Manner { plain, loud };

struct Parameters {
  int times = 2;
  double factor = 0.5;
  bool fails = false;
  std::string text = "so";
  Manner manner = Manner::plain;
  std::vector<std::string> words;
};

std::string content_of(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  Stage stage("stage-under-test", "Repeats a text");
  stage.reads("source", kind::kFile, "a file to begin with");
  stage.reads_optional("extra", kind::kFile, "a file to end with");
  stage.writes("text", kind::kFile, "text.txt");
  stage.tunes("times", parameters.times, "how often", {1, 9});
  stage.tunes("mixed_factor", parameters.factor, "a number", {0, 1});
  stage.tunes("fails", parameters.fails, "fail in the middle of the work");
  stage.tunes("text", parameters.text, "what to repeat");
  stage.tunes("manner", parameters.manner, "how", {{"plain", Manner::plain}, {"loud", Manner::loud}});
  stage.tunes("words", parameters.words, "more words");
  return stage.run(argc, argv, [&](Work& work) {
    std::ofstream out(work.out() / "text.txt");
    out << content_of(work.in("source"));
    for (int i = 0; i < parameters.times; ++i)
      out << parameters.text << (parameters.manner == Manner::loud ? "!" : ".");
    for (const std::string& word : parameters.words) out << word << ';';
    if (work.has("extra")) out << content_of(work.in("extra"));
    out << parameters.factor;
    if (parameters.fails) throw std::runtime_error("frame 7: asked to fail");
    work.metrics()["times"] = parameters.times;
  });
}
