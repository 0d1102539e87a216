#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace limpid {

/// R G B A, each with its own alpha. A sample is a volume if back > front, else a point at front.
/// Front is not NaN, back is finite for volumes, alphas are 0 ... 1, colors finite; the color of A
/// is its alpha.
struct DeepSample {
  double front, back;
  std::array<double, 4> color, alpha;
};

struct FlatPixel {
  std::array<double, 4> color{};
  double depth = std::numeric_limits<double>::infinity();
};

/// Flattens pixel after pixel; keeps its memory between them.
class DeepFlattener {
 public:
  /// The samples behind the depth `from` and not behind `to`, composited front to back. OpenEXR
  /// "Interpreting Deep Pixels", with its splits and merges as sums: a volume of alpha a and length
  /// L has the extinction -ln(1-a)/L and the emission C (-ln(1-a)/a)/L everywhere in it, and
  /// overlapping volumes add up. Takes n log n for n samples, for any overlap.
  FlatPixel flatten(std::span<const DeepSample> samples, double from,
                    double to = std::numeric_limits<double>::infinity());

 private:
  /// The order of events at one depth.
  enum class Kind { kVolumeEnds, kPoint, kOpaqueVolume, kVolumeBegins };
  struct Event {
    double depth;
    Kind kind;
    std::uint32_t sample;
  };
  /// Fills `events_`, in order; returns the depth of the nearest sample with any alpha.
  double collect(std::span<const DeepSample> samples, double from, double to);

  std::vector<Event> events_;
};

}  // namespace limpid
