#pragma once
#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// An open plate for several looks, with the planes in memory that the looks have needed so far.
class HeldPlate {
 public:
  /// Opens the plate of the job. Throws Error as Plate::open().
  explicit HeldPlate(CompositeJob job);

  const CompositeJob& job() const { return job_; }
  const Plate& plate() const { return plate_; }
  /// LoadedPlate::transparent of the planes read so far.
  double transparent() const { return loaded_.transparent; }

  /// Reads those of these planes that are not in memory; true if there were any: earlier views are
  /// then invalid. Throws Error as Plate::read().
  bool read(PlaneSet planes, const Scene& scene);
  /// All planes in memory.
  const Frame& frame() const { return loaded_.frame; }
  /// The frame that composite() would read for a plan of these planes: the same planes, no others.
  /// Reads missing planes. Valid until more planes are read.
  Frame whole(PlaneSet planes, const Scene& scene);
  /// `frame`, which is like frame(), without the planes that composite() would not read.
  Frame as_read_for(PlaneSet planes, Frame frame) const;

 private:
  CompositeJob job_;
  Plate plate_;
  PlaneSet read_;  ///< all planes requested so far
  LoadedPlate loaded_;
};

}  // namespace limpid
