#include <cmath>

#include "ops/wave_normals_kernel.h"

namespace limpid {
namespace {

using P = WaveNormals::Params;

constexpr std::string_view kModels[] = {"four_maps", "two_flows", "dudv",
                                        "sines",     "slopes",    "plate"};

constexpr std::string_view kFilters[] = {"none", "mip", "variance"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>(
        "model", "Source of the normals; normals of the plate always take precedence."),
    choice<&P::filter, kFilters>(
        "filter", "Filter of waves smaller than a pixel: none, their mean, or mean and variance."),
    real<&P::strength>("strength", "", {0, 4},
                       "Factor of the slopes, except of plate normals; 0 is calm, 1 the slopes of "
                       "the map or of the wind.")
        .when("model", {"four_maps", "two_flows", "dudv", "sines", "slopes"}),
    real<&P::tile_size>("tile_size", "scene units", {1e-6, 1e9}, "Length of one period of the map.")
        .when("model", {"four_maps", "two_flows", "dudv", "slopes"}),
    real<&P::speed>("speed", "scene units/s", {-1e6, 1e6}, "Speed of the map's drift.")
        .when("model", {"four_maps", "two_flows", "dudv", "slopes"})
        .when("wind", {"0"}),
    real<&P::direction>(
        "direction", "deg", {-360, 360},
        "Direction to which the wind blows or two_flows drifts: 0 is map x, 90 map y.")
        .when("model", {"four_maps", "two_flows", "dudv", "slopes"})
        .when("model", {"two_flows"})
        .or_above_zero("wind"),
    real<&P::wind>(
        "wind", "m/s", {0, 30},
        "Wind that sets drift and slopes as on a sea, slopes times strength; 0: those of the map.")
        .when("model", {"four_maps", "two_flows", "dudv", "slopes"}),
    text<&P::map>("map", "File of the tiling normal map, blue up; relative to the look file.")
        .when("model", {"four_maps", "two_flows", "dudv", "slopes"}),
    table<&P::waves>("waves", "", {-1e6, 1e6},
                     "Sine waves; empty: those of the scene. Phase in rad, k in rad / scene unit, "
                     "omega in rad/s, by default that of deep water.")
        .when("model", {"sines"}),
};

}  // namespace

std::span<const Field<P>> WaveNormals::fields() { return kFields; }

Sym2<double> Kernel<WaveNormals>::wave_variance(const P& params, const TextureLevels& map,
                                                double time) {
  switch (params.model) {
    case Model::kFourMaps:
    case Model::kSlopes:
      return slope_variance(map, four_shifts(params, time));
    case Model::kTwoFlows:  // (h1 + h2 / 2) / (3 / 2), as if h1 and h2 were uncorrelated
      return 1.25 / 2.25 * slope_variance(map, {});
    case Model::kDudv: {  // z / ((1 + z) / 2), because blue is not decoded; z of the mean slope
      const Sym2<double> whole = slope_variance(map, {});
      const double z = 1 / std::sqrt(1 + whole.xx + whole.yy), flatter = 2 * z / (1 + z);
      return flatter * flatter * whole;
    }
    case Model::kSines:
    case Model::kPlate:
      break;
  }
  return {0, 0, 0};
}

/// All later operators depend on the normal.
double Kernel<WaveNormals>::bound(const P&, const Pass&, const Ranges&) { return HUGE_VAL; }

std::string_view Kernel<WaveNormals>::prefer(P& params, const AtHand& has) {
  if (!has.planes.covers(kSurfaceNormalPlanes) || params.model == Model::kPlate) return "";
  params.model = Model::kPlate;
  return "model plate: the frame has surface normals";
}

double Kernel<WaveNormals>::ns(const P& p, const Running&) {
  const bool variance = p.filter == Filter::kVariance;
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

}  // namespace limpid
