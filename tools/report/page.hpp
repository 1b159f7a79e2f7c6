#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sediment::report {

using Json = nlohmann::ordered_json;

/// A page under construction: facts as JSON, and blocks of bytes (points, pictures) that the page's program
/// reads when it needs them. Everything ends up in one HTML file.
class Page {
 public:
  /// The name of a block in the page. `key` names its content, so that what several instances share (pictures
  /// of one sequence, results of one stage) is made and stored once.
  std::string block(const std::string& key, const std::function<std::string()>& bytes);

  /// Replaces the file by the whole page. Throws std::runtime_error that names the file; contract::UsageError
  /// if this program was built without its page.
  void write(const std::filesystem::path& file, const Json& facts) const;

 private:
  std::map<std::string, std::string> names_;
  std::vector<std::string> blocks_;  ///< base64
};

/// RFC 4648.
std::string base64(std::string_view bytes);

/// JSON that may stand in a <script> element: "</" and "<!--" do not occur in it.
std::string script_text(const Json& json);

}  // namespace sediment::report
