#pragma once
#include <cstring>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "tool/running.h"

namespace limpid::test {

/// The names of new files in a folder, in the order of the system's events.
class NewFiles {
 public:
  explicit NewFiles(const std::filesystem::path& folder) : events_(::inotify_init1(IN_CLOEXEC)) {
    EXPECT_GE(::inotify_add_watch(events_, folder.c_str(), IN_CREATE), 0);
  }
  ~NewFiles() { ::close(events_); }
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  /// Waits for the next name; empty when no name is left and the process that makes files has
  /// ended.
  std::optional<std::string> next(const Running& maker) {
    if (names_.empty() && comes(maker)) take();
    if (names_.empty()) return std::nullopt;
    const std::string name = names_.front();
    names_.pop_front();
    return name;
  }

 private:
  bool comes(const Running& maker) const {
    pollfd ends[] = {{events_, POLLIN, 0}, {maker.stdout_end(), 0, 0}};
    ::poll(ends, 2, -1);
    return ::poll(ends, 1, 0) == 1;  // the last events come before the pipe hangs up
  }
  void take() {
    char bytes[4096];
    const ssize_t size = ::read(events_, bytes, sizeof bytes);
    for (ssize_t at = 0; at < size;) {
      inotify_event event;
      std::memcpy(&event, bytes + at, sizeof event);
      names_.emplace_back(bytes + at + sizeof event);
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }

  int events_;
  std::deque<std::string> names_;
};

}  // namespace limpid::test
