#include "gl_process.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gl_context.h"
#include "rows.h"

namespace limpid::bench {
namespace {

constexpr const char* kOption = "--rival";
constexpr char kDraw = 'd', kPicture = 'p', kRenderer = 'n';

using Text = std::array<char, 128>;

void write_all(int file, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::write(file, from, bytes);
    if (done <= 0) throw std::runtime_error("the pipe to the rival broke");
    from += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

void read_all(int file, void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::read(file, to, bytes);
    if (done <= 0) throw std::runtime_error("the pipe to the rival broke");
    to += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

template <class T>
T ask(int to, int from, char order) {
  T answer{};
  write_all(to, &order, 1);
  read_all(from, &answer, sizeof answer);
  return answer;
}

}  // namespace

GlProcess::GlProcess(const std::string& what, int threads) {
  int down[2], up[2];  // closed in processes that are started later
  if (::pipe2(down, O_CLOEXEC) != 0 || ::pipe2(up, O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  std::signal(SIGPIPE, SIG_IGN);  // write() reports a rival that has ended
  child_ = ::fork();
  if (child_ == 0) {
    ::dup2(down[0], STDIN_FILENO);
    ::dup2(up[1], STDOUT_FILENO);
    ::setenv("LP_NUM_THREADS", threads == 1 ? "0" : std::to_string(threads).c_str(), 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    ::execl("/proc/self/exe", "rival", kOption, what.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(down[0]);
  ::close(up[1]);
  to_ = down[1];
  from_ = up[0];
}

GlProcess::~GlProcess() {
  ::close(to_);
  ::close(from_);
  ::waitpid(child_, nullptr, 0);
}

double GlProcess::draw() { return ask<double>(to_, from_, kDraw); }

std::string GlProcess::renderer() { return ask<Text>(to_, from_, kRenderer).data(); }

std::vector<float> GlProcess::picture(std::size_t floats) {
  std::vector<float> planes(floats);
  write_all(to_, &kPicture, 1);
  read_all(from_, planes.data(), floats * sizeof(float));
  return planes;
}

bool serve_drawing(int argc, char** argv,
                   std::unique_ptr<GlDrawing> (*make)(const std::string& what)) {
  if (argc != 3 || std::string_view(argv[1]) != kOption) return false;
  const GlContext context;
  const std::unique_ptr<GlDrawing> drawing = make(argv[2]);
  char order = 0;
  while (::read(STDIN_FILENO, &order, 1) == 1) {
    if (order == kDraw) {
      const double took = seconds_of([&] { drawing->draw(); });
      write_all(STDOUT_FILENO, &took, sizeof took);
    } else if (order == kPicture) {
      const std::vector<float> planes = drawing->picture();
      write_all(STDOUT_FILENO, planes.data(), planes.size() * sizeof(float));
    } else {
      Text name{};
      std::snprintf(name.data(), name.size(), "%s",
                    reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
      write_all(STDOUT_FILENO, name.data(), name.size());
    }
  }
  return true;
}

}  // namespace limpid::bench
