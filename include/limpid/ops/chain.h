#pragma once
#include <tuple>
#include <type_traits>
#include <utility>

#include "limpid/ops/caustics.h"
#include "limpid/ops/depth_fog.h"
#include "limpid/ops/fresnel_reflection.h"
#include "limpid/ops/penetration.h"
#include "limpid/ops/prism_split.h"
#include "limpid/ops/refraction.h"
#include "limpid/ops/sun_highlight.h"
#include "limpid/ops/water_shadow.h"
#include "limpid/ops/wave_normals.h"

/// @file
/// The list of operators, in the order in which they run.
///
/// An operator has four files: its header beside this one (models and parameters), its kernel (the
/// formula) and its source (table of parameters, bound) in src/ops, and its test in tests/ops.
/// `tools/dev new-op NAME` makes them. To add the operator to the chain, add its include above, its
/// name in Chain below, and its kernel's include in src/ops/kernels.h. Look keys, `limpid
/// operators`, plan entry, runners and contract tests follow automatically.
///
/// To add a model to an operator, add a value to its enum and the word for it in its table (at the
/// same index), its branch in apply(), its formula in optics/ if it has one, new parameters as
/// members and table rows, and its inputs in reads() and needs(). No other file changes, unless the
/// model needs a new input plane: that is a role in core/frame.h. src/op/operator.h has the
/// interface of operators to the planner.

namespace limpid {

template <class... Ops>
struct OperatorList {
  static constexpr int kCount = sizeof...(Ops);
  using AllParams = std::tuple<typename Ops::Params...>;

  /// The index of an operator in the list.
  template <class Op>
  static constexpr int index_of() {
    constexpr bool kIs[] = {std::is_same_v<Op, Ops>...};
    static_assert((std::is_same_v<Op, Ops> || ...), "an operator of the chain");
    int index = 0;
    while (!kIs[index]) ++index;
    return index;
  }

  /// Calls fn.operator()<Op, index>() for each operator in order.
  template <class Fn>
  static constexpr void for_each(Fn&& fn) {
    [&]<int... I>(std::integer_sequence<int, I...>) { (fn.template operator()<Ops, I>(), ...); }
    (std::make_integer_sequence<int, kCount>{});
  }
};

using Chain = OperatorList<WaveNormals, PrismSplit, Refraction, Caustics, DepthFog, WaterShadow,
                           FresnelReflection, SunHighlight, Penetration>;

}  // namespace limpid
