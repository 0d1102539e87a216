#pragma once
#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// A plate that several looks are put on: opened, with the planes in memory that they have asked
/// for so far.
class HeldPlate {
 public:
  /// Opens the plate of the job. Throws Error as Plate::open().
  explicit HeldPlate(CompositeJob job);

  const CompositeJob& job() const { return job_; }
  const Plate& plate() const { return plate_; }
  /// As LoadedPlate has it, of what was read.
  double transparent() const { return loaded_.transparent; }

  /// Reads what is not in memory of these planes; true where that was something, and views of
  /// before are none any more. Throws Error as Plate::read().
  bool read(PlaneSet planes, const Scene& scene);
  /// All that is in memory.
  const Frame& frame() const { return loaded_.frame; }
  /// The frame that composite() would read for a plan of these planes: the same planes, no others.
  /// What is not in memory is read. Valid until more is read.
  Frame whole(PlaneSet planes, const Scene& scene);
  /// The same of a frame like frame(): without the planes that composite() would not read.
  Frame as_read_for(PlaneSet planes, Frame frame) const;

 private:
  CompositeJob job_;
  Plate plate_;
  PlaneSet read_;  ///< what was asked for together
  LoadedPlate loaded_;
};

}  // namespace limpid
