#include "pipeline/runner/execution/attempt.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "pipeline/contract/digest.hpp"
#include "pipeline/runner/store/store_layout.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;

/// Of a longer log a receipt keeps the end.
constexpr std::size_t kLogInReceipt_bytes = 64 * 1024;

std::string flag_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& item : value) text += (text.empty() ? "" : ",") + item.get<std::string>();
  return text;
}

std::string end_of(const fs::path& file, std::size_t bytes) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return "";
  const auto size = static_cast<std::size_t>(stream.tellg());
  std::string text(std::min(size, bytes), '\0');
  stream.seekg(static_cast<std::streamoff>(size - text.size()));
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

/// The manifest that the stage wrote, if it tells the truth about every file.
contract::Manifest checked_manifest(const fs::path& result, const std::string& stage) {
  if (!fs::is_directory(result)) throw std::runtime_error("left no result though it ended well");
  for (const auto& entry : fs::recursive_directory_iterator(result))
    if (entry.is_symlink() || (!entry.is_regular_file() && !entry.is_directory()))
      throw std::runtime_error("its result holds " + entry.path().filename().string() +
                               ", which is no regular file");
  const contract::Manifest claimed = contract::read_manifest(result);
  const contract::Manifest found = contract::manifest_of(result, stage);
  if (claimed.files != found.files) throw std::runtime_error("its manifest.json does not match its files");
  return found;
}

Json metrics_of(const fs::path& result) try {
  std::ifstream stream(result / "metrics.json");
  return stream ? Json::parse(stream) : Json();
} catch (const std::exception& error) {
  throw std::runtime_error(std::string("its metrics.json is no JSON: ") + error.what());
}

}  // namespace

std::vector<std::string> argv_of(const PlannedStage& stage, const std::vector<fs::path>& inputs,
                                 const fs::path& out, int threads) {
  std::vector<std::string> argv{stage.program->path.string()};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    argv.push_back("--" + stage.inputs[i].role);
    argv.push_back(inputs[i].string());
  }
  argv.insert(argv.end(), {"--out", out.string(), "--threads", std::to_string(threads)});
  for (const contract::Parameter& parameter : stage.program->description.parameters) {
    const Json& value = stage.params.at(parameter.name);
    if (value == parameter.default_value) continue;
    std::string flag = "--" + parameter.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    const std::string text = flag_text(value);
    if (!text.empty())
      argv.push_back(flag + '=' + text);
    else
      argv.insert(argv.end(), {flag, ""});
  }
  return argv;
}

Attempt::Attempt(Store& store, KeyLock lock, Key key, const PlannedStage& stage,
                 const std::vector<fs::path>& inputs, int threads, std::string why)
    : store_(store),
      lock_(std::move(lock)),
      key_(std::move(key)),
      folder_(store.attempts().take(key_.id)),
      started_(std::chrono::steady_clock::now()) {
  receipt_.argv = argv_of(stage, inputs, folder_ / "result", threads);
  receipt_.why = std::move(why);
  receipt_.host = host_name();
  receipt_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  const int out = open(log().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (out < 0) throw std::runtime_error("cannot write " + log().string() + ": " + std::strerror(errno));
  try {
    pid_ = start({receipt_.argv, fixed_environment(folder_), folder_, out, out});
  } catch (...) {
    close(out);
    throw;
  }
  close(out);
}

Attempt::~Attempt() {
  store_.attempts().give_back(folder_);
}

double Attempt::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

std::string Attempt::last_words() const {
  std::string text = end_of(log(), 512);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of("\r\n") + 1);
}

Receipt Attempt::finish(const Ending& ending) {
  receipt_.wall_s = seconds();
  receipt_.cpu_s = ending.cpu_s;
  receipt_.peak_bytes = ending.peak_bytes;
  if (ending.signal != 0)
    throw std::runtime_error(
        fmt::format("was killed by signal {} ({})", ending.signal, strsignal(ending.signal)));
  if (ending.exit_code != 0) throw std::runtime_error(fmt::format("exited with {}", ending.exit_code));
  const fs::path result = folder_ / "result";
  receipt_.key = key_.id;
  receipt_.parts = Json::parse(key_.text);
  const auto manifest = checked_manifest(result, receipt_.parts.at("stage"));
  receipt_.object = manifest.id();
  receipt_.bytes = manifest.bytes();
  for (const auto& file : manifest.files) receipt_.files.emplace_back(file.path, file.bytes);
  receipt_.files.emplace_back(contract::kManifestName, fs::file_size(result / contract::kManifestName));
  receipt_.metrics = metrics_of(result);
  receipt_.log = end_of(log(), kLogInReceipt_bytes);
  store_.publish_object(result, manifest);
  store_.publish_receipt(receipt_);
  return receipt_;
}

}  // namespace sediment::runner
