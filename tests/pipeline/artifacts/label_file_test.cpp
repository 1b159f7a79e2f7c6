#include "pipeline/artifacts/label_file.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace sediment;

TEST_CASE("the built-in labels are COCO's by index, then those of rooms") {
  const LabelTable& table = default_labels();
  CHECK(table.labels().size() == 80 + 9);
  CHECK(table.find(0u)->name == "person");
  CHECK(table.find(56u)->name == "chair");
  CHECK(table.find(62u)->name == "tv");
  CHECK(table.find(73u)->name == "book");
  CHECK(table.find(79u)->name == "toothbrush");
  CHECK(table.find("wall")->id == 100);
  CHECK(table.find("other furniture")->id == 108);
  CHECK(table.find(kUnlabelled) == nullptr);
}
