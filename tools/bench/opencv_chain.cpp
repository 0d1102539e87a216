#include "opencv_chain.h"

#include <cmath>

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

}  // namespace

void run_opencv_chain(const Look& look, const Frame& frame, const Scene& scene,
                      const Target& target) {
  const int width = frame.display.width(), height = frame.display.height();
  const cv::Size size(width, height);
  const Context c(scene, frame, look.water.ior, {});
  const auto plane = [&](PlaneId id) { return mat_of(frame.plane(id)); };
  const cv::Mat n[3] = {plane(PlaneId::kSurfaceNormalX), plane(PlaneId::kSurfaceNormalY),
                        plane(PlaneId::kSurfaceNormalZ)};
  const cv::Mat depth = plane(PlaneId::kDepth), surface = plane(PlaneId::kSurfaceDepth);
  const cv::Mat wet = surface < depth;

  // Pixel grid and unit direction to the viewer.
  cv::Mat column(1, width, CV_32F), row(height, 1, CV_32F), grid_x, grid_y;
  for (int x = 0; x < width; ++x) column.at<float>(0, x) = static_cast<float>(x);
  for (int y = 0; y < height; ++y) row.at<float>(y, 0) = static_cast<float>(y);
  cv::repeat(column, height, 1, grid_x);
  cv::repeat(row, 1, width, grid_y);
  cv::Mat view[3], square = cv::Mat::zeros(size, CV_32F);
  for (int i = 0; i < 3; ++i) {
    const double base = c.rays.ray[i] + 0.5 * (c.rays.ray_dx[i] + c.rays.ray_dy[i]);
    cv::addWeighted(grid_x, -c.rays.ray_dx[i], grid_y, -c.rays.ray_dy[i], -base, view[i]);
    cv::accumulateSquare(view[i], square);
  }
  cv::Mat length;
  cv::sqrt(square, length);
  for (cv::Mat& v : view) cv::divide(v, length, v);

  // Refraction with rejection.
  const auto& refraction = look.of<Refraction>();
  cv::Mat tilt_x = dot(n, c.t), tilt_y = dot(n, -c.b), shift_x, shift_y;
  cv::Mat at_x, at_y, hit, above;
  cv::scaleAdd(tilt_x, refraction.strength * width, grid_x, at_x);
  cv::scaleAdd(tilt_y, refraction.strength * height, grid_y, at_y);
  hit = sampled(depth, at_x, at_y, cv::INTER_NEAREST);
  cv::compare(hit, surface, above, cv::CMP_LT);
  grid_x.copyTo(at_x, above);
  grid_y.copyTo(at_y, above);
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
  cv::scaleAdd(tilt_x, mirror.strength * width, grid_x, mirror_x);
  cv::scaleAdd(tilt_y, mirror.strength * height, grid_y, mirror_y);
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
