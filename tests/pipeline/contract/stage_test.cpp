#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "pipeline/contract/description.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace sediment::contract;
using sediment::test::TemporaryFolder;

namespace {

std::string content_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Outcome {
  int code;
  std::string out, err;
};

/// Runs the stage with a source file that says "a " and the flags given.
Outcome run(const TemporaryFolder& folder, const std::string& flags) {
  std::ofstream(folder / "source.txt") << "a ";
  const std::string command = "'" SEDIMENT_BINARY_DIR "/stage_under_test' " + flags + " >'" +
                              (folder / "out.log").string() + "' 2>'" + (folder / "err.log").string() + "'";
  const int status = std::system(("cd '" + folder.path().string() + "' && " + command).c_str());
  return {WEXITSTATUS(status), content_of(folder / "out.log"), content_of(folder / "err.log")};
}

}  // namespace

TEST_CASE("a stage writes its files, metrics and manifest, and leaves no partial folder") {
  const TemporaryFolder folder;
  REQUIRE(run(folder, "--source source.txt --out result").code == 0);
  CHECK(content_of(folder / "result/text.txt") == "a so.so.0.5");
  CHECK(content_of(folder / "result/metrics.json") == "{\n \"times\": 2\n}\n");
  const Manifest manifest = read_manifest(folder / "result");
  CHECK(manifest.files == manifest_of(folder / "result", "stage-under-test").files);
  CHECK(manifest.files.size() == 2);
  CHECK_FALSE(fs::exists(folder / "result.partial"));
}

TEST_CASE("every parameter is a flag, in kebab case or as in the YAML") {
  const TemporaryFolder folder;
  std::ofstream(folder / "extra.txt") << " end ";
  REQUIRE(
      run(folder,
          "--source source.txt --extra extra.txt --out result/ --times 1 --text x --manner loud --words p,q "
          "--mixed-factor 0.25")
          .code == 0);
  CHECK(content_of(folder / "result/text.txt") == "a x!p;q; end 0.25");
  REQUIRE(run(folder, "--source source.txt --out result --mixed_factor=1").code == 0);
  CHECK(content_of(folder / "result/text.txt") == "a so.so.1");
}

TEST_CASE("a stage that fails leaves an earlier result as it was and exits with 1") {
  const TemporaryFolder folder;
  REQUIRE(run(folder, "--source source.txt --out result").code == 0);
  const Outcome failed = run(folder, "--source source.txt --out result --text y --fails true");
  CHECK(failed.code == 1);
  CHECK(failed.err == "stage-under-test: frame 7: asked to fail\n");
  CHECK(content_of(folder / "result/text.txt") == "a so.so.0.5");
}

TEST_CASE("a folder that is no result of a stage is never replaced") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "precious");
  std::ofstream(folder / "precious/thesis.txt") << "years";
  const Outcome refused = run(folder, "--source source.txt --out precious");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("precious exists and is no result of a stage") != std::string::npos);
  CHECK(content_of(folder / "precious/thesis.txt") == "years");
}

TEST_CASE("wrong calls exit with 2 and say what is wrong") {
  const TemporaryFolder folder;
  const auto [flags, message] = GENERATE(table<std::string, std::string>({
      {"--out r", "--source is required"},
      {"--source source.txt", "--out is required"},
      {"--source missing.txt --out r", "--source: missing.txt does not exist"},
      {"--source source.txt --out r --time 3", "did you mean --times?"},
      {"--source source.txt --out r --times 10", "times: expected a whole number in 1 .. 9, found 10"},
      {"--source source.txt --out r --times 1.5", "times: expected a whole number in 1 .. 9, found \"1.5\""},
      {"--source source.txt --out r --manner rude", "manner: expected one of plain, loud, found \"rude\""},
      {"--source source.txt --out r --mixed-factor nan", "mixed_factor: expected a number in 0.0 .. 1.0"},
  }));
  const Outcome refused = run(folder, flags);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::Contains(message));
  CHECK_FALSE(fs::exists(folder / "r"));
}

TEST_CASE("a stage prints its declaration with --describe and teaches it with --help") {
  const TemporaryFolder folder;
  const Outcome described = run(folder, "--describe");
  REQUIRE(described.code == 0);
  const Description description = description_from(Json::parse(described.out));
  CHECK(description.stage == "stage-under-test");
  CHECK(description.find_input("extra")->optional);
  CHECK(description.find_parameter("times")->default_value == 2);
  CHECK(description.find_parameter("times")->range.max == 9);
  CHECK(description.find_parameter("manner")->choices == std::vector<std::string>{"plain", "loud"});
  CHECK(to_json(description) == Json::parse(described.out));

  const Outcome help = run(folder, "--help");
  CHECK(help.code == 0);
  for (const char* expected : {"--source", "--mixed-factor", "how often [2]", "{plain|loud}", "--threads"})
    CHECK_THAT(help.out, Catch::Contains(expected));
}
