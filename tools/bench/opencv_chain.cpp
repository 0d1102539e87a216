#include "opencv_chain.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "limpid/op/context.h"

namespace limpid::bench {
namespace {

cv::Mat mat_of(const View<const float>& v) {
  return {v.window.height(), v.window.width(), CV_32F, const_cast<float*>(v.data),
          static_cast<std::size_t>(v.y_stride) * sizeof(float)};
}

cv::Mat mat_of(const View<float>& v) { return mat_of(View<const float>(v)); }

cv::Mat dot(const cv::Mat n[3], const glm::dvec3& d) {
  cv::Mat out = n[0] * d.x;
  cv::scaleAdd(n[1], d.y, out, out);
  cv::scaleAdd(n[2], d.z, out, out);
  return out;
}

cv::Mat sampled(const cv::Mat& source, const cv::Mat& x, const cv::Mat& y, int filter) {
  cv::Mat out;
  cv::remap(source, out, x, y, filter, cv::BORDER_REPLICATE);
  return out;
}

/// Pixel coordinates, as planes.
struct Grid {
  explicit Grid(cv::Size size) {
    cv::Mat column(1, size.width, CV_32F), row(size.height, 1, CV_32F);
    for (int i = 0; i < size.width; ++i) column.at<float>(0, i) = static_cast<float>(i);
    for (int i = 0; i < size.height; ++i) row.at<float>(i, 0) = static_cast<float>(i);
    cv::repeat(column, size.height, 1, x);
    cv::repeat(row, 1, size.width, y);
  }
  /// The part along `axis` of the rays through the pixels' centres.
  cv::Mat along(const glm::dvec3& axis, const Rays& rays) const {
    const double dx = glm::dot(axis, rays.ray_dx), dy = glm::dot(axis, rays.ray_dy);
    cv::Mat out;
    cv::addWeighted(x, dx, y, dy, glm::dot(axis, rays.ray) + 0.5 * (dx + dy), out);
    return out;
  }
  cv::Mat x, y;
};

/// Unit normals by four drifting lookups of the tiling map.
void four_maps(const WaveNormals::Params& waves, const Context& c, const Grid& grid,
               const cv::Mat& surface, cv::Mat n[3]) {
  const cv::Mat channels[3] = {mat_of(c.wave_map.channels[0]), mat_of(c.wave_map.channels[1]),
                               mat_of(c.wave_map.channels[2])};
  cv::Mat map, sum, sample, at_x, at_y;
  cv::merge(channels, 3, map);
  const double per_x = map.cols / waves.tile_size, per_y = map.rows / waves.tile_size;
  const cv::Mat base_x = surface.mul(grid.along(c.map_x, c.rays), per_x);
  const cv::Mat base_y = surface.mul(grid.along(c.map_y, c.rays), per_y);
  const double begin_x = std::fmod(glm::dot(c.eye, c.map_x) * per_x, map.cols) - 0.5;
  const double begin_y = std::fmod(glm::dot(c.eye, c.map_y) * per_y, map.rows) - 0.5;
  const double drift = waves.speed * c.time;
  const double drifts[4][2] = {{drift, 0}, {-drift, 0}, {0, drift}, {0, -drift}};
  for (const auto& [x, y] : drifts) {
    cv::add(base_x, begin_x + x * per_x, at_x);
    cv::add(base_y, begin_y + y * per_y, at_y);
    cv::remap(map, sample, at_x, at_y, cv::INTER_LINEAR, cv::BORDER_WRAP);
    if (sum.empty()) {
      std::swap(sum, sample);
    } else {
      sum += sample;
    }
  }
  // up + strength ((sum / 2 - 1) in the axes of the map - up)
  cv::Matx34d blend;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 axes(c.map_x[i], c.map_y[i], c.up[i]);
    for (int k = 0; k < 3; ++k) blend(i, k) = 0.5 * waves.strength * axes[k];
    blend(i, 3) = c.up[i] - waves.strength * (axes.x + axes.y + axes.z + c.up[i]);
  }
  cv::transform(sum, sum, blend);
  cv::split(sum, n);
  cv::Mat length = cv::Mat::zeros(surface.size(), CV_32F);
  for (int i = 0; i < 3; ++i) cv::accumulateSquare(n[i], length);
  cv::sqrt(length, length);
  for (int i = 0; i < 3; ++i) cv::divide(n[i], length, n[i]);
}

}  // namespace

void run_opencv_chain(const Look& look, const Frame& frame, const Scene& scene,
                      const Target& target) {
  const int width = frame.display.width(), height = frame.display.height();
  const cv::Size size(width, height);
  const Context c(scene, frame, look.water.ior, {});
  const auto plane = [&](PlaneId id) { return mat_of(frame.plane(id)); };
  const cv::Mat depth = plane(PlaneId::kDepth), surface = plane(PlaneId::kSurfaceDepth);
  const cv::Mat wet = surface < depth;

  const Grid grid(size);
  cv::Mat n[3];
  four_maps(look.of<WaveNormals>(), c, grid, surface, n);

  // Unit direction to the viewer.
  cv::Mat view[3], square = cv::Mat::zeros(size, CV_32F);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 axis(0);
    axis[i] = -1;
    view[i] = grid.along(axis, c.rays);
    cv::accumulateSquare(view[i], square);
  }
  cv::Mat length;
  cv::sqrt(square, length);
  for (cv::Mat& v : view) cv::divide(v, length, v);

  // Refraction with rejection.
  const auto& refraction = look.of<Refraction>();
  cv::Mat tilt_x = dot(n, c.t), tilt_y = dot(n, -c.b);
  cv::Mat at_x, at_y, hit, above;
  cv::scaleAdd(tilt_x, refraction.strength * width, grid.x, at_x);
  cv::scaleAdd(tilt_y, refraction.strength * height, grid.y, at_y);
  hit = sampled(depth, at_x, at_y, cv::INTER_NEAREST);
  cv::compare(hit, surface, above, cv::CMP_LT);
  grid.x.copyTo(at_x, above);
  grid.y.copyTo(at_y, above);
  depth.copyTo(hit, above);

  // Prism.
  const double prism = look.of<PrismSplit>().strength;
  cv::Mat prism_x = tilt_x * (prism * width), prism_y = tilt_y * (prism * height);
  prism_x.setTo(0, above);
  prism_y.setTo(0, above);
  cv::Mat half_x, half_y;
  cv::scaleAdd(prism_x, 0.5, at_x, half_x);
  cv::scaleAdd(prism_y, 0.5, at_y, half_y);
  cv::Mat under[3] = {sampled(plane(PlaneId::kColorR), at_x + prism_x, at_y, cv::INTER_LINEAR),
                      sampled(plane(PlaneId::kColorG), half_x, half_y, cv::INTER_LINEAR),
                      sampled(plane(PlaneId::kColorB), at_x, at_y + prism_y, cv::INTER_LINEAR)};

  // Fog, shadow, Fresnel, highlight.
  const auto& fog = look.of<DepthFog>();
  cv::Mat veil = hit - surface;
  veil.convertTo(veil, -1, fog.density, -fog.offset);
  cv::min(cv::max(veil, 0.0), 1.0, veil);
  veil *= fog.alpha;
  cv::Mat shade = sampled(plane(PlaneId::kShadow), at_x, at_y, cv::INTER_LINEAR);
  const double dark = look.of<WaterShadow>().strength;
  shade.convertTo(shade, -1, dark, 1 - dark);
  const auto& mirror = look.of<FresnelReflection>();
  cv::Mat mirror_x, mirror_y;
  cv::scaleAdd(tilt_x, mirror.strength * width, grid.x, mirror_x);
  cv::scaleAdd(tilt_y, mirror.strength * height, grid.y, mirror_y);
  cv::Mat cosine = n[0].mul(view[0]) + n[1].mul(view[1]) + n[2].mul(view[2]);
  cv::Mat fresnel = 1 - cv::abs(cosine);
  cv::max(fresnel, 0.0, fresnel);
  cv::pow(fresnel, mirror.power, fresnel);
  cv::Mat half[3], half_square = cv::Mat::zeros(size, CV_32F), lobe;
  for (int i = 0; i < 3; ++i) {
    half[i] = view[i] + c.sun.direction[i];
    cv::accumulateSquare(half[i], half_square);
  }
  cv::sqrt(half_square, half_square);
  lobe = n[0].mul(half[0]) + n[1].mul(half[1]) + n[2].mul(half[2]);
  cv::divide(lobe, half_square, lobe);
  cv::max(lobe, 0.0, lobe);
  const auto& glint = look.of<SunHighlight>();
  cv::pow(lobe, glint.power, lobe);
  cv::multiply(lobe, plane(PlaneId::kShadow), lobe, glint.strength);

  const double tint[3] = {fog.color.r, fog.color.g, fog.color.b};
  const double sun[3] = {c.sun.color.r, c.sun.color.g, c.sun.color.b};
  for (int i = 0; i < 3; ++i) {
    cv::Mat u = under[i] + veil.mul(tint[i] - under[i]);
    cv::multiply(u, shade, u);
    const cv::Mat mirrored =
        sampled(plane(plane_after(PlaneId::kReflectionR, i)), mirror_x, mirror_y, cv::INTER_LINEAR);
    u += fresnel.mul(mirrored - u);
    cv::scaleAdd(lobe, sun[i], u, u);
    cv::Mat out = mat_of(target.color[i]);
    plane(plane_after(PlaneId::kColorR, i)).copyTo(out);
    u.copyTo(out, wet);
  }
}

}  // namespace limpid::bench
