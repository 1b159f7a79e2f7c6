// The cheapest stage there can be, for what the runner itself costs: a static program that is whatever its
// file is called (step1, step2, ...) and appends its name and its number to the text that it reads.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace {

std::string text_in(const std::string& path) {
  std::string text;
  char buffer[4096];
  struct stat raw {};
  const bool is_folder = stat(path.c_str(), &raw) == 0 && S_ISDIR(raw.st_mode);
  std::FILE* file = std::fopen((is_folder ? path + "/text.txt" : path).c_str(), "rb");
  if (file == nullptr) return text;
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, count);
  std::fclose(file);
  return text;
}

/// In place and piece by piece, as most programs write.
bool write_text(const std::string& path, const std::string& text, double seconds) {
  constexpr std::size_t kPieces = 16;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  bool written = true;
  const std::size_t pieces = seconds > 0 ? kPieces : 1, length = text.size() / pieces + 1;
  for (std::size_t at = 0; at < text.size() && written; at += length) {
    const std::size_t count = std::min(length, text.size() - at);
    written = std::fwrite(text.data() + at, 1, count, file) == count && std::fflush(file) == 0;
    if (seconds > 0) usleep(static_cast<useconds_t>(1e6 * seconds / kPieces));
  }
  return std::fclose(file) == 0 && written;
}

/// Many bytes that depend on every byte of the seed.
std::string long_text(const std::string& seed, int kilobytes) {
  std::uint64_t state = XXH3_64bits(seed.data(), seed.size());
  std::string text;
  for (int i = 0; i < kilobytes * 1000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    text += i % 80 == 79 ? '\n' : static_cast<char>('a' + (state >> 33) % 26);
  }
  return text;
}

std::string digest_of(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[40];
  std::snprintf(text, sizeof text, "x3:%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

std::string manifest_of(const std::string& name, const std::string& text) {
  const std::string digest = digest_of(text), bytes = std::to_string(text.size());
  return R"({"format":"sediment-manifest 1","stage":")" + name + R"(","id":")" +
         digest_of(bytes + ' ' + digest + " text.txt\n") + R"(","bytes":)" + bytes +
         R"(,"files":[{"path":"text.txt","bytes":)" + bytes + R"(,"digest":")" + digest + "\"}]}\n";
}

/// It reads anything: the kind "file" stands for every kind.
int describe(const std::string& name) {
  std::printf(
      R"({"format":"sediment-stage 1","stage":"%s","version":"1","summary":"A line more",)"
      R"("reads":[{"role":"text","kind":"file","optional":false,"help":"what to begin with"}],)"
      R"("writes":[{"role":"text","kind":"cloud","optional":false,"help":"text.txt"}],)"
      R"("parameters":[{"name":"number","type":"integer","default":0,"help":"a number",)"
      R"("affects_result":true},{"name":"kilobytes","type":"integer","default":0,"help":"of text",)"
      R"("affects_result":true},{"name":"seconds","type":"number","default":0.0,"help":"that writing takes",)"
      R"("affects_result":true}]})"
      "\n",
      name.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path = argv[0], name = path.substr(path.rfind('/') + 1);
  std::string in, out, number = "0";
  int kilobytes = 0;
  double seconds = 0;
  const auto value_of = [](const char* argument, const char* flag) -> const char* {
    const std::size_t length = std::strlen(flag);
    return std::strncmp(argument, flag, length) == 0 ? argument + length : nullptr;
  };
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--describe") == 0) return describe(name);
    if (const char* text = value_of(argv[i], "--number=")) number = text;
    if (const char* text = value_of(argv[i], "--kilobytes=")) kilobytes = std::atoi(text);
    if (const char* text = value_of(argv[i], "--seconds=")) seconds = std::atof(text);
    if (i + 1 < argc && std::strcmp(argv[i], "--text") == 0) in = argv[++i];
    if (i + 1 < argc && std::strcmp(argv[i], "--out") == 0) out = argv[++i];
  }
  std::string text = text_in(in) + name + ' ' + number + '\n';
  if (kilobytes > 0) text = long_text(text, kilobytes);
  mkdir(out.c_str(), 0777);
  const bool written = write_text(out + "/text.txt", text, seconds) &&
                       write_text(out + "/manifest.json", manifest_of(name, text), 0);
  return written ? 0 : 1;
}
