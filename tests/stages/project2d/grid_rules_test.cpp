#include "stages/project2d/grid_rules.hpp"

#include <catch2/catch.hpp>

using namespace sediment;
using namespace sediment::project2d;

namespace {

/// Rows as a picture, the highest y first: '#' occupied, '.' free, '?' unknown.
GridMap drawn(const std::vector<std::string>& rows) {
  GridMap map;
  map.width = static_cast<int>(rows[0].size());
  map.height = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char c : *row)
      map.cells.push_back(c == '#' ? Cell::occupied : c == '.' ? Cell::free : Cell::unknown);
  return map;
}

std::vector<std::string> picture(const GridMap& map) {
  std::vector<std::string> rows;
  for (int y = map.height - 1; y >= 0; --y) {
    rows.emplace_back();
    for (int x = 0; x < map.width; ++x)
      rows.back() += map.at(x, y) == Cell::occupied ? '#' : map.at(x, y) == Cell::free ? '.' : '?';
  }
  return rows;
}

}  // namespace

TEST_CASE("holes of few unknown cells amid free ones become free, others stay") {
  GridMap map = drawn({"........??",  //
                       ".?...??..?",  // one alone; two; some at the border
                       ".....?....",  //
                       "..##......",  //
                       ".?##..???.",  // beside an obstacle; three in a row
                       ".........."});
  CHECK(fill_holes(map, 3) == 1 + 3 + 3);
  CHECK(picture(map) == std::vector<std::string>{"........??",  //
                                                 ".........?",  //
                                                 "..........",  //
                                                 "..##......",  //
                                                 ".?##......",  //
                                                 ".........."});
  GridMap same = drawn({"...", ".?.", "..."});
  CHECK(fill_holes(same, 0) == 0);
  CHECK(picture(same)[1] == ".?.");
  GridMap larger = drawn({"....", ".??.", "...."});
  CHECK(fill_holes(larger, 1) == 0);
}

TEST_CASE("gaps of two cells between free ones close, but not beside obstacles, and wide ones not at all") {
  GridMap map = drawn({"............",  //
                       "............",  //
                       "..??..???...",  //
                       "..??..???...",  //
                       "..??..???...",  //
                       "............",  //
                       "...?#.......",  //
                       "............"});
  CHECK(close_notches(map) == 6);
  CHECK(picture(map) == std::vector<std::string>{"............",  //
                                                 "............",  //
                                                 "......???...",  //
                                                 "......???...",  //
                                                 "......???...",  //
                                                 "............",  //
                                                 "...?#.......",  //
                                                 "............"});
  GridMap border = drawn({"???????",  //
                          "..?..??",  //
                          "......."});
  CHECK(close_notches(border) == 1);
  CHECK(picture(border) == std::vector<std::string>{"???????", ".....??", "......."});
}

TEST_CASE("a lone occupied cell of few points becomes unknown, a chair leg of many and a thin wall stay") {
  GridMap map = drawn({"#....",  //
                       "...#.",  //
                       ".....",  //
                       "##..#"});
  std::vector<std::int32_t> in_band(map.cells.size(), 0);
  in_band[15] = 2;              // (0, 3): few
  in_band[13] = 9;              // (3, 2): many
  in_band[0] = in_band[1] = 1;  // a wall of two cells
  in_band[4] = 2;               // (4, 0): few
  CHECK(remove_speckle(map, in_band, 3) == 2);
  CHECK(picture(map) == std::vector<std::string>{"?....", "...#.", ".....", "##..?"});
  CHECK(remove_speckle(map, in_band, 1) == 0);
}
