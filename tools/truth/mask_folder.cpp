#include "tools/truth/mask_folder.hpp"

#include <algorithm>
#include <stdexcept>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/text_table.hpp"

namespace sediment::tools {

MaskFolder::MaskFolder(const std::filesystem::path& folder)
    : images_(std::filesystem::is_directory(folder / "masks") ? folder / "masks" : folder) {
  if (!std::filesystem::is_directory(images_))
    throw std::runtime_error(folder.string() + ": there is no such folder");
  std::vector<std::pair<double, std::string>> found;
  for (const auto& entry : std::filesystem::directory_iterator(images_)) {
    if (entry.path().extension() != ".png") continue;
    const std::string stamp = entry.path().stem().string();
    const auto stamp_s = parse_number(stamp);
    if (!stamp_s)
      throw std::runtime_error(entry.path().string() + ": the name of a mask is the stamp of its frame");
    found.emplace_back(*stamp_s, stamp);
  }
  if (found.empty()) throw std::runtime_error(images_.string() + ": holds no mask (STAMP.png)");
  std::sort(found.begin(), found.end());
  for (auto& [stamp_s, stamp] : found) stamps_.push_back(std::move(stamp));
  if (images_ != folder && std::filesystem::exists(folder / "instances.json")) instances_.emplace(folder);
}

cv::Mat MaskFolder::dynamic(const std::string& stamp) const {
  if (!instances_) return read_gray8(file_of(stamp));
  const InstanceMask mask = instances_->read(stamp);
  std::vector<std::uint8_t> value_of(65536, 0);
  for (const Instance& instance : mask.instances) {
    const Label* label = default_labels().find(instance.class_name);
    if (label != nullptr && label->prior_dynamic)
      value_of[static_cast<std::size_t>(instance.id)] = kPriorDynamic;
  }
  cv::Mat dynamic(mask.ids.size(), CV_8UC1);
  for (int y = 0; y < dynamic.rows; ++y)
    for (int x = 0; x < dynamic.cols; ++x)
      dynamic.at<std::uint8_t>(y, x) = value_of[mask.ids.at<std::uint16_t>(y, x)];
  return dynamic;
}

}  // namespace sediment::tools
