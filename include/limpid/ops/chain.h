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
/// THE list of operators, in the order in which they run.
///
/// An operator is four files: its header here (what it models, its parameters), its kernel (the
/// formula) and its source (table of parameters, bound) in src/ops, its test in tests/ops.
/// `tools/dev new-op NAME` makes them. To add it: its include above and its name in Chain below,
/// its kernel's include in src/ops/kernels.h. Look keys, `limpid operators`, plan entry, reference
/// and fused passes and contract tests then come by themselves.
///
/// To add a model to an operator: a value in its enum and the word for it in its table (same place
/// in both), its branch in apply(), its formula in optics/ when it has one, new parameters as
/// members and table rows, and what it reads in reads() and needs(). Nothing outside the operator's
/// files changes, unless the model needs an input that no frame has had before: that is a role in
/// core/frame.h. What the planner asks of an operator is in src/op/operator.h.

namespace limpid {

template <class... Ops>
struct OperatorList {
  static constexpr int kCount = sizeof...(Ops);
  using AllParams = std::tuple<typename Ops::Params...>;

  /// Where an operator stands.
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
