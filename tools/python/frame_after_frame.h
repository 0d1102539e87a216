#pragma once
#include <memory>
#include <optional>
#include <string>

#include <pybind11/numpy.h>

#include "limpid/compositor.h"

namespace limpid::python {

/// A Compositor with a pool of its own that takes arrays. It computes without the interpreter's
/// lock; calls in the meantime are refused.
class FrameAfterFrame {
 public:
  /// `conventions` and `runner` (runner, gpu, gpu_cache) are keywords of limpid.Compositor. Threads
  /// as in make_executor().
  FrameAfterFrame(const pybind11::dict& conventions, const pybind11::dict& look, int threads,
                  const std::string& simd, double max_error, const pybind11::dict& runner);

  void change_look(const pybind11::dict& changes);
  pybind11::dict look() const;
  /// Arrays, or None to take them away.
  void set_wave_map(const pybind11::object& array);
  /// Lat-long, as files have it: columns run to the right, seen from inside.
  void set_environment(const pybind11::object& array);

  /// `planes` and `aovs` by name; an AOV's None asks for a fresh array, as does `out`, which then
  /// is of type `dtype`. `scene`: view, projection, water, sun, time. `display`: x0, y0, x1, y1 in
  /// color. Returns (picture, dict of AOVs).
  pybind11::tuple run(const pybind11::dict& planes, const pybind11::dict& scene,
                      const pybind11::object& display, const pybind11::object& out,
                      const std::string& dtype, const pybind11::dict& aovs);

  /// The frame as run() takes it, and keywords of shader_options_of(); what dict_of() makes of it.
  pybind11::dict shader(const pybind11::dict& planes, const pybind11::dict& scene,
                        const pybind11::object& display, const pybind11::dict& options);

  /// (list of (name, verdict, reason, rule), list of roles that are read, text).
  pybind11::tuple plan() const;
  pybind11::dict replaced() const;
  std::string device() const;  ///< "" where the CPU computes

 private:
  Primaries primaries_;  ///< of all frames
  std::unique_ptr<Executor> executor_;
  std::unique_ptr<Compositor> compositor_;
  pybind11::object wave_map_, environment_;  ///< keep the memory
  mutable bool busy_ = false;                ///< under the interpreter's lock
};

}  // namespace limpid::python
