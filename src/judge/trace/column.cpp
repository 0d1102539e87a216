#include "judge/trace/column.h"

#include <algorithm>
#include <numbers>

#include "judge/trace/chances.h"
#include "judge/trace/directions.h"
#include "judge/trace/mean_light.h"
#include "judge/trace/samples.h"
#include "optics/absorption.h"
#include "optics/fresnel.h"
#include "optics/refract.h"

namespace limpid {
namespace {

using trace::Chances;
using trace::Samples;

constexpr double kLeastCosine = 1e-6;  ///< below it a sun gives no light
constexpr double kDeepest = 2000;

/// The direction at a height above the horizon and an azimuth; up is z.
glm::dvec3 towards(double height, double azimuth) {
  const double h = height * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
  return {std::cos(h) * std::cos(a), std::cos(h) * std::sin(a), std::sin(h)};
}

class Walker {
 public:
  explicit Walker(const Column& column)
      : column_(column), rate_(column.absorption + column.scattering), end_(column.depth) {
    const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
    albedo_ = {share(column.scattering.r, rate_.r), share(column.scattering.g, rate_.g),
               share(column.scattering.b, rate_.b)};
    const double least = std::min({rate_.r, rate_.g, rate_.b}) * (1 - column.anisotropy);
    if (end_ * least > kDeepest) {
      end_ = kDeepest / least;
      endless_ = true;
    }
    let_sun_in();
    look_in();
  }

  Rgb<double> walk(Samples& samples) const {
    Rgb<double> light{0, 0, 0};
    Chances chances({1, 1, 1}, samples.next());
    glm::dvec3 ahead = view_;
    double depth = 0;
    for (;;) {
      const double to_edge = ahead.z < 0 ? (end_ - depth) / -ahead.z : depth / ahead.z;
      const double distance = -std::log1p(-samples.next()) / chances.drawn(rate_);
      if (distance < to_edge) {
        depth -= distance * ahead.z;
        chances.go_on(rate_ * transmittance(distance, rate_));
        light = light + henyey_greenstein(glm::dot(to_sun_, ahead), column_.anisotropy) *
                            (chances.worth() * albedo_ * sunlight_at(depth));
        if (samples.next() >= chances.drawn(albedo_)) return light;
        chances.go_on(albedo_);
        const double u = samples.next();
        ahead = trace::scattered_direction(ahead, column_.anisotropy, u, samples.next());
        continue;
      }
      if (!(to_edge < HUGE_VAL)) return light;
      chances.go_on(transmittance(to_edge, rate_));
      if (ahead.z >= 0) {
        depth = 0;
        const double thrown_back =
            column_.real_surface ? fresnel_exact(ahead.z, 1 / column_.ior) : 0;
        if (samples.next() >= thrown_back) return light + sky_ * (chances.worth() * column_.sky);
        ahead.z = -ahead.z;
        continue;
      }
      if (endless_) return light;
      depth = end_;
      light = light + std::max(to_sun_.z, 0.0) / std::numbers::pi *
                          (chances.worth() * column_.bottom * sunlight_at(depth));
      if (samples.next() >= chances.drawn(column_.bottom)) return light;
      chances.go_on(column_.bottom);
      const double u = samples.next();
      ahead = trace::diffuse_direction({0, 0, 1}, u, samples.next());
    }
  }

  double leaves() const { return leaves_; }

 private:
  void let_sun_in() {
    const glm::dvec3 in_air = towards(column_.sun, column_.azimuth);
    to_sun_ = in_air;
    if (in_air.z < kLeastCosine) return;
    double spread = 1;
    if (column_.real_surface) {
      to_sun_ = in_air / column_.ior;
      to_sun_.z = refracted_cosine(in_air.z, 1 / column_.ior);
      spread = (1 - fresnel_exact(in_air.z, column_.ior)) * in_air.z / to_sun_.z;
    }
    sun_ = spread * column_.irradiance;
  }

  void look_in() {
    const glm::dvec3 to_eye = towards(column_.view, 0);
    view_ = -to_eye / column_.ior;
    view_.z = -refracted_cosine(to_eye.z, 1 / column_.ior);
    const double square = column_.real_surface ? column_.ior * column_.ior : 1;
    leaves_ = (1 - fresnel_exact(to_eye.z, column_.ior)) / square;
    sky_ = square;
  }

  /// On a surface that faces the sun, at that depth.
  Rgb<double> sunlight_at(double depth) const {
    if (sun_ == Rgb<double>{0, 0, 0}) return sun_;
    return transmittance(depth / to_sun_.z, rate_) * sun_;
  }

  const Column& column_;
  Rgb<double> rate_, albedo_{0, 0, 0};
  double end_;            ///< depth
  bool endless_ = false;  ///< no light returns from below end_
  glm::dvec3 to_sun_{0, 0, 1}, view_{0, 0, -1};
  Rgb<double> sun_{0, 0, 0};  ///< on a surface that faces it, under the water surface
  double leaves_ = 1, sky_ = 1;
};

}  // namespace

ColumnLight trace_column(const Column& column, std::uint64_t paths, std::uint64_t seed) {
  const Walker walker(column);
  trace::MeanLight mean;
  for (std::uint64_t i = 0; i < std::max<std::uint64_t>(paths, 2); ++i) {
    Samples samples(seed, static_cast<int>(i & 0x7fffffff), static_cast<int>(i >> 31), 0);
    mean.add(walker.walk(samples));
  }
  return {walker.leaves() * mean.mean(), walker.leaves() * mean.error()};
}

}  // namespace limpid
