#include "pipeline/runner/execution/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace sediment::runner {
namespace {

/// All that the child needs between fork and exec, prepared before: only system calls are allowed there.
struct Prepared {
  char* const* argv;
  char* const* environment;
  const char* folder;
  int in, out, err;
  pid_t parent;
  volatile int error;  ///< errno of the child; it shares our memory until it executes the program
};

[[noreturn]] void become(Prepared& prepared) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != prepared.parent) _exit(127);  // the parent died before the line above
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (dup2(prepared.in, 0) >= 0 && dup2(prepared.out, 1) >= 0 && dup2(prepared.err, 2) >= 0 &&
      chdir(prepared.folder) == 0)
    execve(prepared.argv[0], prepared.argv, prepared.environment);
  prepared.error = errno;
  _exit(127);
}

/// vfork: the cost does not grow with the memory of the runner.
[[gnu::noinline]] pid_t fork_and_become(Prepared& prepared) {
  const pid_t pid = vfork();
  if (pid == 0) become(prepared);
  return pid;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

std::string content_of(int descriptor) {
  std::string text;
  char buffer[1 << 14];
  lseek(descriptor, 0, SEEK_SET);
  for (ssize_t count; (count = read(descriptor, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  return text;
}

/// Closes a file descriptor at the end of the scope.
struct Closing {
  int descriptor;
  ~Closing() { close(descriptor); }
};

}  // namespace

pid_t start(const Launch& launch) {
  static const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const std::vector<char*> argv = pointers(launch.argv), environment = pointers(launch.environment);
  Prepared prepared{
      argv.data(), environment.data(), launch.folder.c_str(), nothing, launch.out, launch.err, getpid(), 0};
  const pid_t pid = fork_and_become(prepared);
  const int error = pid < 0 ? errno : prepared.error;
  if (pid > 0 && error != 0) waitpid(pid, nullptr, 0);
  if (error != 0) throw std::runtime_error("cannot start " + launch.argv[0] + ": " + std::strerror(error));
  return pid;
}

std::optional<Ending> reap(pid_t pid) {
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != pid)
    return std::nullopt;
  signal_group(pid,
               SIGKILL);  // while the dead leader still keeps the number of the group from being used anew
  int status = 0;
  rusage usage{};
  wait4(pid, &status, 0, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  Ending ending;
  ending.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  ending.exit_code = ending.signal != 0 ? 128 + ending.signal : WEXITSTATUS(status);
  ending.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ending.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return ending;
}

void adopt_orphans() {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void end_orphans(const std::filesystem::path& home) {
  const std::string mark = "HOME=" + home.string() + '\0';
  // A dead orphan's own children become ours in turn: until there is none.
  for (bool found = true; found;) {
    found = false;
    std::ifstream children("/proc/self/task/" + std::to_string(gettid()) + "/children");
    for (pid_t child = 0; children >> child;) {
      std::ifstream stream("/proc/" + std::to_string(child) + "/environ", std::ios::binary);
      const std::string environment(std::istreambuf_iterator<char>(stream), {});
      if (environment.find(mark) == environment.npos) continue;
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      found = true;
    }
  }
}

void signal_group(pid_t pid, int signal) {
  kill(-pid, signal);
}

std::string output_of(const std::vector<std::string>& argv, int limit_s,
                      const std::vector<std::string>& environment) {
  const Closing out{memfd_create("stdout", MFD_CLOEXEC)}, err{memfd_create("stderr", MFD_CLOEXEC)};
  const pid_t pid = start({argv, environment, "/", out.descriptor, err.descriptor});
  const Closing watched{static_cast<int>(syscall(SYS_pidfd_open, pid, 0))};
  pollfd ended{watched.descriptor, POLLIN, 0};
  int count = 0;
  while ((count = poll(&ended, 1, limit_s * 1000)) < 0 && errno == EINTR) {
  }
  if (count == 0) signal_group(pid, SIGKILL);
  int status = 0;
  waitpid(pid, &status, 0);
  if (count == 0)
    throw std::runtime_error(argv[0] + " took longer than " + std::to_string(limit_s) + " s to answer");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(argv[0] + " failed: " + content_of(err.descriptor));
  return content_of(out.descriptor);
}

std::vector<std::string> fixed_environment(const std::filesystem::path& home) {
  return {"PATH=/usr/local/bin:/usr/bin:/bin",
          "LANG=C.UTF-8",
          "LC_ALL=C.UTF-8",
          "TZ=UTC",
          "HOME=" + home.string(),
          "TMPDIR=" + home.string()};
}

}  // namespace sediment::runner
