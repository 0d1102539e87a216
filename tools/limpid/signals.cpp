#include "signals.h"

#include <atomic>
#include <csignal>
#include <thread>

#include "limpid/files/unfinished.h"

namespace limpid::tool {
namespace {

std::atomic<void (*)()> also_done = nullptr;

bool is_ignored(int signal) {
  struct sigaction now {};
  return ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

/// Waits for one of the signals, which are blocked in all threads, and ends by it.
void wait_for(const sigset_t& signals) {
  int signal = 0;
  if (::sigwait(&signals, &signal) != 0) return;
  if (const auto work = also_done.load()) work();
  const auto none_begins_any_more = remove_unfinished_files();
  sigset_t this_one;
  ::sigemptyset(&this_one);
  ::sigaddset(&this_one, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
  ::raise(signal);
}

}  // namespace

void end_cleanly_on_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  sigset_t signals;
  ::sigemptyset(&signals);
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!is_ignored(signal)) ::sigaddset(&signals, signal);
  }
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_for, signals).detach();
}

void also_on_signals(void (*work)()) { also_done = work; }

}  // namespace limpid::tool
