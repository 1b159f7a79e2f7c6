#include "pipeline/artifacts/label_file.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

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

TEST_CASE("people and animals move by themselves, and nothing else") {
  std::set<std::string> movers;
  for (const Label& label : default_labels().labels())
    if (label.prior_dynamic) movers.insert(label.name);
  CHECK(movers == std::set<std::string>{"person", "bird", "cat", "dog", "horse", "sheep", "cow", "elephant",
                                        "bear", "zebra", "giraffe"});
}

TEST_CASE("every class has a colour of its own") {
  std::set<std::array<std::uint8_t, 3>> colors;
  for (const Label& label : default_labels().labels()) colors.insert(label.rgb);
  CHECK(colors.size() == default_labels().labels().size());
}

TEST_CASE("the table in the source tree is the one that is built in") {
  const LabelTable read = read_labels(SEDIMENT_SOURCE_DIR "/configs/labels/coco.yaml");
  REQUIRE(read.labels().size() == default_labels().labels().size());
  for (const Label& label : read.labels()) CHECK(default_labels().find(label.id)->name == label.name);
}

TEST_CASE("a wrong label file is refused with its line") {
  const test::TemporaryFolder folder;
  const auto [text, expected] = GENERATE(table<std::string, std::string>(
      {{"- {id: 1, name: a, color: [1, 2, 3]}\n- {id: 2, name: b, colour: [1, 2, 3]}",
        ":2: unknown key \"colour\""},
       {"- {id: 1, name: a, color: [1, 2, 3]}\n- {id: 2, color: [1, 2, 3]}", ":2: \"name\" is missing"},
       {"- {id: 1, name: a, color: [1, 2, 3]}\n- {id: 1, name: b, color: [1, 2, 3]}",
        ":2: label id 1 is given twice"},
       {"- {id: 1, name: a, color: [1, 2, 3]}\n- {id: 2, name: a, color: [1, 2, 3]}", ":2: label name \"a\""},
       {"- {id: 1, name: a, color: [1, 2]}", ":1: a color is [red, green, blue]"},
       {"- {id: 1, name: a, color: [1, 2, 256]}", ":1: a color value is 0 .. 255"},
       {"- {id: one, name: a, color: [1, 2, 3]}", ":1: the value of \"id\" cannot be read"},
       {"- {id: -1, name: a, color: [1, 2, 3]}", ":1: the value of \"id\" cannot be read"},
       {"id: 1", ": expected a list of labels"},
       {"- [", ":"}}));
  write_bytes(folder / "labels.yaml", {text});
  CHECK_THROWS_WITH(read_labels(folder / "labels.yaml"), Contains("labels.yaml" + expected));
}
