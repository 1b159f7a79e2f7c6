#include "tools/report/page.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tools/report/parts.hpp"

using namespace sediment;
using namespace sediment::report;

TEST_CASE("base64 is that of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("no text in the facts can end the script that holds them") {
  const Json facts = {{"name", "</script><!-- <script>"}};
  const std::string text = script_text(facts);
  CHECK(text.find('<') == std::string::npos);
  CHECK(Json::parse(text) == facts);
}

TEST_CASE("a block with a key that is known is neither made nor stored again") {
  Page page;
  int made = 0;
  const auto bytes = [&] {
    ++made;
    return std::string("points");
  };
  const std::string first = page.block("cloud 1", bytes), again = page.block("cloud 1", bytes),
                    other = page.block("cloud 2", bytes);
  CHECK(first == again);
  CHECK(first != other);
  CHECK(made == 2);
}

TEST_CASE("spread takes one position of each stretch, in order, and all if there are few") {
  CHECK(spread(5, 3) == std::vector<std::size_t>{0, 1, 2});
  CHECK(spread(0, 3).empty());
  const auto some = spread(100, 1003);
  REQUIRE(some.size() == 100);
  for (std::size_t i = 0; i < some.size(); ++i) {
    CHECK(some[i] >= i * 1003 / 100);
    CHECK(some[i] < (i + 1) * 1003 / 100);
  }
}
