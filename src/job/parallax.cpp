#include "job/parallax.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

#include "complete/rows.h"

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

glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& n) { return v - 2 * glm::dot(n, v) * n; }

/// The image of a point in the calm plane of a view, which lies at -eye_above along its normal.
glm::dvec3 calm_image(const WaterView& view, const glm::dvec3& point) {
  return across(point, view.up) - 2 * view.eye_above * view.up;
}

std::optional<Place> difference(const std::optional<Place>& to, const std::optional<Place>& from) {
  if (!from || !to) return {};
  return Place{to->x - from->x, to->y - from->y};
}

/// A frame with its waves.
struct Wavy {
  const Screen& screen;
  const WaterSurface& surface;

  /// The point of the surface at a place, and its normal there: bilinear. None beyond its window,
  /// and where a pixel around has no water.
  struct Hit {
    glm::dvec3 point, normal, ray;
  };
  std::optional<Hit> hit(const Place& place) const {
    const Rect& w = surface.depth.window;
    const double x = place.x - 0.5, y = place.y - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    if (!(left >= w.x0 && top >= w.y0 && left < w.x1 && top < w.y1)) return {};
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    const double right = x - left, below = y - top;
    double nearness = 0;  // 1 / depth is linear over a plane
    glm::dvec3 normal(0);
    for (const int row : {0, 1}) {
      for (const int column : {0, 1}) {
        const double share = (row ? below : 1 - below) * (column ? right : 1 - right);
        if (share == 0) continue;
        const int at_x = x0 + column, at_y = y0 + row;
        if (at_x >= w.x1 || at_y >= w.y1) return {};
        const double depth = surface.depth.at(at_x, at_y);
        if (!std::isfinite(depth)) return {};
        nearness += share / depth;
        normal +=
            share * glm::dvec3(surface.normal_x.at(at_x, at_y), surface.normal_y.at(at_x, at_y),
                               surface.normal_z.at(at_x, at_y));
      }
    }
    const double length = glm::length(normal);
    if (!(length > 0)) return {};
    const Hit found{screen.point_at(place, 1 / nearness), normal / length,
                    glm::normalize(screen.ray_at(place))};
    if (!(glm::dot(found.ray, found.normal) < 0)) return {};
    return found;
  }

  /// The distance on the screen at which the refracted ray of a place passes a point below the
  /// water.
  std::optional<Place> refracted_off(const Place& place, const glm::dvec3& point,
                                     double ior) const {
    const auto at = hit(place);
    if (!at) return {};
    const glm::dvec3& up = screen.view().up;
    const glm::dvec3 bent = glm::refract(at->ray, at->normal, 1 / ior);
    const double down = glm::dot(up, bent);
    if (!(down < 0)) return {};
    const double distance = glm::dot(up, point - at->point) / down;
    return difference(screen.place_of(at->point + distance * bent), screen.place_of(point));
  }
  /// The same for the mirrored ray, by the images in calm water.
  std::optional<Place> mirrored_off(const Place& place, const glm::dvec3& point) const {
    const auto at = hit(place);
    if (!at) return {};
    const glm::dvec3 bounced = across(at->ray, at->normal);
    const double distance = glm::dot(bounced, point - at->point);
    const WaterView& view = screen.view();
    return difference(screen.place_of(calm_image(view, at->point + distance * bounced)),
                      screen.place_of(calm_image(view, point)));
  }
  /// The same for a direction, infinitely far away.
  std::optional<Place> mirrored_off_sky(const Place& place, const glm::dvec3& direction) const {
    const auto at = hit(place);
    if (!at) return {};
    const glm::dvec3& up = screen.view().up;
    return difference(screen.place_of_direction(across(across(at->ray, at->normal), up)),
                      screen.place_of_direction(across(direction, up)));
  }
};

/// A place with off(place) = `wanted`, by Broyden's method from `begin` on; none if the method does
/// not converge.
template <class Off>
std::optional<Place> place_with(const Off& off, const Place& wanted, const Place& begin) {
  constexpr double kNear = 1e-3;   // pixels
  constexpr double kLongest = 16;  // of a step, in pixels
  const auto rest = [&](const glm::dvec2& place) -> std::optional<glm::dvec2> {
    const auto found = off(Place{place.x, place.y});
    if (!found) return {};
    return glm::dvec2(found->x - wanted.x, found->y - wanted.y);
  };
  glm::dvec2 place(begin.x, begin.y);
  auto is = rest(place);
  if (!is) return {};
  if (glm::length(*is) <= kNear) return begin;
  const auto right = rest(place + glm::dvec2(1, 0)), below = rest(place + glm::dvec2(0, 1));
  if (!right || !below) return {};
  glm::dmat2 slopes(*right - *is, *below - *is);
  for (int step = 0; step < Parallax::kSteps; ++step) {
    const double folds = glm::determinant(slopes);
    if (!(std::abs(folds) > 1e-6)) return {};
    glm::dvec2 move = -(glm::inverse(slopes) * *is);
    const double length = glm::length(move);
    if (length > kLongest) move *= kLongest / length;
    auto then = rest(place + move);
    for (int half = 0; half < 3 && !(then && glm::length(*then) < glm::length(*is)); ++half) {
      move *= 0.5;
      then = rest(place + move);
    }
    if (!then || !(glm::length(*then) < glm::length(*is))) return {};
    slopes += glm::outerProduct(*then - *is - slopes * move, move) / glm::dot(move, move);
    place += move;
    is = then;
    if (glm::length(*is) <= kNear) return Place{place.x, place.y};
  }
  return {};
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

Parallax::Parallax(const WaterView& now, const WaterView& second, double ior,
                   const std::optional<Waves>& waves)
    : now_(now), second_(second), waves_(waves), shift_(now.eye - second.eye), ior_(ior) {
  expect_above(now, "this frame");
  expect_above(second, "the second frame");
}

template <class Off>
std::optional<Place> Parallax::with_waves(const std::optional<Place>& calm, const Place& here,
                                          const Off& off) const {
  if (!waves_ || !calm) return calm;
  const auto wanted = off(Wavy{now_, waves_->now}, here, glm::dvec3(0));
  if (!wanted) return calm;
  const Wavy then{second_, waves_->second};
  const auto found = place_with([&](const Place& place) { return off(then, place, shift_); },
                                *wanted, {here.x + calm->x, here.y + calm->y});
  return found ? difference(found, here) : calm;
}

std::optional<Place> Parallax::of_point(const glm::dvec3& point, int x, int y,
                                        bool through_water) const {
  const glm::dvec3 then = point + shift_;
  if (!through_water) return difference(second_.place_of(then), now_.place_of(point));
  const auto calm = difference(through_calm(second_, then, ior_), through_calm(now_, point, ior_));
  const WaterView& view = now_.view();
  if (!(view.eye_above + glm::dot(view.up, point) < 0)) return calm;  // above the water
  return with_waves(calm, {x + 0.5, y + 0.5},
                    [&](const Wavy& wavy, const Place& place, const glm::dvec3& shift) {
                      return wavy.refracted_off(place, point + shift, ior_);
                    });
}

void Parallax::seen(const LookedUp& looked_up, View<const float> depth, View<float> to_x,
                    View<float> to_y, Executor& executor) const {
  const Rect &window = to_x.window, &display = looked_up.display;
  each_row(executor, window, [&](int y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const bool wet = std::isfinite(looked_up.surface_depth.at(x, y));
      const Place place =
          wet ? Place{display.x0 + looked_up.u.at(x, y) * static_cast<double>(display.width()),
                      display.y0 +
                          (1 - looked_up.v.at(x, y)) * static_cast<double>(display.height())}
              : Place{x + 0.5, y + 0.5};
      const double far = depth_at(depth, place);
      if (far < HUGE_VAL) {
        put(of_point(now_.point_at(place, far), x, y, wet), x, y, to_x, to_y);
      } else {
        const glm::dvec3 ray = now_.ray_at(place);
        put(difference(second_.place_of_direction(ray), now_.place_of_direction(ray)), x, y, to_x,
            to_y);
      }
    }
  });
}

std::optional<Place> Parallax::of_image(const Mirrored& mirrored, int x, int y) const {
  const double surface = mirrored.surface_depth.at(x, y);
  const double image = mirrored.reflection_depth.at(x, y);
  if (!(surface < image) || !std::isfinite(surface)) return {};
  const Place here{x + 0.5, y + 0.5};
  const glm::dvec3 ray = now_.ray_at(here), start = now_.point_at(here, surface);
  const glm::dvec3 normal(mirrored.normal_x.at(x, y), mirrored.normal_y.at(x, y),
                          mirrored.normal_z.at(x, y));
  const WaterView &now = now_.view(), &second = second_.view();
  const glm::dvec3 bounced = across(ray, normal);
  if (image == HUGE_VAL) {
    const auto calm = difference(second_.place_of_direction(across(bounced, second.up)),
                                 now_.place_of_direction(across(bounced, now.up)));
    return with_waves(calm, here, [&](const Wavy& wavy, const Place& place, const glm::dvec3&) {
      return wavy.mirrored_off_sky(place, bounced);
    });
  }
  const glm::dvec3 thing = start + (image - surface) * bounced;
  const auto calm = difference(second_.place_of(calm_image(second, thing + shift_)),
                               now_.place_of(calm_image(now, thing)));
  return with_waves(calm, here, [&](const Wavy& wavy, const Place& place, const glm::dvec3& shift) {
    return wavy.mirrored_off(place, thing + shift);
  });
}

void Parallax::reflected(const Mirrored& mirrored, View<float> to_x, View<float> to_y,
                         Executor& executor) const {
  const Rect& window = to_x.window;
  each_row(executor, window, [&](int y) {
    for (int x = window.x0; x < window.x1; ++x) put(of_image(mirrored, x, y), x, y, to_x, to_y);
  });
}

}  // namespace limpid
