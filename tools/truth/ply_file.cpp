#include "tools/truth/ply_file.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/artifacts/file_bytes.hpp"

namespace sediment::tools {
namespace {

struct Property {
  std::string name, type;
  std::size_t offset = 0;
};

struct Header {
  bool ascii = false;
  std::size_t vertices = 0, vertex_bytes = 0, body = 0;
  std::vector<Property> properties;
};

const std::map<std::string, std::size_t> kBytes{{"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2},
                                                {"int", 4},   {"uint", 4},   {"float", 4},   {"double", 8},
                                                {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2},
                                                {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};

void add_property(Header& header, std::istringstream& words) {
  Property property;
  words >> property.type >> property.name;
  const auto known = kBytes.find(property.type);
  if (known == kBytes.end())
    throw std::runtime_error("vertices with the type " + property.type + " cannot be read");
  property.offset = header.vertex_bytes;
  header.vertex_bytes += known->second;
  header.properties.push_back(property);
}

Header parse_header(const std::string& content) {
  Header header;
  std::istringstream stream(content);
  std::string line, element;
  std::getline(stream, line);
  if (!line.starts_with("ply")) throw std::runtime_error("not a PLY file");
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string key, value;
    words >> key;
    if (key == "format") {
      words >> value;
      if (value != "ascii" && value != "binary_little_endian")
        throw std::runtime_error("the format " + value + " cannot be read");
      header.ascii = value == "ascii";
    } else if (key == "element") {
      if (element.empty()) {
        words >> element >> header.vertices;
        if (element != "vertex") throw std::runtime_error("the first element must be the vertices");
      } else {
        element = "other";
      }
    } else if (key == "property" && element == "vertex") {
      add_property(header, words);
    } else if (key == "end_header") {
      header.body = static_cast<std::size_t>(stream.tellg());
      return header;
    }
  }
  throw std::runtime_error("truncated header");
}

double value_at(const Property& property, const char* vertex) {
  const auto load = [&](auto value) {
    std::memcpy(&value, vertex + property.offset, sizeof value);
    return static_cast<double>(value);
  };
  const std::string& type = property.type;
  if (type == "float" || type == "float32") return load(float{});
  if (type == "double" || type == "float64") return load(double{});
  if (type == "uchar" || type == "uint8") return load(std::uint8_t{});
  if (type == "char" || type == "int8") return load(std::int8_t{});
  if (type == "ushort" || type == "uint16") return load(std::uint16_t{});
  if (type == "short" || type == "int16") return load(std::int16_t{});
  if (type == "uint" || type == "uint32") return load(std::uint32_t{});
  return load(std::int32_t{});
}

void set(LabelledPoint& point, const std::string& name, double value) {
  if (name == "x") point.x = static_cast<float>(value);
  if (name == "y") point.y = static_cast<float>(value);
  if (name == "z") point.z = static_cast<float>(value);
  if (name == "red") point.r = static_cast<std::uint8_t>(value);
  if (name == "green") point.g = static_cast<std::uint8_t>(value);
  if (name == "blue") point.b = static_cast<std::uint8_t>(value);
  if (name == "label") point.label = static_cast<std::uint32_t>(value);
  if (name == "instance") point.instance = static_cast<std::uint32_t>(value);
}

LabelledCloud read_vertices(const Header& header, const std::string& content) {
  LabelledCloud cloud(header.vertices);
  if (header.ascii) {
    std::istringstream stream(content.substr(header.body));
    double value = 0;
    for (LabelledPoint& point : cloud)
      for (const Property& property : header.properties) {
        if (!(stream >> value)) throw std::runtime_error("truncated");
        set(point, property.name, value);
      }
    return cloud;
  }
  if (content.size() - header.body < header.vertices * header.vertex_bytes)
    throw std::runtime_error("truncated");
  for (std::size_t i = 0; i < header.vertices; ++i)
    for (const Property& property : header.properties)
      set(cloud[i], property.name,
          value_at(property, content.data() + header.body + i * header.vertex_bytes));
  return cloud;
}

}  // namespace

LabelledCloud read_ply(const std::filesystem::path& file) {
  const std::string content = read_bytes(file);
  try {
    const Header header = parse_header(content);
    for (const char* name : {"x", "y", "z"}) {
      const auto& all = header.properties;
      if (std::none_of(all.begin(), all.end(), [&](const Property& p) { return p.name == name; }))
        throw std::runtime_error("the vertices have no x y z");
    }
    return read_vertices(header, content);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace sediment::tools
