#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/gpu/gpu_runner.h"
#include "limpid/ops/look.h"
#include "limpid/run/target.h"

namespace limpid {

/// A hash of a place in 0 ... 1, the same on every machine.
float hard_noise(int x, int y, int channel);

/// A frame that owns its planes.
class HardFrame {
 public:
  HardFrame() = default;
  explicit HardFrame(Rect display) { frame_.display = display; }

  /// Makes a plane of the display window by a function of the pixel.
  template <class Fn>
  void set(PlaneId id, Fn&& value) {
    Plane& plane = add(id);
    const Rect& w = frame_.display;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) plane.view().at(x, y) = static_cast<float>(value(x, y));
    }
  }
  void fill(PlaneId id, double value) {
    set(id, [value](int, int) { return value; });
  }
  void normal(const glm::dvec3& n) {
    fill(PlaneId::kSurfaceNormalX, n.x);
    fill(PlaneId::kSurfaceNormalY, n.y);
    fill(PlaneId::kSurfaceNormalZ, n.z);
  }
  void remove(PlaneId id) {
    planes_[index_of(id)] = {};
    frame_.planes[index_of(id)] = {};
  }
  /// Enters all planes like a loader.
  void sanitise(const glm::dvec3& up);

  View<float> plane(PlaneId id) { return planes_[index_of(id)].view(); }
  const Frame& frame() const { return frame_; }
  Frame& frame() { return frame_; }

 private:
  Plane& add(PlaneId id);

  Frame frame_;
  std::array<Plane, kPlaneCount> planes_;
};

/// A picture with all AOVs.
class HardPicture {
 public:
  explicit HardPicture(Rect window);

  Rect window() const { return window_; }
  double color(int channel, int x, int y) const { return target.color[channel].at(x, y); }
  double aov(Aov which, int x, int y, int channel = 0) const {
    return target.of(which)[channel].at(x, y);
  }
  bool wet(int x, int y) const { return !std::isinf(aov(Aov::kSurfaceDepth, x, y)); }
  /// Whether any path through the water is longer than 0.
  bool has_water() const;
  /// fn(value, x, y, whether it belongs to an AOV)
  template <class Fn>
  void for_each_value(Fn&& fn) const {
    constexpr std::size_t kPicture = 4;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      for (int y = window_.y0; y < window_.y1; ++y) {
        for (int x = window_.x0; x < window_.x1; ++x) {
          fn(planes_[i].view().at(x, y), x, y, i >= kPicture);
        }
      }
    }
  }

  Target target;

 private:
  View<float> added();

  Rect window_;
  std::vector<Plane> planes_;
};

/// Shared by the cases: the looks of a data folder, synthetic maps, and all runners.
class HardWorld {
 public:
  HardWorld(const std::filesystem::path& data, int threads, const GpuOptions* gpu);

  const std::vector<Look>& looks() const { return looks_; }
  /// Throws Error for an unknown name.
  const Look& look(const std::string& name) const;
  /// "reference", then the instruction sets of the fused runner, then "gpu", if there is one.
  const std::vector<std::string>& runners() const { return runners_; }
  /// Synthetic maps replace missing ones of the frame.
  HardPicture run(const std::string& runner, const Look& look, const HardFrame& frame,
                  const Scene& scene) const;

 private:
  std::vector<Look> looks_;
  std::vector<std::string> runners_;
  std::array<Plane, 3> waves_, sky_;
  std::unique_ptr<Executor> executor_;
  std::unique_ptr<GpuRunner> gpu_;
};

/// A frame with every plane, made of noise: wavy normals, a bottom that rises through the surface
/// in places, objects in front of it, some sky.
HardFrame noisy_frame(Size size);
/// A camera 2 above the water, looking down by 30 degrees, and a low sun.
Scene noisy_scene(Size size);

/// "avx2, fast, pixel 3 4": the place of a value.
std::string place_text(const std::string& runner, const std::string& look, int x, int y);

/// The look physical on calm water without reflection, in one color: closed forms exist for it.
Look calm_look(const HardWorld& world);

}  // namespace limpid
