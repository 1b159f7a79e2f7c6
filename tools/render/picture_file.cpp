#include "tools/render/picture_file.hpp"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace sediment::render {

void write_picture(const std::filesystem::path& file, const cv::Mat& bgr) {
  const std::string extension = file.extension().string();
  std::vector<unsigned char> bytes;
  if (extension == ".png")
    cv::imencode(extension, bgr, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
  else if (extension == ".jpg" || extension == ".jpeg")
    cv::imencode(extension, bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  else
    throw std::runtime_error("cannot write " + file.string() + ": a picture ends in .png, .jpg or .jpeg");
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace sediment::render
