#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/contract/parameter.hpp"

namespace sediment::runner {

/// The only proof that a result was made: what it was made from, what came out, what it took.
struct Receipt {
  std::string key;       ///< id of the key
  contract::Json parts;  ///< the key in clear
  std::string object;    ///< content id of the result folder
  std::uint64_t bytes = 0;
  std::vector<std::pair<std::string, std::uint64_t>>
      files;  ///< path in the result folder, size; manifest included
  contract::Json metrics;
  std::vector<std::string> argv;
  double wall_s = 0, cpu_s = 0;
  std::uint64_t peak_bytes = 0;
  std::string host;
  std::string started;  ///< UTC, ISO 8601
  std::string why;      ///< what it was run for
  contract::Json
      accepted;     ///< if it was not made but taken over by `sediment accept`: from which key, when, by whom
  std::string log;  ///< what the stage said; of a long log the end
};

/// JSON that ends with a digest of all before it.
std::string text_of(const Receipt& receipt);

/// Throws std::runtime_error if the text is cut, changed or of another format.
Receipt receipt_from(const std::string& text);

}  // namespace sediment::runner
