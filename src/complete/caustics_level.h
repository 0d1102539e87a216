#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"

#include "complete/pull_push.h"
#include "complete/wave_rows.h"

namespace limpid {

/// The bottom at one of several pixels: its entry point under calm water.
struct CausticsBottom {
  float x, y, depth;  ///< 0: not under water
};

/// The view of the bottom through one pixel of the water.
struct CausticsSight {
  float depth;           ///< 0: the pixel is dry
  float seen_x, seen_y;  ///< entry point, under calm water, of the light of the bottom
  float texel;           ///< the width of the texels that it needs
  /// the same for the near end of the view's path in the water, for shafts
  float enters_x, enters_y;
};

/// Light in calm water, with its sideways travel per unit of depth.
struct Sunlight {
  glm::dvec3 to_sun;  ///< along map_x, map_y and up
  glm::dvec2 aside;   ///< sideways travel per unit of depth
  double ior, passes, focus;
  double along, across;  ///< standard deviation of the sun's disc on the bottom, per unit of depth
  bool low;              ///< the sun is so low that transmission changes from wave to wave
};

/// Bounds of places along x, y, x + y and x - y.
struct Octagon {
  std::array<double, 4> low{HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL},
      high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void take_in(glm::dvec2 at) {
    const double along[] = {at.x, at.y, at.x + at.y, at.x - at.y};
    for (std::size_t i = 0; i < 4; ++i) {
      low[i] = std::min(low[i], along[i]), high[i] = std::max(high[i], along[i]);
    }
  }
  void widen(double by) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double far = i < 2 ? by : std::numbers::sqrt2 * by;
      low[i] -= far, high[i] += far;
    }
  }
};

/// One level of the table, made in steps: lay it out, find the bottom, send each band of rays,
/// finish each band of its rows. Bands of a step share no memory.
class CausticsLevel {
 public:
  static constexpr int kBands = 4;  ///< splatted separately, for any number of threads

  /// Texels from the corner on, with a `margin` of texels beyond each side that send light into it.
  struct Layout {
    glm::dvec2 corner{0, 0};
    double texel = 1, depth = 0;  ///< mean
    Size size{0, 0};
    double spacing = 1;  ///< of rays, in texels: 2, 1, 1/2 or 1/4
    int margin = 0;
    int coarse = 2;  ///< texels along a cell of the bottom
    Octagon seen;    ///< rays that end outside are not traced
  };
  void lay_out(const Layout& layout);
  bool empty() const { return layout_.size.width == 0; }
  const Layout& layout() const { return layout_; }
  void leave_out() { layout_.size = {0, 0}; }
  /// The number of texels that receive light, or of rays if there are more of them.
  double points() const;

  void find_bottom(std::span<const CausticsBottom> samples, Executor& executor);
  void send(const WaveRows& waves, const Sunlight& sun, const CausticsTarget& target, int band);
  void finish(const Sunlight& sun, const CausticsTarget& target, int band);

  View<const float> light() const { return light_.view(); }
  double least() const;
  double most() const;

 private:
  static constexpr int kTall = 16;   ///< rows of texels per span of visible columns
  static constexpr int kBorder = 3;  ///< texels around the table that may receive light
  static constexpr int kRoom = 16;   ///< a vector may begin before a row or end beyond it
  struct Span {
    int begin, end;  ///< columns; equal: none
    bool empty() const { return begin >= end; }
  };
  /// The light that one band of rays adds to the table, and room for some of its rows.
  struct Band {
    std::vector<float> light, rows;
    int first = 0, last = -1;  ///< lit rows, counted from the one before the table's border
    std::vector<int> texels;
    WaveRows::Room room;
    float least = 1, most = 1;
  };

  int stride() const { return layout_.size.width + 2 * kBorder + 4; }
  int rays_over(int texels) const;
  Span seen_in(int begin, int end) const;
  void reach(Band& band, RowsHit rows) const;

  Layout layout_;
  std::vector<Span> spans_;    ///< visible columns of each kTall rows
  std::vector<Span> rays_;     ///< rays of each row, counted from the corner of the margin
  std::vector<float> bottom_;  ///< depths of cells, from one cell before the margin's corner on
  std::vector<int> places_;    ///< the cell of each sample, or -1
  int coarse_ = 2;             ///< texels along a cell
  Size cells_{0, 0};
  PullPush<1> filled_;
  std::array<Band, kBands> bands_;
  Plane light_;
};

}  // namespace limpid
