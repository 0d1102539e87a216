#include "streams.h"

#include <csignal>
#include <cstdio>
#include <iostream>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid::tool {

void keep_streams_apart() {
  std::signal(SIGPIPE, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // open() takes the lowest free number, which is this one, because those below are open.
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDWR);
  }
}

void finish_stdout() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  pollfd end{STDOUT_FILENO, POLLOUT, 0};
  if (::poll(&end, 1, 0) == 1 && (end.revents & POLLERR) != 0) {
    std::signal(SIGPIPE, SIG_DFL);
    ::raise(SIGPIPE);
  }
  throw Error("standard output: cannot be written to; all other work is done", Fault::kRetry);
}

}  // namespace limpid::tool
