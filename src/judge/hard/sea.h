#pragma once
#include <glm/mat3x3.hpp>

#include "limpid/core/scene.h"

#include "judge/hard/hard_case.h"
#include "judge/hard/world.h"

namespace limpid {

/// A camera over calm water with a level bottom, and the true values of its pixels: by trigonometry
/// in long double, not by the library's own functions.
struct Sea {
  Size size{48, 27};
  double height = 2;        ///< of the eye over the water
  double depth = 1;         ///< of the bottom under it
  double down = 30;         ///< degrees that the view axis points below the horizon
  double fov = 50;          ///< degrees, vertical
  double orthographic = 0;  ///< height of the picture in scene units, instead of fov
  glm::dvec2 shift{0, 0};
  double pixel_aspect = 1;
  double near = 0.1, far = 1e4;
  ClipSpace clip = ClipSpace::kGl;
  bool turned = false;  ///< turns the whole world, so that no two axes are parallel

  struct Pixel {
    bool water = false;           ///< in front of the eye
    long double surface, bottom;  ///< eye depths, for wet pixels
    long double length;           ///< of the ray per unit of eye depth
    long double cosine;           ///< of the view to the calm normal
    long double fall, forward;    ///< of the ray, per unit of eye depth; forward is level
  };
  Pixel at(int x, int y) const;
  glm::dmat3 turn() const;
  glm::dvec3 up() const { return turn()[1]; }

  Scene scene() const;
  /// Planes: color, a ramp; shadow 1; depth; reflection, a ramp; and surface depth if requested.
  /// Rays that meet no water see the sky.
  HardFrame frame(bool with_surface = true) const;
};

/// The judged quantities of a sea, each with its own bound: roundings counted along the formulas.
enum class SeaError { kSurface, kPath, kReflectance };
/// The largest error over its bound, of calm_look() by every runner. Infinite if a pixel is wrongly
/// wet or wrongly dry.
Worst sea_error(const HardWorld& world, const Sea& sea, SeaError what);

/// Adds cases for all three quantities.
void add_sea_cases(HardCases& cases, const std::string& group, const std::string& name,
                   const Sea& sea);

/// cos of the refracted ray from that of the view, by Snell's law.
long double refracted_cosine_of(long double cosine, long double ior);
/// Exact reflectance from above.
long double reflectance_of(long double cosine, long double ior);

}  // namespace limpid
