#include "desk/half_plate.h"

#include <algorithm>
#include <cmath>

namespace limpid {
namespace {

/// Rounded down, also below 0.
int half_down(int x) { return x >= 0 ? x / 2 : -((1 - x) / 2); }
int half_up(int x) { return -half_down(-x); }

/// Calls make(x, y, pixels) for each half pixel; `pixels` are those in the window.
template <class Make>
Plane halved(const Rect& window, const Halving& halving, const Make& make) {
  Plane half(halving.of(window));
  const View<float> to = half.view();
  for (int y = to.window.y0; y < to.window.y1; ++y) {
    for (int x = to.window.x0; x < to.window.x1; ++x) {
      to.at(x, y) = make(intersection(halving.covered({x, y, x + 1, y + 1}), window));
    }
  }
  return half;
}

/// The upper left of the existing pixels, as in the tool's other reduced pictures.
Plane half_sample(const View<const float>& plane, const Halving& halving) {
  return halved(plane.window, halving,
                [&](const Rect& four) { return plane.at(four.x0, four.y0); });
}

/// The mean of the valid pixels by their shares; the plain mean if none is valid.
Plane half_valid_mean(const View<const float>& plane, const View<const float>& valid,
                      const Halving& halving) {
  return halved(plane.window, halving, [&](const Rect& four) {
    float sum = 0, plain = 0, shares = 0;
    for (int y = four.y0; y < four.y1; ++y) {
      for (int x = four.x0; x < four.x1; ++x) {
        const bool known = valid.window.contains({x, y, x + 1, y + 1});
        const float share = known ? valid.at(x, y) : 0;
        sum += share * plane.at(x, y);
        shares += share;
        plain += plane.at(x, y);
      }
    }
    return shares > 0 ? sum / shares : plain / static_cast<float>(four.area());
  });
}

bool has_mean(const Role& role) { return role.sanitise != Sanitise::kDepth; }

/// Means of unit vectors, made unit.
void make_unit(const View<float>& x, const View<float>& y, const View<float>& z) {
  const Rect& w = x.window;
  for (int row = w.y0; row < w.y1; ++row) {
    for (int column = w.x0; column < w.x1; ++column) {
      float &a = x.at(column, row), &b = y.at(column, row), &c = z.at(column, row);
      const float length = std::sqrt(a * a + b * b + c * c);
      if (!(length > 0)) continue;  // opposite vectors cancel: no direction either
      a /= length;
      b /= length;
      c /= length;
    }
  }
}

}  // namespace

Rect Halving::of(const Rect& w) const {
  return {half_down(w.x0 - corner_x), half_down(w.y0 - corner_y), half_up(w.x1 - corner_x),
          half_up(w.y1 - corner_y)};
}

Rect Halving::covered(const Rect& half) const {
  return {corner_x + 2 * half.x0, corner_y + 2 * half.y0, corner_x + 2 * half.x1,
          corner_y + 2 * half.y1};
}

Plane half_mean(const View<const float>& plane, const Halving& halving) {
  return halved(plane.window, halving, [&](const Rect& four) {
    float sum = 0;
    for (int y = four.y0; y < four.y1; ++y) {
      for (int x = four.x0; x < four.x1; ++x) sum += plane.at(x, y);
    }
    return sum / static_cast<float>(four.area());
  });
}

HalfPlate::HalfPlate(const Frame& frame, Executor& executor)
    : display_(frame.display), halving_{frame.work().x0, frame.work().y0}, planes_(kPlaneCount) {
  frame_.display = halving_.of(frame.display);
  const auto halve = [&](const Role& role, PlaneId id) {
    const View<const float>& whole = frame.plane(id);
    const View<const float>& valid = frame.plane(PlaneId::kReflectionValid);
    const bool of_valid = valid && role.first == PlaneId::kReflectionR;
    return of_valid         ? half_valid_mean(whole, valid, halving_)
           : has_mean(role) ? half_mean(whole, halving_)
                            : half_sample(whole, halving_);
  };
  run_each(executor, kPlaneCount + 4, [&](int index) {
    if (index >= kPlaneCount) {
      const View<const float>& whole = frame.foreground[index - kPlaneCount];
      if (whole) foreground_[index - kPlaneCount] = half_mean(whole, halving_);
      return;
    }
    for (const Role& role : roles()) {
      const PlaneId id = static_cast<PlaneId>(index);
      if (role.planes().has(id) && frame.plane(id)) planes_[index] = halve(role, id);
    }
  });
  Plane* const normal = &planes_[index_of(PlaneId::kSurfaceNormalX)];
  if (normal[0]) make_unit(normal[0].view(), normal[1].view(), normal[2].view());
  for (int i = 0; i < kPlaneCount; ++i) frame_.planes[i] = planes_[i].view();
  for (int i = 0; i < 4; ++i) frame_.foreground[i] = foreground_[i].view();
}

Camera HalfPlate::camera(const Camera& of_frame) const {
  const Rect seen = halving_.covered(frame_.display);
  // Places -1 ... 1 of the display window, y up, within the visible window.
  const double sx = display_.width() / double(seen.width());
  const double sy = display_.height() / double(seen.height());
  const double tx = sx - 1 + 2.0 * (display_.x0 - seen.x0) / seen.width();
  const double ty = 1 - sy - 2.0 * (display_.y0 - seen.y0) / seen.height();
  Camera camera = of_frame;
  for (int column = 0; column < 4; ++column) {
    glm::dvec4& p = camera.projection[column];
    p.x = sx * p.x + tx * p.w;
    p.y = sy * p.y + ty * p.w;
  }
  return camera;
}

}  // namespace limpid
