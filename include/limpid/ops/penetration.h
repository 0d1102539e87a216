#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Lets the dry picture through the finished surface, as engines do that blend the water's surface
/// over the scene. Last in the chain; only where the view comes from the air.
///
/// `view_angle` (Rito15 2021): out = lerp(dry color at this pixel, out, a), a = sat(alpha - amount
/// sat(V.up)^power) with the calm normal, so that one sees through most straight down. The dry
/// color is neither refracted nor fogged, and counts as transmitted light. Where nothing was hit
/// behind the water there is nothing to let through: the surface stays as it is. Not physical: on
/// top of refraction and Fresnel, which say how much passes, it lets light through twice.
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
