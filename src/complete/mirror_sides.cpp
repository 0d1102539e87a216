#include "complete/mirror_sides.h"

#include <algorithm>
#include <cmath>

#include "complete/mirror_image.h"

namespace limpid {
namespace {

class SideOfRow {
 public:
  /// `step`: 1 at the right side, -1 at the left.
  SideOfRow(const Frame& frame, const WaterView& view, const View<float>& depth, int y, int step)
      : frame_(frame), view_(view), depth_(depth), y_(y), step_(step) {}

  void go_on() {
    const Rect& window = depth_.window;
    const int side = step_ > 0 ? window.x1 : window.x0 - 1;
    const int most = static_cast<int>(kSide * window.width());
    int count = 0;  // of unknown texels
    while (count <= most && !is_known(side - step_ * (count + 1))) ++count;
    const int known = side - step_ * (count + 1);
    if (count == 0 || count > most || !is_of_side(known)) return;
    const double per_texel = slope_at(known, std::max(count, 8));
    const int resemble = resembling(known, count);
    for (int i = 1; i <= resemble; ++i) {
      const double inverse = inverse_at(known) + i * per_texel;
      depth_.at(known + step_ * i, y_) = static_cast<float>(1 / inverse);
    }
  }

 private:
  static constexpr double kSide = 0.25, kLike = 2, kSmooth = 0.1;
  static constexpr double kGrown = 5;  ///< pixels; closed holes widen images by two

  bool is_known(int x) const {
    return x >= depth_.window.x0 && x < depth_.window.x1 && std::isfinite(depth_.at(x, y_));
  }
  double inverse_at(int x) const { return 1.0 / std::abs(depth_.at(x, y_)); }

  /// Whether the point that a texel shows the image of stands at the side of the dry picture.
  bool is_of_side(int x) const {
    const auto point = MirrorImage(view_, y_).at(x, std::abs(depth_.at(x, y_)));
    const Rect& dry = frame_.plane(PlaneId::kDepth).window;
    const int side = step_ > 0 ? dry.x1 : dry.x0;
    return point && std::abs(point->x - side) < kGrown;
  }

  /// The change of 1 / depth from one texel to the next, 0 where the last `count` texels have no
  /// common plane.
  double slope_at(int known, int count) const {
    const int before = known - step_ * count;
    if (!is_known(before)) return 0;
    const double change = inverse_at(known) - inverse_at(before);
    return std::abs(change) < kSmooth * inverse_at(known) ? change / count : 0;
  }

  /// The number of texels after `known`, of `count`, whose light is more than half and less than
  /// twice as large as the light before them. One texel may differ: a seam.
  int resembling(int known, int count) const {
    double light = light_at(known);
    int last = 0;
    for (int i = 1; i <= count && i <= last + 2; ++i) {
      const double here = light_at(known + step_ * i);
      if (!(here < kLike * light && light < kLike * here)) continue;
      light += 0.25 * (here - light);
      last = i;
    }
    return last;
  }
  /// Of 3 x 3 texels, because renders are noisy.
  double light_at(int x) const {
    double sum = 1e-4;
    for (int c = 0; c < 3; ++c) {
      const View<const float>& plane = frame_.plane(plane_after(PlaneId::kReflectionR, c));
      const Rect& window = plane.window;
      for (int k = 0; k < 9; ++k) {
        const int at_x = std::clamp(x + k % 3 - 1, window.x0, window.x1 - 1);
        const int at_y = std::clamp(y_ + k / 3 - 1, window.y0, window.y1 - 1);
        sum += std::max(plane.at(at_x, at_y), 0.0f);
      }
    }
    return sum;
  }

  const Frame& frame_;
  const WaterView& view_;
  const View<float>& depth_;
  int y_, step_;
};

}  // namespace

void go_on_to_sides(const Frame& frame, const WaterView& view, const View<float>& depth, int y) {
  for (const int step : {-1, 1}) SideOfRow(frame, view, depth, y, step).go_on();
}

}  // namespace limpid
