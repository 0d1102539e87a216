#include "demo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace {

using glm::dvec3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFloor = -0.9, kRim = 0.3, kHalfWidth = 2.5, kBack = -6, kRadius = 0.45;

struct Hit {
  double z = kInfinity;  ///< eye depth
  dvec3 normal, color{0.55, 0.75, 1};
};

/// Tiles 0.5 wide with grout between them. The tiles are blue: with red and blue swapped they would
/// be orange.
dvec3 tiles(double u, double v) {
  const double a = u / 0.5 - std::floor(u / 0.5), b = v / 0.5 - std::floor(v / 0.5);
  if (a < 0.06 || b < 0.06) return {0.75, 0.75, 0.7};
  const bool odd =
      (static_cast<int>(std::floor(u / 0.5)) + static_cast<int>(std::floor(v / 0.5))) & 1;
  return odd ? dvec3(0.12, 0.35, 0.55) : dvec3(0.2, 0.5, 0.65);
}

double ball_z(dvec3 eye, dvec3 ray, dvec3 ball) {
  const double a = dot(ray, ray), b = dot(ray, ball - eye);
  const double square = b * b - a * (dot(ball - eye, ball - eye) - kRadius * kRadius);
  const double z = square < 0 ? kInfinity : (b - std::sqrt(square)) / a;
  return z > 1e-6 ? z : kInfinity;
}

/// The first surface on the ray; eye + z ray lies at eye depth z.
Hit trace(dvec3 eye, dvec3 ray, dvec3 ball) {
  Hit hit;
  const auto wall = [&](int axis, double place, dvec3 normal) {
    const double z = (place - eye[axis]) / ray[axis];
    const dvec3 at = eye + z * ray;
    const bool inside = at.y > kFloor - 1e-9 && at.y < kRim && std::abs(at.x) < kHalfWidth + 1e-9 &&
                        at.z > kBack - 1e-9;
    if (z <= 0 || z >= hit.z || !inside) return;
    hit = {z, normal,
           axis == 1 ? tiles(at.x, at.z) : tiles(axis == 0 ? at.z : at.x, at.y - kFloor)};
  };
  wall(1, kFloor, {0, 1, 0});
  wall(0, -kHalfWidth, {1, 0, 0});
  wall(0, kHalfWidth, {-1, 0, 0});
  wall(2, kBack, {0, 0, 1});
  // Stone around the basin, so that only the basin holds water.
  const double stone = (kRim - eye.y) / ray.y;
  const dvec3 at = eye + stone * ray;
  const bool beside = std::abs(at.x) > kHalfWidth || at.z < kBack;
  if (stone > 0 && stone < hit.z && beside) hit = {stone, {0, 1, 0}, {0.6, 0.55, 0.48}};
  const double z = ball_z(eye, ray, ball);
  if (z < hit.z) {
    const dvec3 normal = (eye + z * ray - ball) / kRadius;
    hit = {z, normal, std::abs(normal.y) < 0.2 ? dvec3(0.9) : dvec3(0.8, 0.12, 0.06)};
  }
  return hit;
}

dvec3 light(dvec3 eye, dvec3 ray, const Hit& hit, dvec3 ball) {
  if (hit.z == kInfinity) return hit.color;
  const dvec3 sun = normalize(dvec3(0.5, 1, 0.35)), at = eye + hit.z * ray + 1e-6 * hit.normal;
  const bool lit = ball_z(at, sun, ball) == kInfinity;
  return hit.color * (0.3 + (lit ? 0.8 * std::max(0.0, dot(hit.normal, sun)) : 0.0));
}

double srgb(double linear) {
  const double v = std::min(linear, 1.0);
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

}  // namespace

std::string depth_path(const std::string& pattern, int frame) {
  const std::size_t first = pattern.find('#');
  if (first == std::string::npos) return pattern;
  const std::size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
  const std::string number = cv::format("%0*d", static_cast<int>(end - first), frame);
  return pattern.substr(0, first) + number + pattern.substr(end);
}

void make_demo(const std::string& video, const std::string& depth, const limpid::Camera& camera,
               cv::Size size, int frames, double per_second) {
  const limpid::Rays rays = rays_of(camera, {size.width, size.height});
  cv::VideoWriter writer(video, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         per_second, size);
  if (!writer.isOpened()) throw std::runtime_error(video + ": cannot be written");
  for (int i = 0; i < frames; ++i) {
    const double turn = 6.283 * i / frames;
    const dvec3 eye = camera.eye(), ball(std::sin(turn), 0.5 * std::cos(2 * turn), -3.2);
    cv::Mat3b picture(size);
    cv::Mat1f eye_depth(size);
    picture.forEach([&](cv::Vec3b& pixel, const int* place) {
      const double x = place[1], y = place[0];
      dvec3 sum(0);
      for (const double dy : {0.25, 0.75}) {
        for (const double dx : {0.25, 0.75}) {
          const dvec3 ray = rays.ray_at(x + dx, y + dy);
          sum += light(eye, ray, trace(eye, ray, ball), ball);
        }
      }
      for (int c = 0; c < 3; ++c) pixel[2 - c] = cv::saturate_cast<uchar>(srgb(sum[c] / 4));
      eye_depth(place) = static_cast<float>(trace(eye, rays.ray_at(x + 0.5, y + 0.5), ball).z);
    });
    writer.write(picture);
    if (!cv::imwrite(depth_path(depth, i), eye_depth)) {
      throw std::runtime_error(depth_path(depth, i) + ": cannot be written");
    }
  }
}
