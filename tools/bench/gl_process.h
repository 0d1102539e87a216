#pragma once
#include <memory>
#include <string>
#include <vector>

namespace limpid::bench {

/// A picture that OpenGL can draw again and again.
class GlDrawing {
 public:
  virtual ~GlDrawing() = default;
  virtual void draw() = 0;  ///< returns when the picture is there
  /// Its planes one after the other, rows from the top.
  virtual std::vector<float> picture() const = 0;
};

/// A drawing in a process of its own: Mesa's llvmpipe reads from the environment how many threads
/// it has, once for each process. The process is this program again, which must call serve_drawing
/// first; it makes the drawing named `what` and waits. It is told what to do, and tells what that
/// took, by pipes; only the drawing is timed, there.
class GlProcess {
 public:
  /// One thread draws in the calling thread (LP_NUM_THREADS=0), more are that many besides it.
  GlProcess(const std::string& what, int threads);
  ~GlProcess();
  GlProcess(const GlProcess&) = delete;
  GlProcess& operator=(const GlProcess&) = delete;

  double draw();  ///< seconds
  std::vector<float> picture(std::size_t floats);
  std::string renderer();

 private:
  int child_ = 0, to_ = 0, from_ = 0;
};

/// False unless this program was started by GlProcess; then true, after serving it to its end.
bool serve_drawing(int argc, char** argv,
                   std::unique_ptr<GlDrawing> (*make)(const std::string& what));

}  // namespace limpid::bench
