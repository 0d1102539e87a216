#include "limpid/core/frame.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();

constexpr Role kRoles[] = {
    {"color", PlaneId::kColorR, 4, 0, Sanitise::kColor, "color", "R G B A|R G B", Storage::kHalf,
     "the dry picture: scene-linear, premultiplied"},
    {"depth", PlaneId::kDepth, 1, kNoHit, Sanitise::kDepth, "depth", "Z", Storage::kFloat,
     "depth of the dry scene"},
    {"shadow", PlaneId::kShadow, 1, 1, Sanitise::kShadow, "shadow", "Y", Storage::kHalf,
     "visibility of the sun: 1 lit, 0 in shadow"},
    {"reflection", PlaneId::kReflectionR, 3, 0, Sanitise::kColor, "reflection", "R G B",
     Storage::kHalf, "the picture of a flat mirror in the water plane"},
    {"surface_depth", PlaneId::kSurfaceDepth, 1, kNoHit, Sanitise::kDepth, "surface", "Z",
     Storage::kFloat, "depth of the water surface"},
    {"surface_normal", PlaneId::kSurfaceNormalX, 3, 0, Sanitise::kNormal, "surface", "NX NY NZ",
     Storage::kHalf, "world normal of the water surface"},
    {"reflection_valid", PlaneId::kReflectionValid, 1, 0, Sanitise::kMask, "reflection", "A",
     Storage::kHalf, "1 where the reflection is valid, 0 inside of clipped objects"},
    {"reflection_depth", PlaneId::kReflectionDepth, 1, kNoHit, Sanitise::kDepth, "reflection", "Z",
     Storage::kFloat, "depth of the reflection along the mirrored ray"},
    {"below_color", PlaneId::kBelowR, 3, 0, Sanitise::kColor, "below", "R G B", Storage::kHalf,
     "the dry scene without the objects above the water"},
    {"below_depth", PlaneId::kBelowDepth, 1, kNoHit, Sanitise::kDepth, "below", "Z",
     Storage::kFloat, "depth of below_color"},
    {"surface_shadow", PlaneId::kSurfaceShadow, 1, 1, Sanitise::kShadow, "surface_shadow", "Y",
     Storage::kHalf, "visibility of the sun at the water surface"},
    {"sky", PlaneId::kSkyR, 3, 0, Sanitise::kColor, "", "", Storage::kHalf,
     "the sky without the objects in front of it"},
    {"albedo", PlaneId::kAlbedoR, 3, 0, Sanitise::kColor, "", "", Storage::kHalf,
     "albedo of the bottom around each pixel"},
    {"sun_color", PlaneId::kSunColorR, 3, 0, Sanitise::kColor, "sun_color", "R G B", Storage::kHalf,
     "direct sunlight in the dry picture: 0 in shadow"},
    {"basin", PlaneId::kBasin, 1, 1, Sanitise::kMask, "", "", Storage::kHalf,
     "albedo of an endless floor as bright, over that of the bottom: below 1 by walls and in "
     "shade"},
};

}  // namespace

std::span<const Role> roles() { return kRoles; }

const Role& role_named(std::string_view name) {
  std::vector<std::string> known;
  for (const Role& role : kRoles) {
    if (role.name == name) return role;
    known.emplace_back(role.name);
  }
  throw Error("'" + std::string(name) + "' is not a buffer of a frame: expected one of " +
              join(known) + did_you_mean(name, known));
}

std::string roles_text(PlaneSet planes) {
  std::vector<std::string> names;
  for (const Role& role : kRoles) {
    if (!(planes & role.planes()).empty()) names.emplace_back(role.name);
  }
  return names.empty() ? "-" : join(names);
}

std::string channel_name(const Role& role, int i) {
  std::istringstream written(std::string(role.channels.substr(0, role.channels.find('|'))));
  std::string channel;
  for (int k = 0; k <= i; ++k) written >> channel;
  return role.layer.empty() ? "" : std::string(role.layer) + "." + channel;
}

PlaneSet Frame::present() const {
  PlaneSet set;
  for (int i = 0; i < kPlaneCount; ++i) {
    if (planes[i]) set = set | PlaneSet{static_cast<PlaneId>(i)};
  }
  return set;
}

Rect Frame::work() const {
  const Rect& color = plane(PlaneId::kColorR).window;
  const Rect picture = intersection(display, color);
  if (overscan == 0) return picture;
  Rect all{display.x0 - overscan, display.y0 - overscan, display.x1 + overscan,
           display.y1 + overscan};
  for (const View<const float>& view : planes) {
    if (view) all = intersection(all, view.window);
  }
  return all.contains(picture) ? all : picture;
}

void Texture::validate(const std::string& name) const {
  const Rect& window = channels[0].window;
  for (const View<const float>& channel : channels) {
    if (!channel || window.empty() || channel.window != window) {
      throw Error(name + ": expected three channels of one size");
    }
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        if (!std::isfinite(channel.at(x, y))) {
          throw Error(name + ": NaN or infinity at (" + std::to_string(x) + ", " +
                      std::to_string(y) + ")");
        }
      }
    }
  }
}

void Frame::validate() const {
  const auto text = [](const Rect& r) {
    return "(" + std::to_string(r.x0) + ", " + std::to_string(r.y0) + ") - (" +
           std::to_string(r.x1) + ", " + std::to_string(r.y1) + ")";
  };
  if (display.empty()) throw Error("frame: the display window is empty, expected at least 1x1");
  if (!present().covers(kColorPlanes)) throw Error("frame: no color planes");
  if (work().empty()) {
    throw Error("frame: no pixel of color lies in the display window " + text(display));
  }
  for (const Role& role : kRoles) {
    for (int i = 0; i < role.count; ++i) {
      const View<const float>& view = plane(plane_after(role.first, i));
      if (view && !view.window.contains(work())) {
        throw Error("frame: " + std::string(role.name) + " covers the pixels " + text(view.window) +
                    ", expected all of " + text(work()));
      }
    }
  }
}

}  // namespace limpid
