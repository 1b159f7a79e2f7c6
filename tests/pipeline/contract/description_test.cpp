#include <catch2/catch.hpp>

#include "pipeline/contract/description.hpp"

using namespace sediment::contract;

TEST_CASE("the nearest known name is found for a mistyped one, and none for a strange one") {
  const std::vector<std::string> known{"neighbors", "std_multiplier", "sides"};
  CHECK(nearest_name("neighbours", known) == "neighbors");
  CHECK(nearest_name("side", known) == "sides");
  CHECK(nearest_name("resolution", known).empty());
  CHECK(nearest_name("x", {}).empty());
}

TEST_CASE("JSON that is no description is refused") {
  CHECK_THROWS_WITH(description_from(Json::parse("{}")), Catch::Contains("not the description of a stage"));
  CHECK_THROWS_WITH(description_from(Json{{"format", "sediment-stage 99"}}),
                    Catch::Contains("unknown format"));
}
