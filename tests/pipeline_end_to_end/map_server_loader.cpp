#include "tests/pipeline_end_to_end/map_server_loader.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace sediment::test {
namespace {

struct Picture {
  int width = 0, height = 0;
  std::string pixels;
};

Picture read_pgm(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string magic, word;
  stream >> magic;
  int numbers[3] = {0, 0, 0};
  for (int& number : numbers) {
    while (stream >> word && word[0] == '#') std::getline(stream, word);
    number = std::stoi(word);
  }
  stream.get();  // the one blank behind the largest value
  Picture picture{numbers[0], numbers[1], {std::istreambuf_iterator<char>(stream), {}}};
  if (magic != "P5" || numbers[2] != 255) throw std::runtime_error(file.string() + ": no binary 8-bit PGM");
  if (picture.pixels.size() != static_cast<std::size_t>(picture.width) * picture.height)
    throw std::runtime_error(file.string() + ": " + std::to_string(picture.pixels.size()) + " pixels for " +
                             std::to_string(picture.width) + " x " + std::to_string(picture.height));
  return picture;
}

}  // namespace

LoadedMap load_map(const std::filesystem::path& yaml) {
  const YAML::Node map = YAML::LoadFile(yaml);
  const auto image = std::filesystem::path(map["image"].as<std::string>());
  const double resolution_m = map["resolution"].as<double>();
  const int negate = map["negate"].as<int>();
  const double occupied_above = map["occupied_thresh"].as<double>();
  const double free_below = map["free_thresh"].as<double>();
  if (image.is_absolute()) throw std::runtime_error(yaml.string() + ": image is an absolute path");
  if (!(resolution_m > 0)) throw std::runtime_error(yaml.string() + ": resolution is not positive");
  if (map["origin"].size() != 3) throw std::runtime_error(yaml.string() + ": origin has not three numbers");
  for (const YAML::Node& number : map["origin"])
    if (!std::isfinite(number.as<double>()))
      throw std::runtime_error(yaml.string() + ": origin is not finite");

  const Picture picture = read_pgm(yaml.parent_path() / image);
  LoadedMap loaded{picture.width, picture.height};
  for (const char pixel : picture.pixels) {
    const int grey = static_cast<unsigned char>(pixel);
    const double occupancy = (negate != 0 ? grey : 255 - grey) / 255.0;
    if (occupancy > occupied_above)
      ++loaded.occupied;
    else if (occupancy < free_below)
      ++loaded.free;
    else
      ++loaded.unknown;
  }
  return loaded;
}

}  // namespace sediment::test
