#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"

namespace limpid {

struct Pass;  // what all pixels of a run have in common: the runners make it

/// The part of the plan that the wet pixels of a cell of the picture need.
///
/// Skipped work changes no channel of these pixels by more than `bound` in all, except for rounding
/// (a few 1e-7 of the pixel's own value). With Plan::max_error 0 only work that changes no bit is
/// skipped.
struct CellNeeds {
  std::uint16_t skips = 0;  ///< bit i: operator i of the chain need not run here
  bool dry = false;         ///< no pixel is wet: all are copied
  /// No foreground: refraction's test for objects above the surface cannot fire. With `snap` the
  /// depth nearest to every position that it may look up lies behind every surface of the cell;
  /// with `shorten` every texel that it may tap is accepted. (The test may be left out. All other
  /// reads and mixes of the model must stay.) Never for snell's rays with `shorten`, which need
  /// more tests.
  bool open = false;
  /// The end of the path in the water is invisible. The operators that find the position are
  /// skipped: hit_depth and path must be +inf instead when depth_fog begins.
  bool opaque = false;
  /// A surface was hit wherever refraction may look: its test for none cannot fire.
  bool grounded = false;
  float bound = 0;

  bool needs(int chain_index) const { return ((skips >> chain_index) & 1u) == 0; }
  friend bool operator==(const CellNeeds&, const CellNeeds&) = default;
};

/// Operators that cells skip for their bounds, and the largest of each. (Others are skipped because
/// no operator reads their results.)
struct Weighed {
  std::uint16_t operators = 0;
  std::array<float, Chain::kCount> bounds{};
};

/// Cells of a kind, and how many pixels they hold.
struct CellCount {
  int cells = 0;
  std::int64_t pixels = 0;
};

/// The picture in cells of 128 x 16 pixels, with the part of a plan that each cell's pixels need:
/// found in one pass over depths (shadow and color only if a rule asks for them), from least and
/// greatest values of the cell and of all blocks in reach of its lookups. Cells begin at the corner
/// of Frame::work() whatever the tiles of a run, so that the result depends on plan, frame and
/// scene alone. Where views may start under water (Pass::submersible) every cell needs everything.
class Survey {
 public:
  static constexpr Size kCell{128, 16};

  /// Looks at a frame that has been checked (the runners do that), with the Pass that the plan
  /// runs with. `simd` as in FusedOptions. Makes no allocation after the first frame of a size.
  void make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
            const std::string& simd = {});

  /// Of the cell that holds this pixel of Frame::work().
  const CellNeeds& at(int x, int y) const {
    return cell((y - work_.y0) / kCell.height * cells_.width + (x - work_.x0) / kCell.width);
  }

  /// Cells in rows from the upper left, and their pixels.
  int count() const { return cells_.width * cells_.height; }
  const CellNeeds& cell(int index) const { return needs_[static_cast<std::size_t>(index)]; }
  int across() const { return cells_.width; }  ///< cells in a row
  Rect pixels(int index) const;

  /// Of all cells together. Dry ones are of no other kind, and run nothing.
  struct Summary {
    CellCount all, dry, opaque, open;
    CellCount full;                               ///< skips nothing, and is not open
    std::array<CellCount, Chain::kCount> runs;    ///< where an operator of the plan runs
    std::array<CellCount, Chain::kCount> spared;  ///< where it need not, and cells are not dry
    Weighed weighed;
    double bound = 0;      ///< the largest of all that a cell skips
    std::int64_t wet = 0;  ///< pixels, at most
  };
  const Summary& summary() const { return summary_; }

 private:
  struct Scan;  // one look at one frame
  /// Of the pixels of a cell themselves.
  struct Own {
    int wet = 0;  ///< where the rest is of
    float surface_near = HUGE_VALF, surface_far = 0, near = HUGE_VALF, far = 0;
    float shadow_low = HUGE_VALF, shadow_high = 0;
  };
  /// Greatest values of what lookups may find, least ones with their sign turned.
  using Extremes = std::array<float, 12>;

  void sum_up(const Plan& plan);

  Rect work_;
  Size cells_, blocks_;             ///< of work_; and of all that is looked at, four a cell
  int left_ = 0, up_ = 0;           ///< blocks before those of work_
  std::vector<Own> own_;            ///< a cell
  std::vector<Extremes> extremes_;  ///< a block
  std::vector<Extremes> across_;    ///< of blocks beside a cell, for each row of blocks
  std::vector<CellNeeds> needs_;    ///< a cell
  std::vector<Weighed> weighed_;    ///< a row of cells
  Summary summary_;
};

/// The plan as it runs on a frame: an operator of the plan that runs in no cell is kInvisible here.
/// For reports only; runners take the plan.
std::vector<PlannedOperator> operators_seen(const Plan& plan, const Survey& survey);

/// All of it as text: each operator with its rule, the kinds of cells, and the time of each
/// operator as predicted for one thread (plan/predict.h) and, where they are given, as measured:
/// `seconds` of each operator in chain order, and of all else last.
std::string to_text(const Plan& plan, const Survey& survey, std::span<const double> seconds = {});

}  // namespace limpid
