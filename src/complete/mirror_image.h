#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include "complete/row_heights.h"

namespace limpid {

/// The places of mirror images on the screen, for the points that the pixels of a row show. A
/// point's mirror image lies straight below it, and the line to it crosses the screen like a
/// ScreenRay.
class MirrorImage {
 public:
  MirrorImage(const WaterView& c, int y)
      : c_(c),
        heights_(c, y),
        down_depth_(-glm::dot(c.forward, c.up)),
        w_step_(c.w_depth * down_depth_),
        down_u_(-glm::dot(c.to_u, c.up)),
        down_v_(-glm::dot(c.to_v, c.up)),
        v_((y - c.corner.y + 0.5) / c.size.y) {}

  struct Place {
    double x, y;   ///< pixels
    double depth;  ///< eye depth, scene units
  };
  /// Of the point at an eye depth in pixel x, which may lie above the calm water or below it;
  /// nothing where the image lies behind the eye.
  std::optional<Place> at(int x, double depth) const {
    const double distance = 2 * heights_.at(x, depth);
    const double u = (x - c_.corner.x + 0.5) / c_.size.x;
    const double image_depth = depth + distance * down_depth_;
    const double w = c_.w_origin + c_.w_depth * depth + distance * w_step_;
    if (!(w > 0 && image_depth > 0)) return {};
    const double image_u = u + distance * (down_u_ - u * w_step_) / w;
    const double image_v = v_ + distance * (down_v_ - v_ * w_step_) / w;
    return Place{image_u * c_.size.x + c_.corner.x, image_v * c_.size.y + c_.corner.y, image_depth};
  }
  bool is_above(int x, double depth) const { return heights_.at(x, depth) * c_.eye_above > 0; }

 private:
  const WaterView& c_;
  RowHeights heights_;
  double down_depth_, w_step_, down_u_, down_v_, v_;
};

}  // namespace limpid
