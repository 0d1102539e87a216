#include "out_of_memory.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

#include <sys/resource.h>
#include <unistd.h>

#include "limpid/files/unfinished.h"

namespace limpid::tool {
namespace {

/// "--max-memory 64M and ulimit -v 65536", in static memory.
std::array<char, 256> limits_named;

void add_limit(const char* name, const char* value) {
  const std::size_t length = std::strlen(limits_named.data());
  std::snprintf(limits_named.data() + length, limits_named.size() - length, "%s%s %s",
                length > 0 ? " and " : "", name, value);
}

void add_system_limit(const char* name, __rlimit_resource_t resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::array<char, 32> kibibytes;
  std::snprintf(kibibytes.data(), kibibytes.size(), "%llu",
                static_cast<unsigned long long>(limit.rlim_cur / 1024));
  add_limit(name, kibibytes.data());
}

/// Allocates no memory.
[[noreturn]] void end() {
  std::array<char, 512> text;
  const int length =
      std::snprintf(text.data(), text.size(), "limpid ERROR: needs more memory than %s\n",
                    is_memory_limited() ? limits_named.data() : "there is");
  [[maybe_unused]] const ssize_t told =
      ::write(STDERR_FILENO, text.data(), static_cast<std::size_t>(length));
  try {
    const auto none_begins_any_more = remove_unfinished_files();
    ::_exit(memory_exit_code());
  } catch (...) {  // no limits: there was no memory for the list
  }
  ::_exit(memory_exit_code());
}

[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end();
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) end();
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void end_when_memory_ends() {
  note_memory_limits({});
  std::set_terminate(on_terminate);
}

void note_memory_limits(const CommonArguments& common) {
  limits_named = {};
  if (common.max_memory) add_limit("--max-memory", common.max_memory->c_str());
  add_system_limit("ulimit -v", RLIMIT_AS);
  add_system_limit("ulimit -d", RLIMIT_DATA);
}

bool is_memory_limited() { return limits_named[0] != '\0'; }

std::string out_of_memory(std::string sentence) {
  constexpr std::string_view kThereIs = "there is";
  if (is_memory_limited() && sentence.ends_with(kThereIs)) {
    sentence.replace(sentence.size() - kThereIs.size(), kThereIs.size(), limits_named.data());
  }
  return sentence;
}

int memory_exit_code() { return is_memory_limited() ? 1 : 75; }

}  // namespace limpid::tool
