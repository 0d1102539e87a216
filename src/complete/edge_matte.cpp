#include "complete/edge_matte.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace limpid {
namespace {

using Square = std::array<double, 6>;

glm::dvec3 vector_of(const Rgb<double>& c) { return {c.r, c.g, c.b}; }

/// Scatter of the colors around their mean, times the weight.
Square scatter_of(const EdgeMoments& m) {
  Square s = m.square;
  const Square mean = EdgeMoments::products(m.color);
  for (std::size_t i = 0; i < s.size(); ++i) s[i] -= mean[i] / m.weight;
  return s;
}

/// (s + ridge)^-1 b.
glm::dvec3 solved(const Square& s, double ridge, const glm::dvec3& b) {
  const glm::dmat3 matrix{
      {s[0] + ridge, s[1], s[2]}, {s[1], s[3] + ridge, s[4]}, {s[2], s[4], s[5] + ridge}};
  return glm::inverse(matrix) * b;
}

/// Assumed noise of colors, as a share of the contrast.
constexpr double kNoise = 0.01;

/// Assumed error of a share by regression.
constexpr double kCoverError = 0.1;

/// A side of which only a corner is visible does not count.
bool is_side(const EdgeAround& around, EdgeKind kind) {
  double all = 0;
  for (const EdgeMoments& moments : around.kinds) all += moments.weight;
  return around.of(kind).weight > 0.02 * all;
}

}  // namespace

std::optional<Matte> matte_between(const EdgeAround& around) {
  if (!is_side(around, EdgeKind::kSureDry) || !is_side(around, EdgeKind::kSureWet)) {
    return std::nullopt;
  }
  const EdgeMoments &sure_dry = around.of(EdgeKind::kSureDry),
                    &sure_wet = around.of(EdgeKind::kSureWet);
  const Rgb<double> dry = sure_dry.mean(), wet = sure_wet.mean();
  const glm::dvec3 apart = vector_of(dry - wet);
  const double contrast = glm::dot(apart, apart);
  if (!(contrast > 0)) return std::nullopt;
  Square within = scatter_of(sure_dry);
  const Square other = scatter_of(sure_wet);
  const double weight = sure_dry.weight + sure_wet.weight;
  for (std::size_t i = 0; i < within.size(); ++i) within[i] = (within[i] + other[i]) / weight;
  const glm::dvec3 d = solved(within, kNoise * kNoise * contrast, apart);
  const double distance = glm::dot(d, apart);
  if (!(distance > 9)) return std::nullopt;
  const double spread = 1 / std::sqrt(distance);
  const double place = glm::dot(d, -vector_of(wet)) / distance;
  const double cover = std::clamp((place - spread) / (1 - 2 * spread), 0.0, 1.0);
  // The part that neither side explains belongs to both by their shares; a color unlike both would
  // be a third object.
  const Rgb<double> rest = cover * dry + (1 - cover) * wet;
  if (glm::dot(vector_of(rest), vector_of(rest)) > 0.25 * contrast) return std::nullopt;
  return Matte{cover, wet - (1 - cover) * rest};
}

bool looks_wet(const EdgeAround& around, const Rgb<double>& color) {
  const EdgeMoments& wet = around.of(EdgeKind::kSureWet);
  if (!(wet.weight > 0)) return false;
  const glm::dvec3 off = vector_of(wet.mean()), own = vector_of(color);
  const Square texture = scatter_of(wet);
  const double variance = std::max(texture[0] + texture[3] + texture[5], 0.0) / wet.weight;
  return glm::dot(off, off) <= 9 * (variance + kNoise * kNoise * glm::dot(own, own));
}

bool may_regress(const EdgeAround& around) {
  const double dry = around.of(EdgeKind::kSureDry).weight + around.of(EdgeKind::kDry).weight;
  return is_side(around, EdgeKind::kSureWet) && dry > 0;
}

std::optional<Matte> matte_by_regression(const EdgeAround& around) {
  if (!may_regress(around)) return std::nullopt;
  const EdgeMoments dry = around.of(EdgeKind::kSureDry) + around.of(EdgeKind::kDry);
  const EdgeMoments wet = around.of(EdgeKind::kSureWet) + around.of(EdgeKind::kWet);
  const EdgeMoments all = dry + wet;
  const double share = dry.weight / all.weight;
  const glm::dvec3 mean = vector_of(all.mean());
  const glm::dvec3 with = vector_of((1 / all.weight) * dry.color) - share * mean;
  Square spread = scatter_of(all);
  for (double& s : spread) s /= all.weight;
  const double trace = spread[0] + spread[3] + spread[5];
  if (!(trace > 0)) return std::nullopt;
  const glm::dvec3 slope = solved(spread, kNoise * kNoise * trace, with);
  const double explained = glm::dot(slope, with) / (share * (1 - share));
  if (!(explained > 0.25)) return std::nullopt;
  const double cover = std::clamp(share - glm::dot(slope, mean), 0.0, 1.0);
  const EdgeMoments& sure = around.of(EdgeKind::kSureWet);
  const glm::dvec3 object = mean + (1 - share) / glm::dot(slope, with) * with;
  const glm::dvec3 open = vector_of(sure.mean()), apart = object - open;
  // The light that neither side's color explains is texture of the part behind or an error of the
  // share: the part behind gets a share of it by their variances (Wiener 1949, "Extrapolation,
  // Interpolation, and Smoothing of Stationary Time Series").
  const glm::dvec3 rest = -cover * object - (1 - cover) * open;
  const Square texture = scatter_of(sure);
  const double seen = (1 - cover) * (texture[0] + texture[3] + texture[5]) / sure.weight;
  const double error = kCoverError * kCoverError * glm::dot(apart, apart);
  const glm::dvec3 behind = open + seen / std::max((1 - cover) * seen + error, 1e-30) * rest;
  return Matte{cover, {behind.x, behind.y, behind.z}};
}

double EdgePlane::here() const {
  const double x = place[1] / place[0], y = place[2] / place[0], mean = value[0] / place[0];
  const double xx = place[3] - x * place[1], xy = place[4] - x * place[2],
               yy = place[5] - y * place[2];
  const double zx = value[1] - x * value[0], zy = value[2] - y * value[0];
  const double area = xx * yy - xy * xy;
  if (!(area > 1e-6 * xx * yy)) return mean;
  const double right = (zx * yy - zy * xy) / area, down = (zy * xx - zx * xy) / area;
  return std::clamp(mean - right * x - down * y, least, most);
}

EdgeMoments operator+(EdgeMoments a, const EdgeMoments& b) {
  a.weight += b.weight;
  a.alpha += b.alpha;
  a.color = a.color + b.color;
  for (std::size_t i = 0; i < a.square.size(); ++i) a.square[i] += b.square[i];
  return a;
}

}  // namespace limpid
