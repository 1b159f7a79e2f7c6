#include "pipeline/runner/store/stat_memory.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

using namespace sediment::runner;
using Use = StatMemory::Use;

namespace {

FileStat old_stat() {
  return {1, 2, 3, 4'000'000'000, 5'000'000'000};
}

}  // namespace

TEST_CASE("the memory keeps what it is told until the stat of the file changes") {
  const sediment::test::TemporaryFolder folder;
  {
    StatMemory memory(folder / "memory");
    memory.remember(Use::digest, "/a", old_stat(), "one", true);
    memory.remember(Use::description, "/a", old_stat(), std::string("t\0wo", 4), true);
    memory.remember(Use::digest, "/b", old_stat(), "three", true);
    memory.remember(Use::digest, "/b", old_stat(), "four", true);
    memory.save();
  }
  const StatMemory memory(folder / "memory");
  CHECK(memory.recall(Use::digest, "/a", old_stat()) == "one");
  CHECK(memory.recall(Use::description, "/a", old_stat()) == std::string_view("t\0wo", 4));
  CHECK(memory.recall(Use::digest, "/b", old_stat()) == "four");
  CHECK_FALSE(memory.recall(Use::digest, "/c", old_stat()));
  for (auto change : {+[](FileStat& stat) { ++stat.device; }, +[](FileStat& stat) { ++stat.inode; },
                      +[](FileStat& stat) { ++stat.bytes; }, +[](FileStat& stat) { ++stat.modified_ns; },
                      +[](FileStat& stat) { ++stat.changed_ns; }}) {
    FileStat stat = old_stat();
    change(stat);
    CHECK_FALSE(memory.recall(Use::digest, "/a", stat));
  }
}

TEST_CASE("a file changed within the last two seconds is not remembered") {
  const sediment::test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const auto stat = stat_of(folder / "file");
  REQUIRE(stat);
  StatMemory memory(folder / "memory");
  memory.remember(Use::digest, "file", *stat, "one", true);
  CHECK_FALSE(memory.recall(Use::digest, "file", *stat));
  memory.remember(Use::receipt, "file", *stat, "one", false);
  CHECK(memory.recall(Use::receipt, "file", *stat) == "one");
}

TEST_CASE("a damaged memory counts as empty") {
  const sediment::test::TemporaryFolder folder;
  StatMemory memory(folder / "memory");
  memory.remember(Use::digest, "/a", old_stat(), "one", true);
  memory.save();
  std::fstream(folder / "memory", std::ios::in | std::ios::out | std::ios::binary).seekp(60).put('!');
  CHECK_FALSE(StatMemory(folder / "memory").recall(Use::digest, "/a", old_stat()));
}
