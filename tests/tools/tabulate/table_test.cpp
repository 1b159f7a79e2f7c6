#include "tools/tabulate/table.hpp"

#include <catch2/catch.hpp>

#include "tools/tabulate/bar_chart.hpp"

using namespace sediment::tabulate;

namespace {

Table some_table() {
  return {{"sequence", "left [%]"},
          {{{"fr3/w_xyz"}, shown(0.18253, 1, 100)}, {{"fr3, again"}, shown({}, 1)}}};
}

}  // namespace

TEST_CASE("Markdown shows rounded numbers to the right and a dash for what is not known") {
  CHECK(to_markdown(some_table()) ==
        "| sequence | left [%] |\n|---|---:|\n| fr3/w_xyz | 18.3 |\n| fr3, again | - |\n");
}

TEST_CASE("CSV has all digits, quotes what has commas, and leaves empty what is not known") {
  CHECK(to_csv(some_table()) == "sequence,left [%]\nfr3/w_xyz,18.253\n\"fr3, again\",\n");
}

TEST_CASE("LaTeX escapes what would be a command") {
  const std::string text = to_latex(some_table());
  CHECK(text.find("\\begin{tabular}{lr}") == 0);
  CHECK(text.find("fr3/w\\_xyz & 18.3 \\\\") != std::string::npos);
  CHECK(text.find("left [\\%]") != std::string::npos);
}

TEST_CASE("the median of an even number of values is the mean of the two in the middle") {
  CHECK_FALSE(median({}));
  CHECK(*median({3, 1, 2}) == 2);
  CHECK(*median({4, 1, 3, 2}) == 2.5);
}

TEST_CASE("bars are as high as their values, on an axis that begins at 0") {
  const std::string svg = bar_chart({{"a & b", {{"dense", 10, "10"}, {"less", 5, "5"}}}}, "Sizes", "MB");
  const auto height_of = [&](std::size_t n) {
    std::size_t at = 0;
    for (std::size_t i = 0; i <= n; ++i) at = svg.find("<rect x=", at + 1);
    const std::size_t begin = svg.find("height=\"", at) + 8;
    return std::stod(svg.substr(begin));
  };
  CHECK(height_of(0) == Approx(2 * height_of(1)).margin(0.01));
  CHECK(svg.find("a &amp; b") != std::string::npos);
}
