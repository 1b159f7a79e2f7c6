#include "pipeline/runner/config/variables.hpp"

#include <catch2/catch.hpp>

using namespace sediment::runner;

namespace {

Expansion expanded(const std::string& text) {
  return expand(mark_variables(text), [](const std::string& name) -> std::optional<std::string> {
    if (name == "A") return "value: {with, structure}";
    return std::nullopt;
  });
}

}  // namespace

TEST_CASE("variables are replaced in a text and the unset ones are named") {
  CHECK(expanded("x ${A}/y${A}").text == "x value: {with, structure}/yvalue: {with, structure}");
  CHECK(expanded("${B}/${C_1}").unset == std::vector<std::string>{"B", "C_1"});
  CHECK(expanded("${A}").unset.empty());
}

TEST_CASE("there is no other templating") {
  for (const char* text : {"$A", "${}", "${A", "${A B}", "$(A)", "{A}", "${1}"})
    CHECK(expanded(text).text == text);
}
