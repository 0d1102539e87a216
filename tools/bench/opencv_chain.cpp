#include "opencv_chain.h"

#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

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
  cv::Mat along(const glm::dvec3& axis, const RealisticNumbers& numbers) const {
    cv::Mat out;
    cv::addWeighted(x, glm::dot(axis, numbers.ray_dx), y, glm::dot(axis, numbers.ray_dy),
                    glm::dot(axis, numbers.ray), out);
    return out;
  }
  cv::Mat x, y;
};

/// Unit normals by four drifting lookups of the tiling map.
void four_maps(const RealisticNumbers& numbers, const Texture& texture, const Grid& grid,
               const cv::Mat& surface, cv::Mat n[3]) {
  const cv::Mat channels[3] = {mat_of(texture.channels[0]), mat_of(texture.channels[1]),
                               mat_of(texture.channels[2])};
  // remap is much slower where it has to wrap. So positions are wrapped to one period, -0.5 ...
  // 0.5, and looked up from 0.5 on in four copies of the map, which leave room for a drift of
  // another period.
  cv::Mat map, four, sum, sample, at_x, at_y;
  cv::merge(channels, 3, map);
  cv::repeat(map, 2, 2, four);
  const auto in_period = [&](const glm::dvec3& axis) {
    cv::Mat at = surface.mul(grid.along(axis, numbers)), whole;
    at.convertTo(whole, CV_32S);
    cv::subtract(at, whole, at, cv::noArray(), CV_32F);
    return at;
  };
  const cv::Mat base_x = in_period(numbers.map_u), base_y = in_period(numbers.map_v);
  for (const glm::dvec2& at : numbers.map_begin) {
    const glm::dvec2 begin = 0.5 + glm::fract(at - 0.5);
    base_x.convertTo(at_x, -1, map.cols, begin.x * map.cols - 0.5);
    base_y.convertTo(at_y, -1, map.rows, begin.y * map.rows - 0.5);
    cv::remap(four, sample, at_x, at_y, cv::INTER_LINEAR, cv::BORDER_WRAP);
    if (sum.empty()) {
      std::swap(sum, sample);
    } else {
      sum += sample;
    }
  }
  cv::Matx34d blend;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) blend(i, k) = numbers.blend[k][i];
    blend(i, 3) = numbers.blend_begin[i];
  }
  cv::transform(sum, sum, blend);
  cv::split(sum, n);
  cv::Mat length = cv::Mat::zeros(surface.size(), CV_32F);
  for (int i = 0; i < 3; ++i) cv::accumulateSquare(n[i], length);
  cv::sqrt(length, length);
  for (int i = 0; i < 3; ++i) cv::divide(n[i], length, n[i]);
}

}  // namespace

void run_opencv_chain(const RealisticNumbers& numbers, const Frame& frame, const Target& target) {
  const cv::Size size(numbers.size.width, numbers.size.height);
  const auto plane = [&](PlaneId id) { return mat_of(frame.plane(id)); };
  const cv::Mat depth = plane(PlaneId::kDepth), surface = plane(PlaneId::kSurfaceDepth);
  const cv::Mat wet = surface < depth;

  const Grid grid(size);
  cv::Mat n[3];
  four_maps(numbers, frame.wave_map, grid, surface, n);

  // Unit direction to the viewer.
  cv::Mat view[3], square = cv::Mat::zeros(size, CV_32F);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 axis(0);
    axis[i] = -1;
    view[i] = grid.along(axis, numbers);
    cv::accumulateSquare(view[i], square);
  }
  cv::Mat length;
  cv::sqrt(square, length);
  for (cv::Mat& v : view) cv::divide(v, length, v);

  // Refraction with rejection.
  cv::Mat tilt_x = dot(n, numbers.tilt_x), tilt_y = dot(n, numbers.tilt_y);
  cv::Mat at_x, at_y, hit, above;
  cv::scaleAdd(tilt_x, numbers.refract_shift.x, grid.x, at_x);
  cv::scaleAdd(tilt_y, numbers.refract_shift.y, grid.y, at_y);
  hit = sampled(depth, at_x, at_y, cv::INTER_NEAREST);
  cv::compare(hit, surface, above, cv::CMP_LT);
  grid.x.copyTo(at_x, above);
  grid.y.copyTo(at_y, above);
  depth.copyTo(hit, above);

  // Prism.
  cv::Mat prism_x = tilt_x * numbers.prism_shift.x, prism_y = tilt_y * numbers.prism_shift.y;
  prism_x.setTo(0, above);
  prism_y.setTo(0, above);
  cv::Mat half_x, half_y;
  cv::scaleAdd(prism_x, 0.5, at_x, half_x);
  cv::scaleAdd(prism_y, 0.5, at_y, half_y);
  cv::Mat under[3] = {sampled(plane(PlaneId::kColorR), at_x + prism_x, at_y, cv::INTER_LINEAR),
                      sampled(plane(PlaneId::kColorG), half_x, half_y, cv::INTER_LINEAR),
                      sampled(plane(PlaneId::kColorB), at_x, at_y + prism_y, cv::INTER_LINEAR)};

  // Fog, shadow, Fresnel, highlight.
  cv::Mat veil = hit - surface;
  veil.convertTo(veil, -1, numbers.fog_density, -numbers.fog_offset);
  cv::min(cv::max(veil, 0.0), 1.0, veil);
  veil *= numbers.fog_alpha;
  cv::Mat shade = sampled(plane(PlaneId::kShadow), at_x, at_y, cv::INTER_LINEAR);
  const double dark = numbers.shadow_strength;
  shade.convertTo(shade, -1, dark, 1 - dark);
  cv::Mat mirror_x, mirror_y;
  cv::scaleAdd(tilt_x, numbers.mirror_shift.x, grid.x, mirror_x);
  cv::scaleAdd(tilt_y, numbers.mirror_shift.y, grid.y, mirror_y);
  cv::Mat cosine = n[0].mul(view[0]) + n[1].mul(view[1]) + n[2].mul(view[2]);
  cv::Mat fresnel = 1 - cv::abs(cosine);
  cv::max(fresnel, 0.0, fresnel);
  cv::pow(fresnel, numbers.rim_power, fresnel);
  cv::Mat half[3], half_square = cv::Mat::zeros(size, CV_32F), lobe;
  for (int i = 0; i < 3; ++i) {
    half[i] = view[i] + numbers.sun_direction[i];
    cv::accumulateSquare(half[i], half_square);
  }
  cv::sqrt(half_square, half_square);
  lobe = n[0].mul(half[0]) + n[1].mul(half[1]) + n[2].mul(half[2]);
  cv::divide(lobe, half_square, lobe);
  cv::max(lobe, 0.0, lobe);
  cv::pow(lobe, numbers.sun_power, lobe);
  cv::multiply(lobe, plane(PlaneId::kShadow), lobe);

  for (int i = 0; i < 3; ++i) {
    cv::Mat u = under[i] + veil.mul(numbers.fog_color[i] - under[i]);
    cv::multiply(u, shade, u);
    const cv::Mat mirrored =
        sampled(plane(plane_after(PlaneId::kReflectionR, i)), mirror_x, mirror_y, cv::INTER_LINEAR);
    u += fresnel.mul(mirrored - u);
    cv::scaleAdd(lobe, numbers.sun_color[i], u, u);
    cv::Mat out = mat_of(target.color[i]);
    plane(plane_after(PlaneId::kColorR, i)).copyTo(out);
    u.copyTo(out, wet);
  }
}

}  // namespace limpid::bench
