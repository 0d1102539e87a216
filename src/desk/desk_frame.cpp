#include "desk/desk_frame.h"

#include <utility>

#include "job/composite_inputs.h"

namespace limpid {
namespace {

Frame only(Frame frame, PlaneSet planes) {
  for (int i = 0; i < kPlaneCount; ++i) {
    if (!planes.has(static_cast<PlaneId>(i))) frame.planes[i] = {};
  }
  return frame;
}

std::int64_t bytes_of(const Frame& frame) {
  std::int64_t pixels = 0;
  for (const View<const float>& plane : frame.planes) pixels += plane ? plane.window.area() : 0;
  for (const View<const float>& plane : frame.before_water) {
    pixels += plane ? plane.window.area() : 0;
  }
  return pixels * std::int64_t{sizeof(float)};
}

}  // namespace

DeskFrame::DeskFrame(CompositeJob job) : job_(std::move(job)), plate_(Plate::open(job_.plate)) {}

void DeskFrame::read(PlaneSet planes, const Scene& scene) {
  if (read_.covers(planes)) return;
  half_.reset();
  const PlaneSet all = std::exchange(read_, {}) | planes;
  plate_.read(all, scene, depth_of(job_), loaded_);
  read_ = all;
}

Frame DeskFrame::whole(PlaneSet planes, const Scene& scene) {
  read(planes, scene);
  return only(loaded_.frame, plate_.read_for(planes));
}

DeskFrame::Half DeskFrame::half(PlaneSet planes, const Scene& scene, Executor& executor) {
  read(planes, scene);
  if (!half_) half_.emplace(loaded_.frame, executor);
  return {only(half_->frame(), plate_.read_for(planes)), half_->camera(*scene.camera)};
}

Halving DeskFrame::halving() const {
  const Rect work = loaded_.frame.work();
  return {work.x0, work.y0};
}

std::int64_t DeskFrame::bytes() const {
  return bytes_of(loaded_.frame) + (half_ ? bytes_of(half_->frame()) : 0);
}

}  // namespace limpid
