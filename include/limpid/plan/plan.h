#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/color_space.h"
#include "limpid/core/frame.h"
#include "limpid/core/state.h"
#include "limpid/ops/look.h"
#include "limpid/plan/completers.h"

namespace limpid {

/// The properties of a job that the planner knows before pixels are read.
struct Inputs {
  PlaneSet planes;        ///< planes of the plate
  bool wave_map = false;  ///< there is a tiling normal map
  bool sun = false;
  bool environment = false;       ///< there is a picture of the surroundings
  bool waves = false;             ///< Scene::has_waves()
  Primaries primaries = kRec709;  ///< Scene::primaries
};

/// Whether an operator runs, or the reason why it does not.
enum class Verdict {
  kKept,
  kNeutral,  ///< does not run: its parameters make it the identity
  kAbsent,   ///< does not run: a required input is absent
  kUnread,   ///< does not run: no other operator or output reads its results
  /// no cell of a frame needs it (plan/survey.h); never in a Plan, which knows no pixels
  kInvisible,
};

struct PlannedOperator {
  std::string_view name;
  Verdict verdict = Verdict::kKept;
  std::string reason;          ///< one phrase, "" for a plain kKept
  std::string_view rule = {};  ///< name of the deciding rule, "" for a plain kKept
};

/// The declaration of an operator of the chain.
struct OperatorInfo {
  std::string_view name, about;
  StateSet uses, makes;
  PlaneSet (*reads)(const Look& look);  ///< all planes that it may look up
};
/// All operators, in chain order.
std::span<const OperatorInfo> operators();

/// The name and description of a rule of the planner.
struct RuleInfo {
  std::string_view name, about;
};
/// All rules, in the order in which they edit a plan. The last rules do not change the plan: they
/// skip operators in the cells of a frame (plan/survey.h).
std::span<const RuleInfo> rules();

/// The operators that will run for a job, and the reasons why others will not. A value, which can
/// be printed, compared and tested without pixels.
struct Plan {
  /// The look as it will run: rules may have replaced models, and named water types are fitted to
  /// the primaries.
  Look look;
  /// Inputs::primaries. Runners refuse the plan for a scene with other primaries, since its colors
  /// would be wrong.
  Primaries primaries = kRec709;
  std::vector<PlannedOperator> operators;  ///< all operators, in chain order
  StateSet made;                           ///< results of the operators that run
  PlaneSet planes;                         ///< planes that must be read from the plate
  PlaneSet completed;  ///< planes that completers make from these, if their inputs are present
  StateSet outputs;    ///< state that is written besides the picture
  /// Limit on the change of each channel of a pixel by all skipped operators together (white = 1).
  double max_error = 0;
  /// Sentences on settings without an effect, such as a parameter that another one switches off.
  std::vector<std::string> warnings;

  /// Whether an operator that runs looks up the tiling normal map.
  bool reads_wave_map = false;
  /// Whether one looks up the environment.
  bool reads_environment = false;
  /// Whether one needs the direction of the sun.
  bool needs_sun = false;
  /// Whether one uses the sky's light: of the environment, else the scene, else the picture.
  bool lit_by_sky = false;

  bool keeps(int chain_index) const { return operators[chain_index].verdict == Verdict::kKept; }
  template <class Op>
  const PlannedOperator& of() const {
    return operators[Chain::index_of<Op>()];
  }
  template <class Op>
  bool keeps() const {
    return keeps(Chain::index_of<Op>());
  }
};

/// `outputs`: the state that is written besides the picture (AOVs). Throws Error for a look outside
/// its ranges, if color or depth is absent, and for a max_error that is negative or not finite.
Plan make_plan(const Look& look, const Inputs& inputs, StateSet outputs = {}, double max_error = 0);

/// One line per operator: name, kept or skipped, reason; and a line with max_error if it is above
/// 0.
std::string to_text(const Plan& plan);
/// "kept, model plate: the frame has surface normals".
std::string to_text(const PlannedOperator& op);

}  // namespace limpid
