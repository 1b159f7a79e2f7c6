#include "pipeline/runner/store/store.hpp"

#include <catch2/catch.hpp>

#include "pipeline/contract/errors.hpp"
#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::test::Workbench;
using namespace sediment::runner;
using sediment::contract::Json;

TEST_CASE("a damaged result or receipt is put aside and made again") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const std::string text = bench.read("out/thin/text.txt");
  const auto damage = GENERATE(
      as<std::string>{}, "truncate -s 3 out/thin/text.txt", "rm -f out/thin/text.txt",
      "rm -f out/thin/manifest.json", "rm -rf $(readlink -f out/thin)",
      "f=$(grep -rl '\"stage\":\"thin\"' out/.sediment/receipts); truncate -s -9 $f",
      "f=$(grep -rl '\"stage\":\"thin\"' out/.sediment/receipts); sed -i 's/\"wall_s\":0/\"wall_s\":1/' $f",
      "f=$(grep -rl '\"stage\":\"thin\"' out/.sediment/receipts); : >$f");
  INFO(damage);
  REQUIRE(bench.shell(damage).code == 0);
  const auto run = bench.run(bench.noted());
  CHECK(run.code == 0);
  CHECK(bench.started() == "thin");
  CHECK(bench.read("out/thin/text.txt") == text);
  CHECK_THAT(bench.run().out, Contains("4 kept") || Contains("4 ran"));
}

TEST_CASE("a lost index costs nothing but time") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const auto loss = GENERATE(as<std::string>{}, "rm -r out/.sediment/index/*",
                             "for f in out/.sediment/index/*; do truncate -s -1 $f; done",
                             "for f in out/.sediment/index/*; do echo junk >$f; done");
  bench.shell(loss);
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  CHECK(bench.started().empty());
}

TEST_CASE("verify reads everything and puts aside what changed without changing its size") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const auto well = bench.sediment("verify --out out");
  CHECK(well.code == 0);
  CHECK_THAT(well.out, Contains("4 receipts and 4 results") && Contains("all well"));
  const std::string text = bench.read("out/smooth/text.txt");
  bench.shell("chmod u+w out/smooth/text.txt; printf X | dd of=out/smooth/text.txt conv=notrunc status=none");
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  const auto found = bench.sediment("verify --out out");
  CHECK(found.code == 1);
  CHECK_THAT(found.out, Contains("its files do not match its manifest"));
  CHECK_THAT(found.out, Contains("its result is gone"));
  REQUIRE(bench.run(bench.noted()).code == 0);
  CHECK(bench.started() == "smooth");
  CHECK(bench.read("out/smooth/text.txt") == text);
  CHECK(bench.sediment("verify --out out").code == 0);
  CHECK_THAT(bench.sediment("verify --store out/.sediment --share 0.5").out,
             Contains("4 receipts and 2 results"));
  CHECK(bench.sediment("verify --store data").code == 2);
}

TEST_CASE("flag --durable gives the same results") {
  const Workbench bench;
  REQUIRE(bench.run("--durable").code == 0);
  CHECK_THAT(bench.run().out, Contains("4 kept"));
}

TEST_CASE("results are read-only and known by their content") {
  const Workbench bench;
  REQUIRE(bench.run().code == 0);
  const fs::path file = bench / "out/thin/text.txt";
  CHECK((fs::status(file).permissions() & fs::perms::owner_write) == fs::perms::none);
  const auto manifest = sediment::contract::read_manifest(bench / "out/thin");
  CHECK(fs::canonical(bench / "out/thin") == Store(bench / "out/.sediment").object_path(manifest.id()));
}

TEST_CASE("a folder with the store in it can be moved as a whole") {
  const Workbench bench;
  REQUIRE(bench.run().code == 0);
  bench.shell("mv out moved");
  CHECK(fs::exists(bench / "moved/thin/text.txt"));
}

TEST_CASE("a store of another version and a folder that is no store are refused and left alone") {
  const Workbench bench;
  bench.write("store/VERSION", "sediment-store 99\n");
  const auto newer = bench.run("--store store");
  CHECK(newer.code == 2);
  CHECK_THAT(newer.err,
             Contains("is a store of another version: expected \"sediment-store 1 xxh3-128\", found"));
  CHECK(bench.read("store/VERSION") == "sediment-store 99\n");
  bench.write("home/letter.txt", "dear");
  CHECK_THAT(bench.run("--store home").err, Contains("is neither empty nor a store"));
}

TEST_CASE("a lock is exclusive and is free again when its owner lets go") {
  const sediment::test::TemporaryFolder folder;
  {
    const auto first = KeyLock::try_acquire(folder / "lock", "a");
    REQUIRE(first);
    CHECK_FALSE(KeyLock::try_acquire(folder / "lock", "a"));
    CHECK(KeyLock::is_held(folder / "lock", "a"));
    CHECK_FALSE(KeyLock::is_held(folder / "lock", "b"));
    CHECK(KeyLock::try_acquire(folder / "lock", "b"));
  }
  CHECK_FALSE(KeyLock::is_held(folder / "lock", "a"));
  CHECK(KeyLock::try_acquire(folder / "lock", "a"));
}

TEST_CASE("a receipt survives writing and reading, and no bit of it may change") {
  Receipt receipt;
  receipt.key = "x3:1";
  receipt.parts = {{"outputs", Json::array({Json::array({"cloud", "cloud"})})}, {"stage", "thin"}};
  receipt.object = "x3:2";
  receipt.bytes = 7;
  receipt.files = {{"a.txt", 7}};
  receipt.argv = {"thin", "--out", "x"};
  receipt.wall_s = 1.5;
  receipt.log = "said \xff\n";
  const std::string text = text_of(receipt);
  const Receipt read = receipt_from(text);
  CHECK(read.key == receipt.key);
  CHECK(read.parts == receipt.parts);
  CHECK(read.files == receipt.files);
  CHECK(read.argv == receipt.argv);
  CHECK(read.wall_s == receipt.wall_s);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    CHECK_THROWS(receipt_from(changed));
    CHECK_THROWS(receipt_from(text.substr(0, i)));
  }
}
