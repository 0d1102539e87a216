#include "core/threads.h"

#include <atomic>
#include <vector>

#include <pthread.h>

namespace limpid {
namespace {

void* wait_for_the_end(void* may_end) {
  static_cast<std::atomic<bool>*>(may_end)->wait(false);
  return nullptr;
}

}  // namespace

std::size_t usual_stack_bytes() {
  pthread_attr_t attributes;
  std::size_t bytes = 0;
  if (::pthread_getattr_default_np(&attributes) != 0) return bytes;
  ::pthread_attr_getstacksize(&attributes, &bytes);
  ::pthread_attr_destroy(&attributes);
  return bytes;
}

int threads_to_be_had(int wanted, std::size_t stack_bytes) {
  std::atomic<bool> may_end = false;
  std::vector<pthread_t> threads;
  threads.reserve(static_cast<std::size_t>(wanted));
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, stack_bytes);
  pthread_t thread{};
  while (static_cast<int>(threads.size()) < wanted &&
         ::pthread_create(&thread, &attributes, wait_for_the_end, &may_end) == 0) {
    threads.push_back(thread);
  }
  ::pthread_attr_destroy(&attributes);
  may_end = true;
  may_end.notify_all();
  for (const pthread_t made : threads) ::pthread_join(made, nullptr);
  return static_cast<int>(threads.size());
}

}  // namespace limpid
