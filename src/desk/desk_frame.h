#pragma once
#include <cstdint>
#include <optional>

#include "limpid/core/executor.h"

#include "desk/half_plate.h"
#include "job/held_plate.h"

namespace limpid {

/// One frame of the desk: its plate, and the planes that looks have needed so far, at full and at
/// half size.
class DeskFrame {
 public:
  /// Opens the plate of the job. Throws Error as Plate::open().
  explicit DeskFrame(CompositeJob job);

  const CompositeJob& job() const { return held_.job(); }
  const Plate& plate() const { return held_.plate(); }
  double transparent() const { return held_.transparent(); }

  /// As HeldPlate::whole().
  Frame whole(PlaneSet planes, const Scene& scene);
  struct Half {
    Frame frame;
    Camera camera;
  };
  /// The same at half size, with its camera.
  Half half(PlaneSet planes, const Scene& scene, Executor& executor);

  /// The mapping from pixels of whole() to pixels of half().
  Halving halving() const;

  /// Memory of all planes.
  std::int64_t bytes() const;

 private:
  void read(PlaneSet planes, const Scene& scene);

  HeldPlate held_;
  std::optional<HalfPlate> half_;
};

}  // namespace limpid
