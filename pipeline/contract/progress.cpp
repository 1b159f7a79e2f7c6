#include "pipeline/contract/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sediment::contract {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// How often the line is redrawn on a terminal, and how often a line is printed in a pipe.
constexpr std::chrono::milliseconds kRedraw = 100ms, kReport = 2s;
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(std::string name, std::size_t total, std::string unit)
    : name_(std::move(name)),
      total_(total),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      started_(steady_clock::now()),
      shown_(started_) {}

Progress::~Progress() {
  const std::lock_guard lock(mutex_);
  show(done_, true);
}

void Progress::advance(std::size_t steps) {
  done_ += steps;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto now = steady_clock::now();
  if (now - shown_ < (terminal_ ? kRedraw : kReport)) return;
  shown_ = now;
  show(done_, false);
}

void Progress::show(std::size_t done, bool last) {
  const double elapsed_s = std::chrono::duration<double>(steady_clock::now() - started_).count();
  const double rate = elapsed_s > 0 ? static_cast<double>(done) / elapsed_s : 0;
  if (!terminal_) {
    std::fprintf(stderr, "%s: %zu/%zu %s, %.1f s\n", name_.c_str(), done, total_, unit_.c_str(), elapsed_s);
    return;
  }
  const int filled = total_ > 0 ? static_cast<int>(kBarWidth * std::min(done, total_) / total_) : kBarWidth;
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kBarWidth, '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %zu/%zu %s, %.1f/s, %.1f s%s", name_.c_str(), bar.c_str(), done,
               total_, unit_.c_str(), rate, elapsed_s, last ? "\n" : "");
  std::fflush(stderr);
}

}  // namespace sediment::contract
