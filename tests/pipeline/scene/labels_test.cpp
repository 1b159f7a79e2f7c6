#include "pipeline/scene/labels.hpp"

#include <catch2/catch.hpp>

using namespace sediment;
using Catch::Matchers::Contains;

TEST_CASE("labels are found by name and by id, in the order of their ids") {
  const LabelTable table({{100, "wall", {}, false}, {0, "person", {}, true}});
  CHECK(table.labels()[0].name == "person");
  CHECK(table.find("wall")->id == 100);
  CHECK(table.find(0u)->prior_dynamic);
  CHECK(table.find("Wall") == nullptr);
  CHECK(table.find(1u) == nullptr);
  CHECK(LabelTable().find("wall") == nullptr);
}

TEST_CASE("a table with an id or a name twice is refused") {
  CHECK_THROWS_WITH(LabelTable({{1, "a", {}, false}, {1, "b", {}, false}}),
                    Contains("label id 1 is given twice"));
  CHECK_THROWS_WITH(LabelTable({{1, "a", {}, false}, {2, "a", {}, false}}), Contains("\"a\" is given twice"));
}
