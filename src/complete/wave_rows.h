#pragma once
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/core/texture_levels.h"

#include "complete/caustics_target.h"
#include "op/pass.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {

/// Heights and slopes of the water's surface at places along rows of the calm surface, independent
/// of pixels. Sines have heights and slopes. Tiling maps have slopes, which for any model are read
/// from a precomputed tile. For the frame's own normals the scene's sines are used, if it has any,
/// else the slopes of the normals within the picture, and calm water beyond it. Water without
/// heights is at the calm level, as for the pixels.
class WaveRows {
 public:
  /// False if the water is calm. The frame, the pass and the waves must live as long.
  bool make(const WaveNormals::Params& waves, const Frame& frame, const Pass& pass,
            Executor& executor);

  /// The root mean square of the slope and of its change per length (the curvature of both
  /// directions added), and the length below which the surface is smooth.
  double slope() const { return slope_; }
  double curvature() const { return curvature_; }
  double shortest() const { return shortest_; }
  double longest() const { return longest_; }

  /// Memory for one row.
  struct Room {
    std::vector<SineOfRow> sines;
    std::vector<float> tile;
  };

  /// `count` places, `step` apart along map_x, from (x, y) on, in scene units from the point of the
  /// calm surface below the eye. Rows have room for 16 more.
  void row(double x, double y, double step, int count, const CausticsTarget& target, Room& room,
           const SurfaceRow& to) const;

 private:
  void make_tile(const WaveNormals::Params& waves, Executor& executor);
  bool copy_tile(const SlopeLevels& slopes, double scale);
  void measure_tile();
  void measure_normals();
  void take_sines(std::span<const SineWave> waves, double strength);
  void row_of_tile(double x, double y, double step, int count, const CausticsTarget& target,
                   std::vector<float>& room, const SurfaceRow& to) const;
  void row_of_normals(double x, double y, double step, int count, const CausticsTarget& target,
                      const SurfaceRow& to) const;

  enum class Source { kSines, kTile, kNormals } source_ = Source::kSines;
  const Frame* frame_ = nullptr;
  const Pass* pass_ = nullptr;
  std::vector<SineWave> sines_;
  bool raised_ = false;
  static constexpr int kTile = 256;  ///< texels along a side of the tile
  std::vector<float> tile_;          ///< slopes x y; the first column and row repeated at the end
  double period_ = 0;                ///< of the tile, in scene units
  glm::dvec2 tile_at_{0, 0};         ///< the eye's place in it
  double slope_ = 0, curvature_ = 0, shortest_ = 0, longest_ = 0;
};

}  // namespace limpid
