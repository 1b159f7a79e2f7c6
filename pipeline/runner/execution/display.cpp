#include "pipeline/runner/execution/display.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <vector>

namespace sediment::runner {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// How often a pipe hears from stages that run long.
constexpr auto kReport = 10s;
constexpr std::size_t kLogLines = 20;
/// More stages than this are counted only.
constexpr std::size_t kLiveLines = 8;

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

/// The first columns of a text in UTF-8, without control characters.
std::string shortened(const std::string& text, std::size_t width) {
  std::string line;
  std::size_t columns = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = (byte & 0xC0) == 0x80;
    if (!continues && columns++ == width) break;
    line += byte < 32 || byte == 127 ? ' ' : c;
  }
  return line;
}

/// The last lines of a log, indented.
std::string end_of_log(const std::string& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::string text;
  for (std::size_t i = lines.size() > kLogLines ? lines.size() - kLogLines : 0; i < lines.size(); ++i)
    text += "\n  | " + lines[i];
  return text;
}

}  // namespace

Display::Display() : terminal_(isatty(STDERR_FILENO) == 1), shown_(steady_clock::now()) {}

void Display::begin(std::size_t tasks) {
  tasks_ = tasks;
}

void Display::clear() {
  if (drawn_ > 1) std::fprintf(stderr, "\033[%zuA", drawn_ - 1);
  if (drawn_ > 0) std::fputs("\r\033[J", stderr);
  drawn_ = 0;
}

void Display::say(const std::string& line) {
  clear();
  std::fprintf(stderr, "%s\n", line.c_str());
}

void Display::started(const Task& task, const Attempt& attempt, double expected_s) {
  running_.push_back({&task.label, &attempt, expected_s});
  if (!terminal_) say(fmt::format("{}: runs ({})", task.label, task.why));
}

void Display::stopped(const Task& task) {
  running_.remove_if([&](const Running& one) { return one.label == &task.label; });
}

void Display::retries(const Task& task, const std::string& what, int allowed) {
  say(fmt::format("{}: {}; retry {} of {}{}", task.label, what, task.retries, allowed, end_of_log(task.log)));
}

void Display::waits(const Task& task) {
  if (told_.insert(task.label).second)
    say(fmt::format("{}: waits for another runner that makes it", task.label));
}

void Display::ended(const Task& task) {
  ++ended_;
  switch (task.outcome) {
    case Outcome::ran:
      return say(fmt::format("{}: ran in {:.1f} s [{}/{}]", task.label, task.wall_s, ended_, tasks_));
    case Outcome::failed:
      say(fmt::format("{}: FAILED: {}{}", task.label, task.why, end_of_log(task.log)));
      if (!task.log.empty()) say("  its log: " + task.log);
      return;
    case Outcome::interrupted:
      return say(task.label + ": interrupted");
    default:
      return;
  }
}

std::string Display::Running::text() const {
  std::string line = fmt::format("{}  {:.1f} s", *label, attempt->seconds());
  if (expected_s >= 1) line += fmt::format(" of about {:.0f} s", expected_s);
  const std::string said = attempt->last_words();
  return said.empty() ? line : line + "  " + said;
}

/// A line per stage that runs; none may wrap, or the next could not be drawn over it.
std::vector<std::string> Display::live_lines() const {
  const std::string count = fmt::format("[{}/{}] ", ended_, tasks_);
  std::vector<std::string> lines;
  for (const Running& one : running_) {
    if (lines.size() == kLiveLines) {
      lines.push_back(fmt::format("{:{}}and {} more", "", count.size(), running_.size() - kLiveLines));
      break;
    }
    lines.push_back((lines.empty() ? count : std::string(count.size(), ' ')) + one.text());
  }
  return lines;
}

void Display::draw() {
  clear();
  const auto width = static_cast<std::size_t>(terminal_width() - 1);
  for (const std::string& line : live_lines())
    std::fprintf(stderr, "%s%s", drawn_++ == 0 ? "" : "\n", shortened(line, width).c_str());
  std::fflush(stderr);
}

void Display::tick() {
  if (running_.empty()) return;
  if (terminal_) return draw();
  const auto now = steady_clock::now();
  if (now - shown_ < kReport) return;
  shown_ = now;
  for (const std::string& line : live_lines()) say(line);
}

void Display::end() {
  clear();
}

}  // namespace sediment::runner
