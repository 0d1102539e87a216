#pragma once
#include <cstdint>
#include <optional>

#include "limpid/core/executor.h"
#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

#include "desk/half_plate.h"

namespace limpid {

/// One frame of what lies on the desk: its plate, opened, and the planes that looks have asked for
/// so far, whole and of half the size.
class DeskFrame {
 public:
  /// Opens the plate of the job. Throws Error as Plate::open().
  explicit DeskFrame(CompositeJob job);

  const CompositeJob& job() const { return job_; }
  const Plate& plate() const { return plate_; }
  /// As LoadedPlate has it, of what was read.
  double transparent() const { return loaded_.transparent; }

  /// The frame that composite() would read for a plan of these planes: the same planes, no others.
  /// What is not in memory is read. Valid until more is read. Throws Error as Plate::read().
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

  CompositeJob job_;
  Plate plate_;
  PlaneSet read_;  ///< what was asked for together
  LoadedPlate loaded_;
  std::optional<HalfPlate> half_;
};

}  // namespace limpid
