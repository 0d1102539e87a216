#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Shows the dry picture through the finished surface, like engines that blend the water surface
/// over the scene. Last in the chain; only for views from the air.
///
/// `view_angle` (Rito15 2021): out = lerp(dry color at this pixel, out, a), a = sat(alpha - amount
/// sat(V.up)^power) with the calm normal, so that the surface is most transparent straight down.
/// The dry color is neither refracted nor fogged, and counts as transmitted light. Where no surface
/// was hit behind the water, the water surface is unchanged. Not physical: besides refraction and
/// Fresnel transmission, it transmits the light a second time.
struct Penetration {
  enum class Model { kNone, kViewAngle };
  struct Params {
    Model model = Model::kNone;
    double alpha = 1;
    double amount = 0.2;
    double power = 5;
  };

  static constexpr std::string_view kName = "penetration";
  static constexpr std::string_view kAbout = "Blends the finished surface over the dry picture.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
