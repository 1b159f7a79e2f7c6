#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sediment::test {

/// A file or folder of the real data and networks, which are never part of this repository: looked for in the
/// folder named by SEDIMENT_SHARED, else in `shared/` beside the checkout. Where it is missing, prints
/// "skipped: needs shared/<relative>" (ctest then reports the test as skipped) and returns nothing:
///
///     const auto model = needs("models/yolov8n-seg-320.onnx");
///     if (!model) return;
std::optional<std::filesystem::path> needs(const std::string& relative);

}  // namespace sediment::test
