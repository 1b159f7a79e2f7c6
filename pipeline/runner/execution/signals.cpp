#include "pipeline/runner/execution/signals.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <stdexcept>

namespace sediment::runner {

using std::chrono::steady_clock;

Signals::Signals() {
  sigset_t watched;
  sigemptyset(&watched);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) sigaddset(&watched, signal);
  sigprocmask(SIG_BLOCK, &watched, nullptr);
  signal(SIGPIPE, SIG_IGN);
  descriptor_ = signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor_ < 0) throw std::runtime_error("cannot watch signals");
}

Signals::~Signals() {
  close(descriptor_);
}

Signals::Seen Signals::wait(int limit_ms) {
  pollfd watched{descriptor_, POLLIN, 0};
  poll(&watched, 1, limit_ms);
  Seen seen;
  signalfd_siginfo one;
  while (read(descriptor_, &one, sizeof one) == sizeof one) {
    if (one.ssi_signo == SIGCHLD)
      seen.child_ended = true;
    else
      seen.interrupted = true;
  }
  if (deadline_ && steady_clock::now() >= *deadline_) {
    deadline_.reset();
    seen.interrupted = true;
  }
  return seen;
}

void Signals::interrupt_again_after(double seconds) {
  deadline_ = steady_clock::now() + std::chrono::milliseconds(static_cast<int>(1000 * seconds));
}

}  // namespace sediment::runner
