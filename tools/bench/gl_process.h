#pragma once
#include <memory>
#include <string>
#include <vector>

namespace limpid::bench {

/// A picture that OpenGL can draw again and again.
class GlDrawing {
 public:
  virtual ~GlDrawing() = default;
  virtual void draw() = 0;  ///< returns when the picture is complete
  /// Its planes one after the other, rows from the top.
  virtual std::vector<float> picture() const = 0;
};

/// A drawing in a separate process: Mesa's llvmpipe reads its number of threads from the
/// environment, once per process. The process runs this program again, which must call
/// serve_drawing first; it makes the drawing named `what` and waits. Commands and times go through
/// pipes; the process times the drawing alone.
class GlProcess {
 public:
  /// With one thread llvmpipe draws in the calling thread (LP_NUM_THREADS=0); more threads are
  /// additional to the calling thread.
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

/// False unless GlProcess started this program; then true, after the last command was served.
bool serve_drawing(int argc, char** argv,
                   std::unique_ptr<GlDrawing> (*make)(const std::string& what));

}  // namespace limpid::bench
