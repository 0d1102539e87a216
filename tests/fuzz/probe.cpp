#include "fuzz/probe.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid::fuzz {
namespace {

enum Exit { kAccepted = 0, kRefused = 3, kThrew = 4 };  // sanitizers exit with 1

void set_limit(__rlimit_resource resource, rlim_t most) {
  const rlimit limit{most, most};
  ::setrlimit(resource, &limit);
}

[[noreturn]] void be_child(const std::function<void()>& work, int most_seconds,
                           long long address_space) {
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, static_cast<rlim_t>(most_seconds));
  if (address_space > 0) set_limit(RLIMIT_AS, static_cast<rlim_t>(address_space));
  ::alarm(static_cast<unsigned>(10 * most_seconds));
  int code = kAccepted;
  try {
    work();
  } catch (const Error&) {
    code = kRefused;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s\n", exception.what());
    code = kThrew;
  } catch (...) {
    code = kThrew;
  }
  ::_exit(code);
}

std::string cause_of(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return "signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  }
  if (WEXITSTATUS(status) == kThrew) return "an exception that is no Error";
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Outcome probe(const std::function<void()>& work, int most_seconds, long long address_space) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) be_child(work, most_seconds, address_space);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "wait4");
  }
  Outcome outcome;
  outcome.seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  outcome.memory = 1024LL * usage.ru_maxrss;
  const bool exited = WIFEXITED(status);
  if (exited && WEXITSTATUS(status) == kAccepted) outcome.end = Outcome::End::kAccepted;
  if (exited && WEXITSTATUS(status) == kRefused) outcome.end = Outcome::End::kRefused;
  if (outcome.end == Outcome::End::kBroken) outcome.cause = cause_of(status);
  return outcome;
}

}  // namespace limpid::fuzz
