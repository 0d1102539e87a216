#pragma once
#include <cstring>
#include <deque>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

namespace limpid::test {

/// The names that come into a folder, in order, as the system tells of them.
class NewFiles {
 public:
  explicit NewFiles(const std::filesystem::path& folder) : events_(::inotify_init1(IN_CLOEXEC)) {
    EXPECT_GE(::inotify_add_watch(events_, folder.c_str(), IN_CREATE), 0);
  }
  ~NewFiles() { ::close(events_); }
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  /// Waits for the next one.
  std::string next() {
    if (names_.empty()) take();
    const std::string name = names_.front();
    names_.pop_front();
    return name;
  }

 private:
  void take() {
    char bytes[4096];
    const ssize_t size = ::read(events_, bytes, sizeof bytes);
    if (size <= 0) throw std::runtime_error("no more events");
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
