#include "limpid/ops/wave_normals.h"

namespace limpid {
namespace {

using P = WaveNormals::Params;

constexpr std::string_view kModels[] = {"four_maps", "plate"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>(
        "model", "Where normals come from; plate normals are taken whenever there are any."),
    real<&P::strength>("strength", "", {0, 4},
                       "How far the maps tilt the surface; 0 is calm, 1 the map as it is."),
    real<&P::tile_size>("tile_size", "scene units", {1e-6, 1e9},
                        "Length of one period of the map."),
    real<&P::speed>("speed", "scene units/s", {-1e6, 1e6}, "Drift of each of the four maps."),
    text<&P::map>("map", "File of the tiling normal map, blue up; relative to the look file."),
};

}  // namespace

std::span<const Field<P>> WaveNormals::fields() { return kFields; }

}  // namespace limpid
