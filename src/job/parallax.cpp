#include "job/parallax.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// Depths of neighbours that differ by more than this share are of different objects.
constexpr double kSameObject = 0.05;

void expect_above(const WaterView& view, const char* frame) {
  if (view.eye_above > 0 && !view.submersible) return;
  throw Error("motion vectors from two frames: the camera of " + std::string(frame) + " is " +
              std::to_string(view.eye_above) +
              " above the calm water, expected a camera wholly above the water");
}

/// 1 / depth at a place: bilinear, which is exact for planes, within an object; else the texel's.
double depth_at(const View<const float>& depth, const Place& place) {
  const Rect& w = depth.window;
  const auto texel = [&](int x, int y) {
    return 1.0 / depth.at(std::clamp(x, w.x0, w.x1 - 1), std::clamp(y, w.y0, w.y1 - 1));
  };
  const double x = std::clamp<double>(place.x, w.x0, w.x1) - 0.5;
  const double y = std::clamp<double>(place.y, w.y0, w.y1) - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double corners[] = {texel(x0, y0), texel(x0 + 1, y0), texel(x0, y0 + 1),
                            texel(x0 + 1, y0 + 1)};
  const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
  if (!(*most - *least <= kSameObject * *most)) {
    return 1 / texel(static_cast<int>(std::floor(x + 0.5)), static_cast<int>(std::floor(y + 0.5)));
  }
  const double right = x - x0, below = y - y0;
  return 1 / ((1 - below) * ((1 - right) * corners[0] + right * corners[1]) +
              below * ((1 - right) * corners[2] + right * corners[3]));
}

/// Where a view sees a point below its calm water, which lies relative to the view's eye.
std::optional<Place> through_calm(const Screen& screen, const glm::dvec3& point, double ior) {
  const WaterView& view = screen.view();
  const double rise = glm::dot(view.up, point), down = -(view.eye_above + rise);
  if (!(down > 0)) return screen.place_of(point);
  if (view.w_depth == 0) {  // orthographic: all rays are refracted alike
    const glm::dvec3 ray = glm::normalize(view.forward);
    const glm::dvec3 bent = glm::refract(ray, view.up, 1 / ior);
    return screen.place_of(point - down / -glm::dot(bent, view.up) * bent);
  }
  const glm::dvec3 along = point - rise * view.up;
  const double across = glm::length(along);
  const double reach = refracted_reach(view.eye_above, down, across, ior);
  const glm::dvec3 flat = across > 0 ? reach / across * along : glm::dvec3(0);
  return screen.place_of(flat - view.eye_above * view.up);
}

void put(const std::optional<Place>& motion, int x, int y, View<float>& to_x, View<float>& to_y) {
  to_x.at(x, y) = static_cast<float>(motion ? motion->x : 0);
  to_y.at(x, y) = static_cast<float>(motion ? -motion->y : 0);
}

}  // namespace

double refracted_reach(double up, double down, double across, double ior) {
  // sin(in the air) - ior sin(in the water) grows with the reach from below 0 to above 0.
  double low = 0, high = across, reach = across * up / (up + down / ior);
  for (int step = 0; step < 60; ++step) {
    const double rest = across - reach;
    const double air = std::hypot(up, reach), water = std::hypot(down, rest);
    if (!(water > 0)) return reach;
    const double off = reach / air - ior * rest / water;
    (off > 0 ? high : low) = reach;
    const double slope = up * up / (air * air * air) + ior * down * down / (water * water * water);
    double next = reach - off / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - reach) <= 1e-14 * across) return next;
    reach = next;
  }
  return reach;
}

Parallax::Parallax(const WaterView& now, const WaterView& second, double ior)
    : now_(now), second_(second), shift_(now.eye - second.eye), ior_(ior) {
  expect_above(now, "this frame");
  expect_above(second, "the second frame");
}

std::optional<Place> Parallax::motion(const std::optional<Place>& from,
                                      const std::optional<Place>& to) const {
  if (!from || !to) return {};
  return Place{to->x - from->x, to->y - from->y};
}

std::optional<Place> Parallax::of_point(const glm::dvec3& point, bool through_water) const {
  const glm::dvec3 then = point + shift_;
  if (!through_water) return motion(now_.place_of(point), second_.place_of(then));
  return motion(through_calm(now_, point, ior_), through_calm(second_, then, ior_));
}

void Parallax::seen(const LookedUp& looked_up, View<const float> depth, View<float> to_x,
                    View<float> to_y) const {
  const Rect &window = to_x.window, &display = looked_up.display;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const bool wet = std::isfinite(looked_up.surface_depth.at(x, y));
      const Place place =
          wet ? Place{display.x0 + looked_up.u.at(x, y) * static_cast<double>(display.width()),
                      display.y0 +
                          (1 - looked_up.v.at(x, y)) * static_cast<double>(display.height())}
              : Place{x + 0.5, y + 0.5};
      const double far = depth_at(depth, place);
      if (far < HUGE_VAL) {
        put(of_point(now_.point_at(place, far), wet), x, y, to_x, to_y);
      } else {
        const glm::dvec3 ray = now_.ray_at(place);
        put(motion(now_.place_of_direction(ray), second_.place_of_direction(ray)), x, y, to_x,
            to_y);
      }
    }
  }
}

std::optional<Place> Parallax::of_image(const Mirrored& mirrored, int x, int y) const {
  const double surface = mirrored.surface_depth.at(x, y);
  const double image = mirrored.reflection_depth.at(x, y);
  if (!(surface < image) || !std::isfinite(surface)) return {};
  const Place here{x + 0.5, y + 0.5};
  const glm::dvec3 ray = now_.ray_at(here), start = now_.point_at(here, surface);
  const glm::dvec3 normal(mirrored.normal_x.at(x, y), mirrored.normal_y.at(x, y),
                          mirrored.normal_z.at(x, y));
  const auto across = [](const glm::dvec3& v, const glm::dvec3& n) {
    return v - 2 * glm::dot(n, v) * n;
  };
  const WaterView &now = now_.view(), &second = second_.view();
  const glm::dvec3 bounced = across(ray, normal);
  if (image == HUGE_VAL) {
    return motion(now_.place_of_direction(across(bounced, now.up)),
                  second_.place_of_direction(across(bounced, second.up)));
  }
  const glm::dvec3 thing = start + (image - surface) * bounced;
  // The image in the calm plane of a view, which lies at -eye_above along its normal.
  const auto image_in = [&](const WaterView& view, const glm::dvec3& point) {
    return across(point, view.up) - 2 * view.eye_above * view.up;
  };
  return motion(now_.place_of(image_in(now, thing)),
                second_.place_of(image_in(second, thing + shift_)));
}

void Parallax::reflected(const Mirrored& mirrored, View<float> to_x, View<float> to_y) const {
  const Rect& window = to_x.window;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) put(of_image(mirrored, x, y), x, y, to_x, to_y);
  }
}

}  // namespace limpid
