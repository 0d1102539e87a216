#include "farm/programs.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <set>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// The running programs, and whether new ones may start.
struct Running {
  std::mutex mutex;
  std::set<pid_t> processes;
  bool stopped = false;
};

Running& running() {
  static Running all;
  return all;
}

/// The output of a program is written to `in`, and read from `out`.
struct Pipe {
  int out = -1, in = -1;
  Pipe() {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) {
      throw Error(std::string("cannot make a pipe: ") + std::strerror(errno), Fault::kRetry);
    }
    out = ends[0];
    in = ends[1];
  }
  ~Pipe() {
    ::close(out);
    close_in();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_in() {
    if (in >= 0) ::close(in);
    in = -1;
  }
};

pid_t start(const std::vector<std::string>& words, const Pipe& out, const Pipe& err) {
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t files;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_init(&files);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(
      &attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, out.in, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, err.in, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int failed = [&] {
    const std::lock_guard lock(running().mutex);
    if (running().stopped) return ECANCELED;
    const int code =
        ::posix_spawnp(&process, arguments.front(), &files, &attributes, arguments.data(), environ);
    if (code == 0) running().processes.insert(process);
    return code;
  }();
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  if (failed != 0) {
    throw Error(words.front() + ": cannot be started (" + std::strerror(failed) + ")",
                failed == EAGAIN || failed == ENOMEM ? Fault::kRetry : Fault::kJob);
  }
  return process;
}

/// Reads until both pipes have ended.
void read_all(const Pipe& out, const Pipe& err, ProgramRun& run) {
  std::array<pollfd, 2> ends{{{out.out, POLLIN, 0}, {err.out, POLLIN, 0}}};
  std::array<std::string*, 2> texts{&run.out, &run.err};
  std::array<char, 4096> part;
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (::poll(ends.data(), ends.size(), -1) < 0) continue;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      const ssize_t got = ::read(ends[i].fd, part.data(), part.size());
      if (got > 0) {
        texts[i]->append(part.data(), static_cast<std::size_t>(got));
      } else if (got == 0 || errno != EINTR) {
        ends[i].fd = -1;  // poll() skips it
      }
    }
  }
}

}  // namespace

ProgramRun run_program(const std::vector<std::string>& words) {
  Pipe out, err;
  ProgramRun run;
  const auto began = std::chrono::steady_clock::now();
  const pid_t process = start(words, out, err);
  out.close_in();
  err.close_in();
  read_all(out, err, run);
  // Until it is waited for, its process number is not reused: it can be signalled.
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT) != 0) {
  }
  {
    const std::lock_guard lock(running().mutex);
    running().processes.erase(process);
  }
  int status = 0;
  rusage used{};
  while (::wait4(process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  run.memory = std::int64_t{used.ru_maxrss} * 1024;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return run;
}

void stop_programs() {
  const std::lock_guard lock(running().mutex);
  running().stopped = true;
  for (const pid_t process : running().processes) ::kill(-process, SIGTERM);
}

std::string last_words(const ProgramRun& run) {
  const std::size_t end = run.err.find_last_not_of('\n');
  if (end == std::string::npos) {
    return run.code < 0 ? "ended by signal " + std::to_string(-run.code)
                        : "ended with exit code " + std::to_string(run.code);
  }
  const std::size_t before = run.err.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return run.err.substr(begin, end + 1 - begin);
}

}  // namespace limpid
