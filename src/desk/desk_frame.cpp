#include "desk/desk_frame.h"

#include <utility>

namespace limpid {
namespace {

std::int64_t bytes_of(const Frame& frame) {
  std::int64_t pixels = 0;
  for (const View<const float>& plane : frame.planes) pixels += plane ? plane.window.area() : 0;
  for (const View<const float>& plane : frame.foreground) {
    pixels += plane ? plane.window.area() : 0;
  }
  return pixels * std::int64_t{sizeof(float)};
}

}  // namespace

DeskFrame::DeskFrame(CompositeJob job) : held_(std::move(job)) {}

void DeskFrame::read(PlaneSet planes, const Scene& scene) {
  if (held_.read(planes, scene)) half_.reset();
}

Frame DeskFrame::whole(PlaneSet planes, const Scene& scene) {
  read(planes, scene);
  return held_.whole(planes, scene);
}

DeskFrame::Half DeskFrame::half(PlaneSet planes, const Scene& scene, Executor& executor) {
  read(planes, scene);
  if (!half_) half_.emplace(held_.frame(), executor);
  return {held_.as_read_for(planes, half_->frame()), half_->camera(*scene.camera)};
}

Halving DeskFrame::halving() const {
  const Rect work = held_.frame().work();
  return {work.x0, work.y0};
}

std::int64_t DeskFrame::bytes() const {
  return bytes_of(held_.frame()) + (half_ ? bytes_of(half_->frame()) : 0);
}

}  // namespace limpid
