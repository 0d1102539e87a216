#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// The offset of each color channel from the common refracted ray.
///
/// `axis` ("Realistic Water"): with s = strength * tilt, red is looked up at uv' + (s.x, 0), green
/// at uv' + s / 2, blue at uv' + (0, s.y). Not dispersion: the shifts follow the screen's axes, not
/// the direction of refraction, and do not grow with depth. Kept as in the article.
///
/// `dispersion`: each channel has its own index of refraction, which Refraction uses: water.ior +
/// gain (n(650, 550, 450 nm) - n(550 nm)), with the indices of water at 20 C (Daimon & Masumura
/// 2007, "Measurement of the refractive index of distilled water from the near-infrared region to
/// the ultraviolet region"). gain 1 is water. Three wavelengths stand for three bands: at a large
/// gain colors separate in steps, without a spectrum.
struct PrismSplit {
  enum class Model { kAxis, kDispersion };
  struct Params {
    Model model = Model::kDispersion;
    double strength = 0;
    double gain = 1;
  };

  static constexpr std::string_view kName = "prism_split";
  static constexpr std::string_view kAbout = "Splits the refracted lookup by color channel.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
