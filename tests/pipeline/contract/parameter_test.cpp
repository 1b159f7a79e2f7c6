#include <catch2/catch.hpp>

#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/parameter.hpp"

using namespace sediment::contract;

namespace {

Parameter number() {
  return {"leaf_m", ParameterType::number, 0.01, {0, 10}, {}, "", true};
}
Parameter integer() {
  return {"k", ParameterType::integer, 50, {1, 100}, {}, "", true};
}

}  // namespace

TEST_CASE("numbers that mean the same have the same canonical text") {
  CHECK(canonical(number(), Json(1)).dump() == "1.0");
  CHECK(parse(number(), "0.10").dump() == parse(number(), "0.1").dump());
  CHECK(parse(number(), "1e-1").dump() == "0.1");
  CHECK(parse(number(), "-0").dump() == "0.0");
  CHECK(canonical(integer(), Json(30.0)).dump() == "30");
  CHECK(parse(integer(), "+30").dump() == "30");
}

TEST_CASE("a value of the wrong type or out of range is refused with both sides named") {
  CHECK_THROWS_WITH(parse(number(), "11"), "leaf_m: expected a number in 0.0 .. 10.0, found 11.0");
  CHECK_THROWS_WITH(parse(number(), "1cm"), "leaf_m: expected a number in 0.0 .. 10.0, found \"1cm\"");
  CHECK_THROWS_WITH(parse(integer(), "0"), "k: expected a whole number in 1 .. 100, found 0");
  CHECK_THROWS_AS(parse(number(), "nan"), UsageError);
  CHECK_THROWS_AS(parse(number(), "inf"), UsageError);
  CHECK_THROWS_AS(parse(number(), ""), UsageError);
  CHECK_THROWS_AS(canonical(integer(), Json(1.5)), UsageError);
  CHECK_THROWS_AS(canonical(integer(), Json("30")), UsageError);
  CHECK_THROWS_AS(canonical({"on", ParameterType::boolean, true, {}, {}, "", true}, Json(1)), UsageError);
}

TEST_CASE("lists are split at commas and trimmed") {
  const Parameter list{"classes", ParameterType::list, Json::array(), {}, {}, "", true};
  CHECK(parse(list, "person, dining table,,cat ") == Json({"person", "dining table", "cat"}));
  CHECK(parse(list, "") == Json::array());
}
