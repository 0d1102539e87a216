#include "plan/predict.h"

#include <algorithm>

namespace limpid {
namespace {

// The table, by operator and model; an operator that is not in it counts as one short formula.

template <class Params>
double ns_of(const Params&, const Plan&) {
  return 1;
}

double ns_of(const WaveNormals::Params& p, const Plan&) {
  using Model = WaveNormals::Model;
  const bool variance = p.filter == WaveNormals::Filter::kVariance;
  switch (p.model) {
    case Model::kPlate:
      return variance ? 6 : 0.5;
    case Model::kSines:
      return 0.5 + (variance ? 4.0 : 2.0) * static_cast<double>(p.waves.size());
    case Model::kTwoFlows:
    case Model::kDudv:
      return 6;
    case Model::kFourMaps:
    case Model::kSlopes:
      return 11;
  }
  return 1;
}

double ns_of(const PrismSplit::Params&, const Plan&) { return 0.3; }

double ns_of(const Refraction::Params& p, const Plan& plan) {
  using Model = Refraction::Model;
  using Rejection = Refraction::Rejection;
  const bool split = plan.made.has(StatePart::kPrism);
  const double lookups = split ? 5 : 3;
  const double steps = p.model != Model::kSnell ? 0.5 : p.steps < 0 ? 90 : 4 + 8.0 * p.steps;
  const double test = p.rejection == Rejection::kShorten ? (split ? 50 : 26)
                      : p.rejection == Rejection::kSnap  ? 1.5
                                                         : 0.5;
  return lookups + steps + test;
}

double ns_of(const DepthFog::Params& p, const Plan&) {
  return p.model == DepthFog::Model::kLinear ? 0.6 : 9;
}

double ns_of(const WaterShadow::Params& p, const Plan&) {
  return p.model == WaterShadow::Model::kDarken ? 1.2 : 1.6;
}

double ns_of(const FresnelReflection::Params& p, const Plan& plan) {
  using F = FresnelReflection;
  const double formula =
      p.reflectance == F::Reflectance::kRim || p.reflectance == F::Reflectance::kInversePower ? 1.5
                                                                                              : 0.6;
  if (p.source == F::Source::kConstant) return formula;
  const double facets = p.facets == F::Facets::kSpread ? 1.6 : 1;
  if (p.source == F::Source::kEnvironment) return formula + 8 * facets;
  if (p.source == F::Source::kAuto && !plan.planes.covers(kReflectionPlanes)) {
    return formula + 150 * facets;
  }
  const PlaneSet seen = plan.planes | plan.completed;
  if (p.source == F::Source::kAuto && seen.has(PlaneId::kReflectionDepth)) {
    return formula + 55 * facets;
  }
  const bool probes = plan.planes.has(PlaneId::kReflectionValid);
  if (p.lookup == F::Lookup::kOffset) return formula + (probes ? 12 : 3);
  return formula + (plan.planes.has(PlaneId::kReflectionDepth) ? 30 : probes ? 16 : 4);
}

double ns_of(const SunHighlight::Params& p, const Plan&) {
  return p.model == SunHighlight::Model::kGgx      ? 2.5
         : p.model == SunHighlight::Model::kSlopes ? 4
                                                   : 2;
}

double ns_of(const Penetration::Params&, const Plan&) { return 1.5; }

}  // namespace

double predicted_ns(const Plan& plan, int chain_index) {
  if (!plan.keeps(chain_index)) return 0;
  double ns = 0;
  Chain::for_each([&]<class Op, int I>() {
    if (I == chain_index) ns = ns_of(plan.look.of<Op>(), plan);
  });
  return ns;
}

}  // namespace limpid
