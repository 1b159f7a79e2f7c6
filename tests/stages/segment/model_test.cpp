#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "stages/segment/network/network.hpp"
#include "stages/segment/onnx/head.hpp"
#include "stages/segment/onnx/wire.hpp"
#include "tests/stages/segment/tiny_network.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::segment;
using Catch::Matchers::Contains;
using sediment::test::TemporaryFolder;
using sediment::test::TinyNetwork;

namespace {

onnx::Layout layout_of(const TinyNetwork& network, const std::vector<std::string>& class_names = {}) {
  const TemporaryFolder folder;
  write_onnx(folder / "tiny.onnx", network);
  const onnx::Model model(folder / "tiny.onnx");
  return onnx::read_layout(model, class_names);
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a layout is read from shapes and metadata, not from names and order") {
  TinyNetwork network;
  network.swapped = true;
  const onnx::Layout layout = layout_of(network);
  CHECK(layout.input == "images");
  CHECK(layout.input_size == onnx::Size{64, 96});
  CHECK(layout.trained_size == onnx::Size{64, 96});
  CHECK(layout.stride == 32);
  CHECK(layout.anchors == "second");
  CHECK(layout.prototypes == "first");
  CHECK(layout.mask_coefficients == 3);
  CHECK(layout.class_names == std::vector<std::string>{"red thing", "it's green"});
  network.dynamic = true;
  CHECK(layout_of(network).input_size == onnx::Size{0, 0});
}

TEST_CASE("class names are read as Python writes them") {
  CHECK(onnx::parse_class_names("{0: 'person', 1: \"it's\", 2: 'a \\'b\\' \"c\"'}") ==
        std::vector<std::string>{"person", "it's", "a 'b' \"c\""});
  CHECK(onnx::parse_class_names("['x', 'y2']") == std::vector<std::string>{"x", "y2"});
  CHECK(onnx::parse_class_names("{0: 'route 66', 1: '2'}") == std::vector<std::string>{"route 66", "2"});
  for (const char* wrong : {"", "{}", "person", "{0: 'a', 2: 'b'}", "{0: 'a', 1: 'b", "{0: ''}"})
    CHECK_THROWS_WITH(onnx::parse_class_names(wrong), Contains("class names"));
}

TEST_CASE("a network that cannot be used is refused with what was expected and found") {
  TinyNetwork detection;
  detection.segments = false;
  CHECK_THROWS_WITH(layout_of(detection),
                    Contains("found second [1, 6, 126]") && Contains("export a -seg network"));
  TinyNetwork half;
  half.element_type = 10;
  CHECK_THROWS_WITH(layout_of(half), Contains("expected a float32 input"));
  TinyNetwork batch;
  batch.batch = 4;
  CHECK_THROWS_WITH(layout_of(batch), Contains("one image at a time") && Contains("images [4, 3, 64, 96]"));
  TinyNetwork nameless;
  nameless.names.clear();
  CHECK_THROWS_WITH(layout_of(nameless), Contains("no class names"));
  CHECK(layout_of(nameless, {"a", "b"}).class_names == std::vector<std::string>{"a", "b"});
  CHECK_THROWS_WITH(layout_of({}, {"a", "b", "c"}), Contains("outputs for 3 classes"));
}

TEST_CASE("a file that is no network, or is cut off anywhere, is refused by name") {
  const TemporaryFolder folder;
  const std::string whole = test::onnx_file({});
  write(folder / "empty.onnx", "");
  CHECK_THROWS_WITH(onnx::Model(folder / "empty.onnx"), Contains("empty.onnx is no ONNX network"));
  write(folder / "text.onnx", "this is a text, not a network");
  CHECK_THROWS_WITH(onnx::Model(folder / "text.onnx"), Contains("text.onnx is no ONNX network"));
  CHECK_THROWS_WITH(onnx::Model(folder / "none.onnx"), Contains("none.onnx"));
  CHECK_THROWS_WITH(onnx::Model(folder.path()), Contains("cannot read"));
  int read = 0;
  for (std::size_t size = 1; size < whole.size(); size += 7) {
    write(folder / "cut.onnx", whole.substr(0, size));
    try {
      onnx::read_layout(onnx::Model(folder / "cut.onnx"));
      ++read;
    } catch (const std::runtime_error& error) {
      CHECK_THAT(error.what(), Contains("cut.onnx"));
    }
  }
  CHECK(read <= 60);  // only cuts between the entries at the end, behind the class names
}

TEST_CASE("damaged networks are refused or run, and never crash") {
  const TemporaryFolder folder;
  const std::string whole = test::onnx_file({});
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    write(folder / "damaged.onnx", bytes);
    try {
      const onnx::Model model(folder / "damaged.onnx");
      const onnx::Layout layout = onnx::read_layout(model);
      const onnx::Head head = onnx::find_head(model, layout);
      CHECK_FALSE(onnx::cut_before_decoding(model, layout, head, {64, 96}).empty());
    } catch (const std::runtime_error& error) {
      CHECK_THAT(error.what(), Contains("damaged.onnx"));
    }
  }
}

TEST_CASE("the head is found where the decoding begins") {
  const TemporaryFolder folder;
  TinyNetwork network;
  write_onnx(folder / "tiny.onnx", network);
  const onnx::Model joined(folder / "tiny.onnx");
  const onnx::Head head = onnx::find_head(joined, onnx::read_layout(joined));
  CHECK(head.bins == "bins");
  CHECK(head.logits == "logits");
  CHECK(head.coefficients == "coefficients");
  network.split = true;
  write_onnx(folder / "split.onnx", network);
  const onnx::Model split(folder / "split.onnx");
  CHECK(onnx::find_head(split, onnx::read_layout(split)).bins == "both");
  CHECK(onnx::find_head(split, onnx::read_layout(split)).logits == "both");
}

TEST_CASE("the cut network has no node of the decoding and a fixed input") {
  const TemporaryFolder folder;
  TinyNetwork network;
  network.dynamic = true;
  write_onnx(folder / "tiny.onnx", network);
  const onnx::Model model(folder / "tiny.onnx");
  const onnx::Layout layout = onnx::read_layout(model);
  write(folder / "cut.onnx",
        onnx::cut_before_decoding(model, layout, onnx::find_head(model, layout), {64, 96}));
  const onnx::Model cut(folder / "cut.onnx");
  REQUIRE(cut.inputs.size() == 1);
  CHECK(cut.inputs[0].shape == std::vector<std::int64_t>{1, 3, 64, 96});
  for (const onnx::Node& node : cut.nodes) CHECK(node.op_type != "Softmax");
  CHECK(cut.outputs.size() == 4);
  CHECK(cut.nodes.size() < model.nodes.size());
}

TEST_CASE("the real networks are understood") {
  const auto file = sediment::test::needs("models/yolov8n-seg-480x640.onnx");
  if (!file) return;
  const onnx::Model model(*file);
  const onnx::Layout layout = onnx::read_layout(model);
  CHECK(layout.input_size == onnx::Size{480, 640});
  CHECK(layout.class_names.size() == 80);
  CHECK(layout.class_names[79] == "toothbrush");
  CHECK(layout.mask_coefficients == 32);
  CHECK(onnx::find_head(model, layout).bins == "/model.22/Concat_output_0");
}
