#include "pipeline/scene/labels.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace sediment {

LabelTable::LabelTable(std::vector<Label> labels) : labels_(std::move(labels)) {
  std::sort(labels_.begin(), labels_.end(), [](const Label& a, const Label& b) { return a.id < b.id; });
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (i > 0 && labels_[i].id == labels_[i - 1].id)
      throw std::invalid_argument("label id " + std::to_string(labels_[i].id) + " is given twice: \"" +
                                  labels_[i - 1].name + "\" and \"" + labels_[i].name + "\"");
    if (!names.insert(labels_[i].name).second)
      throw std::invalid_argument("label name \"" + labels_[i].name + "\" is given twice");
  }
}

const Label* LabelTable::find(std::string_view name) const {
  const auto found =
      std::find_if(labels_.begin(), labels_.end(), [&](const Label& l) { return l.name == name; });
  return found == labels_.end() ? nullptr : &*found;
}

const Label* LabelTable::find(std::uint32_t id) const {
  const auto found = std::find_if(labels_.begin(), labels_.end(), [&](const Label& l) { return l.id == id; });
  return found == labels_.end() ? nullptr : &*found;
}

}  // namespace sediment
