#include "job/held_plate.h"

#include <utility>

#include "job/composite_inputs.h"

namespace limpid {

HeldPlate::HeldPlate(CompositeJob job) : job_(std::move(job)), plate_(Plate::open(job_.plate)) {}

bool HeldPlate::read(PlaneSet planes, const Scene& scene) {
  if (read_.covers(planes)) return false;
  const PlaneSet all = std::exchange(read_, {}) | planes;
  plate_.read(all, scene, depth_of(job_), loaded_);
  read_ = all;
  return true;
}

Frame HeldPlate::whole(PlaneSet planes, const Scene& scene) {
  read(planes, scene);
  return as_read_for(planes, loaded_.frame);
}

Frame HeldPlate::as_read_for(PlaneSet planes, Frame frame) const {
  const PlaneSet read = plate_.read_for(planes);
  for (int i = 0; i < kPlaneCount; ++i) {
    if (!read.has(static_cast<PlaneId>(i))) frame.planes[i] = {};
  }
  return frame;
}

}  // namespace limpid
