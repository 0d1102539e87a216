#include "tool/running.h"

#include <csignal>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace limpid::test {

Running::Running(const std::filesystem::path& folder, const Words& command) {
  constexpr int kPage = 4096;
  int ends[2] = {-1, -1};
  EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  EXPECT_GE(::fcntl(ends[1], F_SETPIPE_SZ, kPage), kPage);
  pipe_ = ends[0];
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  EXPECT_EQ(::posix_spawn(&process_, words[0], &actions, nullptr, words.data(), environ), 0);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
}

Running::~Running() {
  if (process_ == 0) return;
  send(SIGKILL);
  wait();
}

std::optional<std::string> Running::line() {
  std::string text;
  for (char letter = 0; ::read(pipe_, &letter, 1) == 1; text += letter) {
    if (letter == '\n') return text;
  }
  return std::nullopt;
}

void Running::close_stdout() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
}

void Running::send(int signal) const { ::kill(process_, signal); }

int Running::wait() {
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = 0;
  close_stdout();
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace limpid::test
