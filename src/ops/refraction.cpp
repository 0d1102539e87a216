#include <algorithm>
#include <cmath>

#include "ops/refraction_kernel.h"

namespace limpid {
namespace {

using P = Refraction::Params;

constexpr std::string_view kModels[] = {"normal_offset", "dudv_offset", "snell"};
constexpr std::string_view kRejections[] = {"none", "snap", "shorten"};
constexpr std::string_view kSteps[] = {"march"};
constexpr std::string_view kOffFrames[] = {"clamp", "shorten", "fog", "continue"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "Model of the refracted lookup."),
    real<&P::strength>("strength", "uv per unit tilt", {-10, 10},
                       "Size of the offset, not for snell; 0 is none.")
        .when("model", {"normal_offset", "dudv_offset"}),
    choice<&P::rejection, kRejections>("rejection",
                                       "Treatment of lookups that land above the surface."),
    count_or_word<&P::steps, kSteps>("steps", "", {0, 64},
                                     "Depth lookups with which snell refines the ray's end; march "
                                     "marches along the ray to the bottom.")
        .when("model", {"snell"}),
    choice<&P::off_frame, kOffFrames>("off_frame", "Treatment of rays that leave the picture."),
    real<&P::thickness>(
        "thickness", "scene units", {0, 1e6},
        "Thickness of thin objects under water along the view; 0 is a third of their width.")
        .when("steps", {"march"}),
};

}  // namespace

std::span<const Field<P>> Refraction::fields() { return kFields; }

/// Without refraction another color in reach is seen. The path through the water changes as well;
/// how much that changes the picture is not known here.
double Kernel<Refraction>::bound(const P&, const Pass& c, const Ranges& ranges) {
  return c.made.has(StatePart::kTransmittance) ? HUGE_VAL : ranges.contrast();
}

void Kernel<Refraction>::propagate_ranges(const P& params, const Pass& c, Ranges& ranges) {
  const Range surface = ranges.surface, seen = ranges.looked_up;
  const bool fades = params.off_frame == OffFrame::kFog;
  // If even a pixel's own texel of the layer below is empty, the depth there is infinite.
  const bool nothing =
      SeenPlanes::of(c).below && params.rejection == Rejection::kShorten && !(seen.max < 1e30);
  const bool known = surface.max < HUGE_VAL && !nothing;
  ranges.hit = {known ? std::max(seen.min - surface.max, 0.0) : 0,
                std::max(seen.max - surface.min, 0.0)};
  if (params.model == Model::kSnell) {
    // Heights are differences of numbers of this size, in float.
    const double slack = 2e-6 * (std::abs(c.eye_above) + surface.max);
    const double drop = params.steps == 0
                            ? bound_product(ranges.own.min, std::max(ranges.sink.min, 0.0))
                            : ranges.least_drop;
    ranges.path = {known ? std::max(drop - slack, 0.0) : 0, HUGE_VAL};
    // The ray's own depth at its end, or a texel's depth where a texel is looked up.
    const bool of_texel = params.steps == 0 || params.rejection == Rejection::kShorten;
    const bool continues = params.continues_bottom() && c.continuation;
    const bool behind = params.uses_bottom_layer() && c.bottom_layer;
    if (!of_texel || continues || behind) ranges.hit = {0, HUGE_VAL};
    // A ray falls at most one unit per unit of its length.
    if (continues) ranges.path.min = std::min(ranges.path.min, c.continuation->least_drop);
  } else {
    const auto bent = [&](double cosine) {
      return cosine / std::max(refracted_cosine(cosine, 1 / c.ior), 0.02);
    };
    const Range cosine = ranges.cosine();
    ranges.path = {bound_product(ranges.hit.min, bent(std::max(cosine.min - 1e-6, 0.0))),
                   bound_product(ranges.hit.max, ranges.ray_length.max * bent(cosine.max))};
  }
  if (!fades) return;
  ranges.path.max = HUGE_VAL;
  for (Range& color : ranges.color) {
    color = {std::min(color.min, 0.0), std::max(color.max, 0.0)};
  }
}

/// With `snap` no texel that is looked up may lie in front of the cell's water; with `shorten`
/// every texel that is tapped must count. Rays of snell with `shorten` have further conditions.
bool Kernel<Refraction>::foreground_free(const P& params, const InReach& reach) {
  switch (params.rejection) {
    case Rejection::kNone:
      return false;
    case Rejection::kSnap:
      return reach.below || reach.nearest >= reach.surface_far;
    case Rejection::kShorten:
      return params.model != Model::kSnell && reach.all_under &&
             (!reach.below || reach.farthest < 1e30);
  }
  return false;
}

double Kernel<Refraction>::ns(const P& p, const Running& running) {
  const bool split = running.made.has(StatePart::kPrism);
  const double lookups = split ? 5 : 3;
  const double steps = p.model != Model::kSnell ? 0.5 : p.steps < 0 ? 90 : 4 + 8.0 * p.steps;
  const double test = p.rejection == Rejection::kShorten ? (split ? 50 : 26)
                      : p.rejection == Rejection::kSnap  ? 1.5
                                                         : 0.5;
  return lookups + steps + test;
}

}  // namespace limpid
