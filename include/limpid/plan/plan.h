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

/// What the planner knows of a job before any pixel is read.
struct Inputs {
  PlaneSet planes;        ///< that the plate has
  bool wave_map = false;  ///< a tiling normal map is at hand
  bool sun = false;
  bool environment = false;       ///< a picture of the surroundings is at hand
  bool waves = false;             ///< the scene has waves of its own
  Primaries primaries = kRec709;  ///< Scene::primaries
};

/// Why an operator runs or does not.
enum class Verdict {
  kKept,
  kNeutral,    ///< its parameters make it the identity
  kAbsent,     ///< an input that it cannot do without is not there
  kUnread,     ///< nothing reads what it makes
  kInvisible,  ///< no cell of a frame needs it (plan/survey.h); never in a Plan, made before pixels
};

struct PlannedOperator {
  std::string_view name;
  Verdict verdict = Verdict::kKept;
  std::string reason;          ///< one phrase, "" for a plain kKept
  std::string_view rule = {};  ///< that decided, "" for a plain kKept
};

/// An operator of the chain, as it is declared.
struct OperatorInfo {
  std::string_view name, about;
  StateSet uses, makes;
  PlaneSet (*reads)(const Look& look);  ///< every plane that it may look up
};
/// In chain order.
std::span<const OperatorInfo> operators();

/// A rule of the planner: what it is called and what it does.
struct RuleInfo {
  std::string_view name, about;
};
/// In the order in which they look at a plan. The last ones look at each cell of a frame, after
/// which the plan is not another, but runs less (plan/survey.h).
std::span<const RuleInfo> rules();

/// What of the chain will run for a job, and why the rest will not. A value: it can be printed,
/// compared and tested without pixels.
struct Plan {
  /// As it will run: models replaced where a rule says so, named waters fitted to the primaries.
  Look look;
  /// Inputs::primaries: a run in a scene of others is refused, for its colors would be wrong.
  Primaries primaries = kRec709;
  std::vector<PlannedOperator> operators;  ///< one an operator, in chain order
  StateSet made;                           ///< by the operators that are kept
  PlaneSet planes;                         ///< that must be read from the plate
  PlaneSet completed;                      ///< that are made from those, where they can be
  StateSet outputs;                        ///< that is written besides the picture
  /// What may be left out together changes no channel of a pixel by more than this (white = 1).
  double max_error = 0;
  /// What was asked for and does nothing, a sentence each: parameters that another one switches
  /// off.
  std::vector<std::string> warnings;

  /// Whether an operator that is kept looks up the tiling normal map.
  bool reads_wave_map = false;
  /// Whether one looks up the surroundings.
  bool reads_environment = false;
  /// Whether one needs to know where the sun stands.
  bool needs_sun = false;
  /// Whether one is lit by the sky: the environment's, else that of the scene.
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

/// `outputs`: the state that is written besides the picture itself (AOVs). Throws Error for a look
/// outside its ranges, when color or depth is absent (there is nothing to put water into), and for
/// a max_error that is negative or not finite.
Plan make_plan(const Look& look, const Inputs& inputs, StateSet outputs = {}, double max_error = 0);

/// A line an operator: name, kept or dropped, reason; and one of max_error, if there is any.
std::string to_text(const Plan& plan);
/// "kept, model plate: the frame has surface normals".
std::string to_text(const PlannedOperator& op);

}  // namespace limpid
