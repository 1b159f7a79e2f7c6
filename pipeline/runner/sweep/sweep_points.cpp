#include "pipeline/runner/sweep/sweep_points.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>

#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;

constexpr const char* kSweepFormat = "sediment-sweep 1";
constexpr std::size_t kMostInstances = 1'000'000;

bool is_source(const std::string& name) {
  return name.find('.') == std::string::npos;
}

/// What a source is called in names and tables: its file without extension, or its folder.
std::string short_name(const std::string& path) {
  const fs::path file = fs::path(path).lexically_normal();
  const fs::path named = file.has_filename() ? file : file.parent_path();
  return (named.filename() == "sequence.yaml" ? named.parent_path().filename() : named.stem()).string();
}

std::string as_file_name(std::string text) {
  for (char& c : text)
    if (c == '/' || c == ' ' || static_cast<unsigned char>(c) < 32) c = '_';
  return text;
}

std::string name_of(const SweepPoint& point) {
  std::string sources, parameters;
  for (const auto& [name, value] : point.values) {
    std::string& part = is_source(name) ? sources : parameters;
    part += (part.empty() ? "" : ",") + as_file_name(is_source(name) ? value : name + '=' + value);
  }
  if (sources.empty() || parameters.empty()) return sources + parameters;
  return sources + '/' + parameters;
}

void add(SweepPoint& point, const Axis& axis, std::size_t idx, const std::string& file) {
  for (std::size_t i = 0; i < axis.names.size(); ++i) {
    const std::string& name = axis.names[i];
    const std::string& value = axis.points[idx][i];
    const std::string said = file + ':' + std::to_string(axis.line) + ": ";
    (is_source(name) ? point.sources : point.parameters).push_back({name, value, said});
    // Of sources that walk together the first names the point.
    if (is_source(name) && i > 0 && is_source(axis.names[0])) continue;
    point.values.emplace_back(name, is_source(name) ? short_name(value) : value);
  }
}

}  // namespace

std::vector<SweepPoint> points_of(const SweepFile& sweep) {
  std::size_t count = 1;
  for (const Axis& axis : sweep.axes)
    count *= std::max<std::size_t>(1, std::min(axis.points.size(), kMostInstances));
  if (count > kMostInstances)
    throw contract::UsageError(sweep.file.string() + " has more than a million instances");
  std::vector<SweepPoint> points;
  std::set<std::string> names;
  for (std::size_t number = 0; number < count; ++number) {
    SweepPoint point;
    std::size_t below = count;
    for (const Axis& axis : sweep.axes) {
      if (axis.points.empty()) continue;
      below /= axis.points.size();
      add(point, axis, number / below % axis.points.size(), sweep.file.string());
    }
    point.name = name_of(point);
    for (int again = 2; !names.insert(point.name).second; ++again)
      point.name = name_of(point) + '~' + std::to_string(again);
    points.push_back(std::move(point));
  }
  return points;
}

void write_points(const std::vector<SweepPoint>& points, const fs::path& out) {
  nlohmann::ordered_json json = {{"format", kSweepFormat}, {"instances", nlohmann::ordered_json::array()}};
  for (const SweepPoint& point : points)
    json["instances"].push_back({{"name", point.name}, {"values", point.values}});
  const std::string text = json.dump() + '\n';
  std::ifstream before(out / "sweep.json", std::ios::binary);
  if (before && std::string(std::istreambuf_iterator<char>(before), {}) == text) return;
  fs::create_directories(out);
  const fs::path fresh = out / (".sweep.json." + std::to_string(getpid()));
  std::ofstream stream(fresh, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + fresh.string() + ": " + std::strerror(errno));
  fs::rename(fresh, out / "sweep.json");
}

std::vector<SweepPoint> read_points(const fs::path& out) {
  std::ifstream stream(out / "sweep.json", std::ios::binary);
  if (!stream) {
    if (!fs::exists(out / "run.json"))
      throw contract::UsageError(out.string() +
                                 " is no folder of results (it has no run.json and no sweep.json)");
    return {SweepPoint{}};
  }
  try {
    const Json json = Json::parse(stream);
    if (json.at("format") != kSweepFormat)
      throw std::runtime_error("unknown format " + json.at("format").dump());
    std::vector<SweepPoint> points;
    for (const Json& one : json.at("instances"))
      points.push_back({one.at("name"), one.at("values").get<decltype(SweepPoint::values)>(), {}, {}});
    return points;
  } catch (const std::exception& error) {
    throw std::runtime_error((out / "sweep.json").string() + ": " + error.what());
  }
}

}  // namespace sediment::runner
