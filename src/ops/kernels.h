#pragma once
#include "limpid/ops/chain.h"

#include "op/operator.h"
#include "ops/caustics_kernel.h"
#include "ops/depth_fog_kernel.h"
#include "ops/fresnel_reflection_kernel.h"
#include "ops/penetration_kernel.h"
#include "ops/prism_split_kernel.h"
#include "ops/refraction_kernel.h"
#include "ops/sun_highlight_kernel.h"
#include "ops/water_shadow_kernel.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {

template <class List>
struct KernelsOf;
template <class... Ops>
requires(Operator<Kernel<Ops>>&&...) struct KernelsOf<OperatorList<Ops...>> {
  using List = OperatorList<Kernel<Ops>...>;
};

/// The kernels of the chain's operators, in its order.
using Kernels = KernelsOf<Chain>::List;

}  // namespace limpid
