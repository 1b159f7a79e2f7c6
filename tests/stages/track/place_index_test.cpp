#include <catch2/catch.hpp>
#include <random>

#include "stages/track/place_index.hpp"

using namespace sediment::track;

namespace {

// Descriptors of a place: its own draw, of which every view flips some bits.
std::vector<Descriptor> view_of(unsigned place, unsigned view) {
  std::mt19937_64 own(place), noise(1000 * place + view);
  std::vector<Descriptor> descriptors(200);
  for (Descriptor& descriptor : descriptors) {
    for (auto& word : descriptor) word = own();
    for (int i = 0; i < 12; ++i) descriptor[noise() % 4] ^= std::uint64_t{1} << (noise() % 64);
  }
  return descriptors;
}

}  // namespace

TEST_CASE("a place is most similar to another view of itself") {
  std::vector<std::vector<Descriptor>> places;
  for (unsigned place = 0; place < 30; ++place) places.push_back(view_of(place, 0));
  std::vector<const std::vector<Descriptor>*> pointers;
  for (const auto& place : places) pointers.push_back(&place);
  const PlaceIndex index(pointers);
  REQUIRE(index.size() == 30);
  for (unsigned place = 0; place < 30; ++place) {
    const auto similar = index.similar(view_of(place, 1));
    REQUIRE(similar.size() > 1);
    CHECK(similar[0].place_idx == static_cast<int>(place));
    CHECK(similar[0].similarity > 1.5 * similar[1].similarity);
  }
}

TEST_CASE("the similarity of places is 1 with themselves and the same in both directions") {
  const auto a = view_of(1, 0), b = view_of(1, 1), c = view_of(2, 0);
  const PlaceIndex index({&a, &b, &c});
  CHECK(index.similarity(0, 0) == Approx(1));
  CHECK(index.similarity(0, 1) == index.similarity(1, 0));
  CHECK(index.similarity(0, 1) > index.similarity(0, 2));
}

TEST_CASE("places without descriptors are like no other") {
  const auto a = view_of(1, 0), empty = std::vector<Descriptor>{};
  const PlaceIndex index({&a, &empty});
  CHECK(index.similarity(0, 1) == 0);
  CHECK(index.similar(empty).empty());
}
