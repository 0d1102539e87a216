#pragma once
#include <array>
#include <cstdint>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

#include "complete/row_heights.h"
#include "op/pass.h"

namespace limpid {

/// The content of a pixel.
enum class Side : std::uint8_t {
  kWet,   ///< water, and the scene behind it
  kDry,   ///< a surface without water in front
  kNone,  ///< no surface and no water
};

/// The planes of a frame in which its edges are searched.
struct EdgePicture {
  const Pass& pass;
  std::array<View<const float>, 3> color;
  View<const float> alpha, depth, surface;  ///< alpha and surface may be absent
  Rect window;                              ///< where all planes are

  EdgePicture(const Frame& frame, const Pass& c)
      : pass(c),
        color{frame.plane(PlaneId::kColorR), frame.plane(PlaneId::kColorG),
              frame.plane(PlaneId::kColorB)},
        alpha(frame.plane(PlaneId::kColorA)),
        depth(frame.plane(PlaneId::kDepth)),
        surface(frame.plane(PlaneId::kSurfaceDepth)),
        window(depth.window) {
    for (const View<const float>& view : color) window = intersection(window, view.window);
    if (alpha) window = intersection(window, alpha.window);
    if (surface) window = intersection(window, surface.window);
  }

  Rgb<double> color_at(int x, int y) const {
    return {color[0].at(x, y), color[1].at(x, y), color[2].at(x, y)};
  }
  double inverse_depth(int x, int y) const { return 1.0 / depth.at(x, y); }

  /// Texels of a row.
  class Row {
   public:
    Row(const EdgePicture& picture, int y)
        : window_(picture.window), depth_(row_of(picture, picture.depth, y)) {
      for (std::size_t c = 0; c < 3; ++c) color_[c] = row_of(picture, picture.color[c], y);
      if (picture.alpha) alpha_ = row_of(picture, picture.alpha, y);
    }
    Rgb<double> color(int x) const {
      return {at(color_[0], x), at(color_[1], x), at(color_[2], x)};
    }
    float depth(int x) const { return at(depth_, x); }
    double alpha(int x) const { return alpha_.first ? at(alpha_, x) : 1.0; }

   private:
    struct Texels {
      const float* first = nullptr;
      std::ptrdiff_t step = 0;
    };
    static Texels row_of(const EdgePicture& picture, const View<const float>& view, int y) {
      return {&view.at(picture.window.x0, y), view.x_stride};
    }
    float at(const Texels& row, int x) const { return row.first[(x - window_.x0) * row.step]; }

    Rect window_;
    Texels depth_, alpha_;
    std::array<Texels, 3> color_{};
  };

  /// 1 / depth of the water for the pixels of a row, 0 where there is none.
  class Water {
   public:
    Water(const EdgePicture& picture, int y)
        : picture_(picture), y_(y), heights_(picture.pass, y), sign_(heights_.over > 0 ? -1 : 1) {}
    double inverse_depth(int x) const {
      if (picture_.surface) return 1.0 / picture_.surface.at(x, y_);
      const double over = std::abs(heights_.over + x * heights_.over_step);
      const double falls = sign_ * (heights_.under + x * heights_.under_step);
      return over > 0 && falls > 0 ? falls / over : 0;
    }

   private:
    const EdgePicture& picture_;
    int y_;
    RowHeights heights_;
    double sign_;
  };

  /// The sides of the pixels x0 ... x1 - 1 of a row.
  void sides(int y, int x0, int x1, std::uint8_t* to) const;
};

}  // namespace limpid
