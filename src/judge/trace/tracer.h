#pragma once
#include "judge/trace/medium.h"
#include "judge/trace/samples.h"
#include "judge/trace/solid.h"
#include "judge/trace/sun_path.h"
#include "judge/trace/surface.h"
#include "judge/trace/truth.h"
#include "judge/trace/walk.h"
#include "op/pass.h"

namespace limpid::trace {

/// The light along a view ray, by the terms of the chain.
struct Light {
  Rgb<double> transmitted{0, 0, 0}, in_scatter{0, 0, 0}, reflected{0, 0, 0}, highlight{0, 0, 0};
  double fresnel = 0;
  Rgb<double> transmittance{1, 1, 1};

  Rgb<double> sum() const { return transmitted + in_scatter + reflected + highlight; }
};

/// All surfaces of one picture, and the light of rays through them.
class Tracer {
 public:
  Tracer(const Model& model, const Scene& scene, const Look& look, const TruthOptions& options,
         const Pass& pass, const Eye& eye, Executor& executor);
  Tracer(const Tracer&) = delete;  // its parts have references to each other

  /// `steps`: number of samples of the sun's shadow along a path with single scattering; else
  /// `paths` are the numbers for random paths.
  Light seen(const Beam& beam, bool in_water, int steps, Samples& samples, Samples& paths) const;

  const Solid& solid() const { return solid_; }
  const Surface& surface() const { return surface_; }
  const Medium& medium() const { return medium_; }

 private:
  /// The state of a view ray.
  struct View {
    int events = 0;         ///< crossings and reflections at the surface
    int layers = 0;         ///< blended surfaces passed
    bool mirrored = false;  ///< for the light where it leaves the scene
    bool from_air = true;   ///< where the eye is
    int steps;
    Samples& samples;
    Samples& paths;
  };
  /// The light of a path through the water, in one band, for the view.
  struct Leg {
    Rgb<double> through{0, 0,
                        0};  ///< light from its end: the bottom, or the scene beyond the surface
    Rgb<double> mirrored{0, 0, 0};  ///< reflected by the surface, from below
    Rgb<double> in_scatter{0, 0, 0};
    Rgb<double> transmittance{0, 0, 0};
    double fresnel = 0;  ///< of the surface at its end
  };

  std::optional<Caustics> caustics_of(const TruthOptions& options, const Eye& eye,
                                      Executor& executor) const;
  Light in_air(const Beam& beam, View view) const;
  Light from_water(const Beam& beam, View view) const;
  Leg through_water(const Beam& beam, const Band& band, View view) const;
  Light through_layer(const SolidPoint& layer, const Beam& beam, View view) const;
  Leg through_layer(const SolidPoint& layer, const Beam& beam, const Band& band, View view) const;
  Rgb<double> end_light(const SolidPoint* dry, const Beam& beam, double length, const Band& band,
                        const View& view) const;
  std::optional<SolidPoint> nearest_dry(const Beam& beam, const View& view) const;
  Rgb<double> bottom_light(const SolidPoint& point, const Beam& beam, const Band& band,
                           const View& view) const;
  Rgb<double> scattered(const Ray& ray, double length, const Band& band, const View& view) const;
  double sunlit_column(const Ray& ray, double length, double rate, double down, const Band& band,
                       const View& view) const;
  double sunlit_share(const Ray& ray, double length, double loss, int steps, const Band& band,
                      const View& view) const;

  Rgb<double> scattered_once(const Ray& ray, double length, const Band& band,
                             const View& view) const;
  Rgb<double> bottom_lit_once(const SolidPoint& point, const Beam& beam, const Band& band) const;
  Rgb<double> background(const glm::dvec3& direction, const View& view) const;
  Rgb<double> highlight(const SurfacePoint& at, const glm::dvec3& to_viewer) const;

  const Pass& pass_;
  const Look& look_;
  const TruthOptions::Light light_;
  const Texture environment_;
  Rgb<double> background_;
  Sunlight sun_;  ///< in the air
  Medium medium_;
  Solid solid_;
  Surface surface_;
  SunPath sun_path_;
  Sky sky_;
  std::optional<Caustics> caustics_;
  Walk walk_;
};

}  // namespace limpid::trace
