#include "tools/report/page.hpp"

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/contract/errors.hpp"
#include "tools/report/page_text.hpp"

namespace sediment::report {

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto at = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    text += kDigits[three >> 18];
    text += kDigits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? kDigits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kDigits[three & 63] : '=';
  }
  return text;
}

std::string script_text(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string Page::block(const std::string& key, const std::function<std::string()>& bytes) {
  std::string& name = names_[key];
  if (name.empty()) {
    blocks_.push_back(base64(bytes()));
    name = "block-" + std::to_string(blocks_.size());
  }
  return name;
}

void Page::write(const std::filesystem::path& file, const Json& facts) const {
  static constexpr std::string_view kPlace = "<!-- facts and blocks -->";
  const std::string_view text = page_text();
  const std::size_t place = text.find(kPlace);
  if (place == text.npos)
    throw contract::UsageError(
        "this program was built without its page: scripts/fetch_web.sh brings what it needs, then build "
        "again");
  std::vector<std::string> chunks;
  chunks.emplace_back(text.substr(0, place));
  chunks.push_back("<script type=\"application/json\" id=\"facts\">" + script_text(facts) + "</script>\n");
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    chunks.push_back("<script type=\"text/plain\" id=\"block-" + std::to_string(i + 1) + "\">" + blocks_[i] +
                     "</script>\n");
  chunks.emplace_back(text.substr(place + kPlace.size()));
  std::string whole;
  for (const std::string& chunk : chunks) whole += chunk;
  write_bytes(file, {whole});
}

}  // namespace sediment::report
