#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// The net of light on the bottom: sunlight that the waves focus there.
///
/// Sunlight on the bottom is multiplied by 1 + strength (E - 1), per channel. E is the sun's light
/// on the bottom over that under calm water, by light that is followed from the waves down
/// (complete/caustics.h), looked up at the point where the refracted view ray ends, each channel
/// with its own index of refraction. How much of the bottom's light comes straight from the sun,
/// frames with sun_color say; else, of a level bottom as the shadow, the sun and the sky's radiance
/// tell; else `sun_share` where the sun shines.
///
/// The dry picture has the sun's shadows where straight light casts them. `refracted` moves them to
/// where the water bends them, of frames with sun_color, shadow and surface_shadow: out goes the
/// straight shadow, with what the bottom's other light and the sunlit bottoms around tell of the
/// sun's light there; in comes the shadow on the surface where calm water lets that light in. What
/// is cast below the surface stays: that is the shadow on the bottom over that on the surface along
/// the straight way. Near the picture's edge shadows pass into the straight ones.
///
/// Where the bottom is seen from the air, from within the water, or there in the surface, of frames
/// with a reflection and its depth. The light of waves that are not known, beyond what was made of
/// them, and of what is wider in a pixel than the waves are long, is that of calm water.
struct Caustics {
  enum class Shadows { kStraight, kRefracted };
  struct Params {
    double strength = 1;
    double sun_share = 0.8;
    Shadows shadows = Shadows::kRefracted;
  };

  static constexpr std::string_view kName = "caustics";
  static constexpr std::string_view kAbout = "Sunlight that the waves focus on the bottom.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
