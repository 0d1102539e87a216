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

struct Pass;  // the data that all pixels of a run share, made by the runners

/// The part of the plan that the wet pixels of a cell need.
///
/// All skipped work together changes no channel of these pixels by more than `bound`, except for
/// rounding (a few 1e-7 of the pixel's value). With Plan::max_error 0 only work that changes no bit
/// is skipped.
struct CellNeeds {
  std::uint16_t skips = 0;  ///< bit i: operator i of the chain need not run here
  bool dry = false;         ///< no pixel is wet: all pixels are copied
  /// No foreground: refraction's test for objects above the surface would accept every lookup. With
  /// `snap` the depth nearest to every position that it may look up lies behind every surface of
  /// the cell; with `shorten` every texel that it may read is accepted. Only the test may be
  /// skipped; all other reads and mixes of the model must stay. Never true for snell's rays with
  /// `shorten`, which need more tests.
  bool open = false;
  /// The end of the path in the water is invisible, and the operators that find the position are
  /// skipped. hit_depth and path must be +inf instead when depth_fog begins.
  bool opaque = false;
  /// A surface was hit at every position that refraction may look up, so its test for empty texels
  /// may be skipped.
  bool grounded = false;
  float bound = 0;

  bool needs(int chain_index) const { return ((skips >> chain_index) & 1u) == 0; }
  friend bool operator==(const CellNeeds&, const CellNeeds&) = default;
};

/// The operators that cells skip for their bounds, and the largest bound of each. Other operators
/// are skipped because no operator reads their results.
struct SkippedByBound {
  std::uint16_t operators = 0;
  std::array<float, Chain::kCount> bounds{};
};

/// The number of cells of a kind, and of their pixels.
struct CellCount {
  int cells = 0;
  std::int64_t pixels = 0;
};

/// The picture in cells of 128 x 16 pixels, with the part of a plan that the pixels of each cell
/// need. One pass over the depths (over shadow and color only if a rule needs them) finds the least
/// and greatest values of each cell and of all blocks in reach of its lookups. Cells begin at the
/// corner of Frame::work(), independent of the tiles of a run, so the result depends on plan, frame
/// and scene alone. If views may start under water (Pass::submersible), every cell needs the whole
/// plan.
class Survey {
 public:
  static constexpr Size kCell{128, 16};

  /// Surveys a frame that the runner has validated, with the Pass of the run. `simd` as in
  /// FusedOptions. Allocates no memory after the first frame of a size.
  void make(const Plan& plan, const Frame& frame, const Pass& pass, Executor& executor,
            const std::string& simd = {});

  /// The needs of the cell with this pixel of Frame::work().
  const CellNeeds& at(int x, int y) const {
    return cell((y - work_.y0) / kCell.height * cells_.width + (x - work_.x0) / kCell.width);
  }

  /// The number of cells; they are numbered row by row from the upper left.
  int count() const { return cells_.width * cells_.height; }
  const CellNeeds& cell(int index) const { return needs_[static_cast<std::size_t>(index)]; }
  int across() const { return cells_.width; }  ///< cells in a row
  Rect pixels(int index) const;

  /// Sums over all cells. Dry cells run no operator and count as no other kind.
  struct Summary {
    CellCount all, dry, opaque, open;
    CellCount full;                                ///< cells that skip no operator and are not open
    std::array<CellCount, Chain::kCount> runs;     ///< cells that run the operator of the plan
    std::array<CellCount, Chain::kCount> skipped;  ///< wet cells that skip it
    SkippedByBound by_bound;
    double bound = 0;      ///< the largest CellNeeds::bound
    std::int64_t wet = 0;  ///< upper limit on the number of wet pixels
  };
  const Summary& summary() const { return summary_; }

 private:
  struct Scan;  // the arguments of one make()
  /// Values of the pixels of a cell.
  struct Own {
    int wet = 0;  ///< number of wet pixels, of which the other members are
    float surface_near = HUGE_VALF, surface_far = 0, near = HUGE_VALF, far = 0;
    float shadow_low = HUGE_VALF, shadow_high = 0;
  };
  /// Greatest values that lookups may find, and least values with the opposite sign.
  using Extremes = std::array<float, 12>;

  void sum_up(const Plan& plan);

  Rect work_;
  Size cells_, blocks_;    ///< cells of work_; blocks of all surveyed pixels, four per cell
  int left_ = 0, up_ = 0;  ///< blocks to the left of work_ and above it
  std::vector<Own> own_;   ///< per cell
  std::vector<Extremes> extremes_;        ///< per block
  std::vector<Extremes> across_;          ///< of the blocks beside a cell, per row of blocks
  std::vector<CellNeeds> needs_;          ///< per cell
  std::vector<SkippedByBound> by_bound_;  ///< per row of cells
  Summary summary_;
};

/// The operators of a plan with their verdicts on a frame: an operator that runs in no cell is
/// kInvisible. For reports only; runners take the plan.
std::vector<PlannedOperator> operators_seen(const Plan& plan, const Survey& survey);

/// Plan and survey as text: each operator with its rule, the kinds of cells, and the time of each
/// operator, predicted for one thread (plan/predict.h) and, if `seconds` is not empty, measured.
/// `seconds` has the time of each operator in chain order, and last the time of all other work.
std::string to_text(const Plan& plan, const Survey& survey, std::span<const double> seconds = {});

}  // namespace limpid
