#pragma once
#include <cstdint>
#include <optional>

#include "limpid/core/executor.h"

#include "desk/half_plate.h"
#include "job/held_plate.h"

namespace limpid {

/// One frame of what lies on the desk: its plate, and the planes that looks have asked for so far,
/// whole and of half the size.
class DeskFrame {
 public:
  /// Opens the plate of the job. Throws Error as Plate::open().
  explicit DeskFrame(CompositeJob job);

  const CompositeJob& job() const { return held_.job(); }
  const Plate& plate() const { return held_.plate(); }
  double transparent() const { return held_.transparent(); }

  /// As HeldPlate has it.
  Frame whole(PlaneSet planes, const Scene& scene);
  struct Half {
    Frame frame;
    Camera camera;
  };
  /// The same of half the size, and the camera that sees it.
  Half half(PlaneSet planes, const Scene& scene, Executor& executor);

  /// Which pixels of whole() are one of half().
  Halving halving() const;

  /// Of all planes in memory.
  std::int64_t bytes() const;

 private:
  void read(PlaneSet planes, const Scene& scene);

  HeldPlate held_;
  std::optional<HalfPlate> half_;
};

}  // namespace limpid
