#include "job/picture_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

#include "complete/caustics.h"
#include "complete/row_heights.h"
#include "complete/sky.h"
#include "core/toml_text.h"
#include "op/raised_water.h"
#include "optics/refract.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

/// Counts of the sampled pixels.
struct Found {
  bool wet = false, dry = false, in_water = false;
  bool both() const { return wet && dry; }
};

/// Samples every `step`-th pixel of every `step`-th row, until both kinds are found.
Found look_at(const Frame& frame, const Pass& pass, int step) {
  Found found;
  RaisedWater<double> raised;
  raised.make(pass);
  const auto water_at = [&](const RowRays<double>& rays, double x) {
    if (!pass.raised) return rays.calm_depth(x);
    return RaisedRay<double, double>(pass, raised, rays, x).first_meeting();
  };
  const Rect work = frame.work();
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  for (int y = work.y0; y < work.y1 && !found.both(); y += step) {
    const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
    for (int x = work.x0; x < work.x1 && !found.both(); x += step) {
      const double pixel_x = x - pass.corner.x + 0.5;
      const double water = surface ? surface.at(x, y) : water_at(rays, pixel_x);
      const bool in_water = begins_in_water(pass, rays, pixel_x) > 0;
      const bool wet = in_water || water < depth.at(x, y);
      found.wet |= wet;
      found.dry |= !wet;
      found.in_water |= in_water;
    }
  }
  return found;
}

constexpr int kCoarse = 16;

std::string glass_text(double share, const std::string& what) {
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.1f %%", 100 * share);
  return std::string(percent) + " of " + what +
         " transparent, such as glass or a wide blur, and count as opaque at their depth: there is "
         "no water behind them";
}

/// Whether there are pixels of both kinds, as a meaningful picture has.
bool warn_of_wet(const Frame& frame, const Pass& pass, std::vector<std::string>& warnings) {
  if (look_at(frame, pass, kCoarse).both()) return true;
  const Found found = look_at(frame, pass, 1);
  const std::string expected =
      "; if this is not intended, check height and up of the water, camera and kind of depth";
  if (!found.wet) warnings.push_back("no pixel is wet, the output is the dry picture" + expected);
  if (!found.dry && !found.in_water) {
    warnings.push_back("every pixel is wet, no object is in front of the water" + expected);
  }
  return found.wet && (found.dry || found.in_water);
}

void warn_of_depth(const Frame& frame, std::vector<std::string>& warnings) {
  const Rect work = frame.work();
  float least = HUGE_VALF, most = 0;
  int seen = 0;
  const int step = std::clamp(std::min(work.width(), work.height()) / 8, 1, kCoarse);
  for (int y = work.y0; y < work.y1; y += step) {
    for (int x = work.x0; x < work.x1; x += step) {
      const float depth = frame.plane(PlaneId::kDepth).at(x, y);
      if (!(depth < HUGE_VALF)) continue;
      least = std::min(least, depth);
      most = std::max(most, depth);
      ++seen;
    }
  }
  constexpr int kEnough = 16;
  if (seen < kEnough) return;
  const std::string range = " in " + toml_text(least) + " ... " + toml_text(most);
  if (most <= 1) {
    warnings.push_back("the depth lies" + range +
                       " everywhere, like a mist pass or a normalised depth; expected distances in "
                       "scene units, or the right --depth-kind");
  } else if (most - least < 1e-4f * most) {
    warnings.push_back("the depth is nearly the same everywhere," + range +
                       "; if this is not intended, check the depth layer");
  }
}

/// Glass: pixels with a depth and partial alpha whose neighbours all are like them. Edges are like
/// that, too, but narrow.
void warn_of_glass(const Frame& frame, std::vector<std::string>& warnings) {
  const View<const float>& alpha = frame.plane(PlaneId::kColorA);
  if (!alpha || frame.foreground[3]) return;
  const Rect w = frame.work();
  const auto clear = [&](int x, int y) {
    const float a = alpha.at(x, y);
    return a > 0.02f && a < 0.98f && frame.plane(PlaneId::kDepth).at(x, y) < HUGE_VALF;
  };
  const int step = std::clamp(std::min(w.width(), w.height()) / 64, 1, kCoarse);
  std::int64_t seen = 0, found = 0;
  for (int y = w.y0 + 1; y < w.y1 - 1; y += step) {
    for (int x = w.x0 + 1; x < w.x1 - 1; x += step, ++seen) {
      bool all = true;
      for (int k = 0; all && k < 9; ++k) all = clear(x + k % 3 - 1, y + k / 3 - 1);
      found += all;
    }
  }
  if (found > 0) warnings.push_back(glass_text(double(found) / double(seen), "the pixels are"));
}

/// Checks the place where a mirror shows the sun, which is infinitely far away.
void warn_of_sun(const Plan& plan, const Frame& frame, const Pass& c,
                 std::vector<std::string>& warnings) {
  const View<const float>& red = frame.plane(PlaneId::kReflectionR);
  const bool read = plan.planes.covers(kReflectionPlanes) && plan.needs_sun && red;
  const glm::dvec3 image = c.sun.direction - 2 * glm::dot(c.sun.direction, c.up) * c.up;
  const double w = c.w_depth * glm::dot(c.forward, image);
  if (!read || !(w > 0)) return;
  const double x = glm::dot(c.to_u, image) / w * c.size.x + c.corner.x;
  const double y = glm::dot(c.to_v, image) / w * c.size.y + c.corner.y;
  constexpr int kAround = 4;
  const Rect& window = red.window;
  if (!(x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1)) return;
  const Rect near = intersection({static_cast<int>(x) - kAround, static_cast<int>(y) - kAround,
                                  static_cast<int>(x) + kAround, static_cast<int>(y) + kAround},
                                 window);
  float brightest = 0;
  for (int row = near.y0; row < near.y1; ++row) {
    for (int column = near.x0; column < near.x1; ++column) {
      brightest = std::max(brightest, red.at(column, row));
    }
  }
  // A disc is thousands of times as bright as surfaces in its light; the sky around it is at most
  // tens.
  if (brightest < 200 * std::max(c.sun.color.r, 0.01)) return;
  warnings.push_back("the reflection shows the sun's disc (" + toml_text(brightest) +
                     "), and sun_highlight adds it again; expected a reflection rendered without "
                     "the disc, or sun_highlight.strength = 0");
}

/// A low sun outside of the picture with its glint inside: no visible object stands in front of it.
void warn_of_glint(const Plan& plan, const Frame& frame, const Pass& c,
                   std::vector<std::string>& warnings) {
  const SunHighlight::Params& glint = plan.look.of<SunHighlight>();
  const bool searches = glint.model == SunHighlight::Model::kSlopes && glint.strength != 0;
  if (!plan.keeps<SunHighlight>() || !searches || frame.plane(PlaneId::kSurfaceShadow)) return;
  if (plan.completed.has(PlaneId::kSurfaceShadow)) return;
  constexpr double kLow = 20 * std::numbers::pi / 180;
  const double rise = std::asin(std::clamp(glm::dot(c.sun.direction, c.up), -1.0, 1.0));
  if (!(rise > 0 && rise < kLow)) return;
  const auto place_of = [&](const glm::dvec3& direction) {
    const double w = c.w_depth * glm::dot(c.forward, direction);
    return w > 0 ? glm::dvec2(glm::dot(c.to_u, direction), glm::dot(c.to_v, direction)) / w
                 : glm::dvec2(HUGE_VAL);
  };
  const auto within = [](double x) { return x >= 0 && x <= 1; };
  const glm::dvec2 sun = place_of(c.sun.direction);
  const glm::dvec2 image = place_of(c.sun.direction - 2 * std::sin(rise) * c.up);
  if (!within(image.x) || (within(sun.x) && within(sun.y))) return;
  warnings.push_back(
      "the sun is " + std::to_string(std::lround(rise * 180 / std::numbers::pi)) +
      " degrees high and outside of the picture: objects that hide it from the water "
      "are not visible, and its glint may be too strong; expected a surface_shadow");
}

void warn_of_scale(const Plan& plan, const Frame& frame, const Pass& c,
                   std::vector<std::string>& warnings) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  if (!plan.made.has(StatePart::kNormal)) return;
  if (waves.model == WaveNormals::Model::kSines) {
    double crest = 0;
    for (const SineWave& wave : waves.waves.empty() ? c.waves : waves.waves) {
      crest += waves.strength * std::abs(wave.amplitude);
    }
    if (c.eye_above > 0 && crest > c.eye_above) {
      warnings.push_back("the waves reach " + toml_text(crest) +
                         " scene units over the calm water, and the camera is " +
                         toml_text(c.eye_above) + " above it; expected lower waves");
    }
  }
  if (!plan.reads_wave_map) return;
  // The nearest water lies at the bottom of most pictures, at the top of a few.
  const Rect work = frame.work();
  double nearest = HUGE_VAL;
  for (const int y : {work.y0, work.y1 - 1}) {
    const double pixel_y = y - c.corner.y + 0.5;
    nearest = std::min(nearest, RowRays<double>(c, pixel_y).calm_depth(0.5 * c.size.x));
  }
  const double pixel = glm::length(c.rays.origin_dx + std::min(nearest, 1e30) * c.rays.ray_dx);
  if (!(nearest < HUGE_VAL && pixel > 0)) return;
  const std::string tile = "wave_normals.tile_size = " + toml_text(waves.tile_size);
  if (waves.tile_size < 2 * pixel) {
    warnings.push_back(tile + ": a pixel of the nearest water is " + toml_text(pixel) +
                       " wide, so no wave of the map is visible; expected larger tiles");
  } else if (waves.tile_size > 100 * pixel * c.size.x) {
    warnings.push_back(tile + ": the nearest water in the picture is " +
                       toml_text(pixel * c.size.x) +
                       " wide, so the waves of the map look flat; expected smaller tiles");
  }
}

/// A plate's own surface is better than one that limpid raises, unless it has no waves.
void warn_of_level_surface(const Plan& plan, const Frame& frame, const Pass& c,
                           std::vector<std::string>& warnings) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  if (waves.model != WaveNormals::Model::kSines || !plan.made.has(StatePart::kNormal)) return;
  if (!surface || !plan.planes.has(PlaneId::kSurfaceDepth)) return;
  double crest = 0;
  for (const SineWave& wave : waves.waves.empty() ? c.waves : waves.waves) {
    crest = std::max(crest, waves.strength * std::abs(wave.amplitude));
  }
  const Rect work = frame.work();
  const int step = std::clamp(std::min(work.width(), work.height()) / 64, 1, kCoarse);
  std::vector<double> seen;
  for (int y = work.y0; y < work.y1; y += step) {
    const RowHeights heights(c, y);
    for (int x = work.x0; x < work.x1; x += step) {
      const double depth = surface.at(x, y);
      if (depth > 0 && depth < 1e30) seen.push_back(heights.at(x, depth));
    }
  }
  if (seen.empty() || crest == 0) return;
  // Far depths are rounded to heights that are no waves.
  std::sort(seen.begin(), seen.end());
  const double spread = seen[seen.size() * 3 / 4] - seen[seen.size() / 4];
  if (spread > 0.25 * crest) return;
  warnings.emplace_back(
      "the surface_depth is level: the waves tilt the water, but do not raise it; expected a "
      "surface_depth with the waves, or none (--layer surface_depth=none)");
}

void warn_of_waves(const Plan& plan, const Scene& scene, std::vector<std::string>& warnings) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  const bool from_map =
      waves.model != WaveNormals::Model::kPlate && waves.model != WaveNormals::Model::kSines;
  if (!scene.has_waves() || !from_map || !plan.made.has(StatePart::kNormal)) return;
  warnings.push_back(
      "the waves of the scene change nothing: the waves are those of wave_normals.map; expected "
      "wave_normals.model = sines, with strength = 1 for the scene's heights");
}

/// Entry points of sunlight for the visible bottom under calm water: the share of them beyond the
/// frame's own normals, if these are the only source of waves.
void warn_of_light(const Plan& plan, const Frame& frame, const Pass& c,
                   std::vector<std::string>& warnings) {
  const WaveNormals::Params& waves = plan.look.of<WaveNormals>();
  const bool of_frame = waves.model == WaveNormals::Model::kPlate && waves.waves.empty() &&
                        c.waves.empty() && frame.present().covers(kSurfaceNormalPlanes);
  const double rise = glm::dot(c.sun.direction, c.up);
  if (!of_frame || !plan.keeps<Caustics>() || plan.look.of<Caustics>().strength == 0 ||
      !c.has_sun || !(rise > 1e-3)) {
    return;
  }
  const glm::dvec3 to_sun = c.sun.direction - rise * c.up;
  const glm::dvec3 aside = -1 / (c.ior * refracted_cosine(rise, 1 / c.ior)) * to_sun;
  const Rect work = frame.work();
  const Rect& normals = frame.plane(PlaneId::kSurfaceNormalX).window;
  int lit = 0, beyond = 0;
  const int step = std::clamp(std::min(work.width(), work.height()) / 64, 1, kCoarse);
  for (int y = work.y0; y < work.y1; y += step) {
    for (int x = work.x0; x < work.x1; x += step) {
      const double at_x = x - c.corner.x + 0.5, at_y = y - c.corner.y + 0.5;
      const double depth = frame.plane(PlaneId::kDepth).at(x, y);
      if (!(depth > 0 && depth < HUGE_VAL)) continue;
      const glm::dvec3 bottom = c.rays.origin_at(at_x, at_y) + depth * c.rays.ray_at(at_x, at_y);
      const double under = -(c.eye_above + glm::dot(c.up, bottom));
      if (!(under > 0)) continue;
      const glm::dvec3 entry = bottom + under * (c.up - aside) - c.rays.origin;
      const double w = c.w_origin + c.w_depth * glm::dot(c.forward, entry);
      const double column = glm::dot(c.to_u, entry) / w * c.size.x + c.corner.x;
      const double row = glm::dot(c.to_v, entry) / w * c.size.y + c.corner.y;
      ++lit;
      beyond += !(w > 0 && column >= normals.x0 && column <= normals.x1 && row >= normals.y0 &&
                  row <= normals.y1);
    }
  }
  constexpr double kMuch = 0.1;  // a smaller rim is hardly noticed
  if (lit == 0 || beyond < kMuch * lit) return;
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.0f %%", 100.0 * beyond / lit);
  warnings.push_back(
      "the sunlight of " + std::string(percent) +
      " of the bottom enters beyond the normals of the picture, where the water counts as calm, "
      "and has no caustics; expected overscan, or waves in the scene");
}

void warn_of_slopes(const Plan& plan, const Frame& frame, std::vector<std::string>& warnings) {
  const bool bends =
      plan.keeps<Caustics>() && plan.look.of<Caustics>().sunlight == Caustics::Sunlight::kRefracted;
  if (!bends || has_fine_depth(frame)) return;
  warnings.push_back(
      "all depths have half precision, too coarse to tell slopes: under water they reflect the "
      "sun as in the dry picture; expected depth of full precision");
}

/// Whether the sky that the water mirrors is a guess, because the picture shows no sky.
void warn_of_sky(const Plan& plan, const Frame& frame, const Pass& pass,
                 std::vector<std::string>& warnings) {
  const bool mirrors_sky = plan.completed.covers(kSkyPlanes) && !frame.present().covers(kSkyPlanes);
  if (!mirrors_sky || shows_sky(frame) || known_sky(plan.look.of<FresnelReflection>(), pass))
    return;
  warnings.push_back(
      "the picture shows no sky: the water mirrors a sky guessed from the picture's brightness" +
      std::string(pass.has_sun ? " and the sun" : "") +
      "; expected a reflection, an environment, or [sky] radiance");
}

}  // namespace

void warn_of_picture(const Plan& plan, const Frame& frame, const Scene& scene,
                     std::vector<std::string>& warnings) {
  const Pass pass = pass_of(plan, scene, frame);
  // Further warnings would describe an unintended picture.
  if (!warn_of_wet(frame, pass, warnings)) return;
  warn_of_depth(frame, warnings);
  warn_of_glass(frame, warnings);
  warn_of_sun(plan, frame, pass, warnings);
  warn_of_glint(plan, frame, pass, warnings);
  warn_of_scale(plan, frame, pass, warnings);
  warn_of_level_surface(plan, frame, pass, warnings);
  warn_of_waves(plan, scene, warnings);
  warn_of_light(plan, frame, pass, warnings);
  warn_of_slopes(plan, frame, warnings);
  warn_of_sky(plan, frame, pass, warnings);
}

std::string sky_over_water(const Plan& plan, const Frame& frame, const Scene& scene) {
  if (!plan.lit_by_sky || !plan.keeps<DepthFog>()) return "";
  if (plan.reads_environment && frame.environment) return "the environment";
  if (frame.sky_radiance || scene.sky) return "the scene's sky";
  return shown_sky_radiance(frame, pass_of(plan, scene, frame)) ? "the picture's sky" : "";
}

void warn_of_ambient(const Plan& plan, const Frame& frame, const Scene& scene,
                     std::vector<std::string>& warnings) {
  if (plan.look.of<DepthFog>().ambient == DepthFog::Params{}.ambient) return;
  const std::string sky = sky_over_water(plan, frame, scene);
  if (sky.empty()) return;
  warnings.push_back("depth_fog.ambient changes nothing: " + sky + " lights the water");
}

void warn_of_lamps(const Plan& plan, const Frame& frame, std::vector<std::string>& warnings) {
  const bool of_frame = plan.look.of<WaveNormals>().model == WaveNormals::Model::kPlate;
  const FresnelReflection::Source source = plan.look.of<FresnelReflection>().source;
  const bool mirrors =
      plan.keeps<FresnelReflection>() &&
      (source == FresnelReflection::Source::kAuto || source == FresnelReflection::Source::kPlanar);
  if (!mirrors || !plan.made.has(StatePart::kNormal) || of_frame) return;
  constexpr int kMost = 512;
  constexpr double kBright = 16, kMuch = 0.25;
  constexpr double kNoise = 3;  // so many bright pixels may be fireflies of the renderer
  const Rect work = frame.work();
  const int step_x = std::max(1, work.width() / kMost), step_y = std::max(1, work.height() / kMost);
  std::vector<double> lights;
  double sum = 0;
  for (int y = work.y0; y < work.y1; y += step_y) {
    for (int x = work.x0; x < work.x1; x += step_x) {
      double light = 0;
      for (int i = 0; i < 3; ++i) {
        light += std::max(frame.plane(plane_after(PlaneId::kColorR, i)).at(x, y), 0.0f);
      }
      if (!(light < HUGE_VAL)) continue;
      lights.push_back(light);
      sum += light;
    }
  }
  const auto pixels = static_cast<double>(lights.size());
  double bright = 0, count = 0;
  for (const double light : lights) {
    if (light * pixels < kBright * sum) continue;
    bright += light;
    ++count;
  }
  if (!(bright > kMuch * sum && count > kNoise)) return;
  char text[192];
  std::snprintf(
      text, sizeof text,
      "%.0f %% of the picture's light is in %.2g %% of its pixels, like that of lamps or the sun: "
      "waves mirror them as hard dashes; expected 16 samples (--samples 16)",
      100 * bright / sum, 100 * count / pixels);
  warnings.emplace_back(text);
}

void warn_of_deep_glass(double share, std::vector<std::string>& warnings) {
  if (share < 0.001) return;
  warnings.push_back(glass_text(share, "the wet pixels show objects under water that are"));
}

OffFrameLookups off_frame_lookups_of(const Plan& plan, const Frame& frame, const Scene& scene) {
  const bool rays = plan.look.of<Refraction>().model == Refraction::Model::kSnell;
  if (!plan.made.has(StatePart::kPosition) || !rays) return {};
  const Pass pass = pass_of(plan, scene, frame);
  const auto bottom = fit_bottom(frame, pass);
  return bottom ? off_frame_lookups(*bottom, frame, pass) : OffFrameLookups{};
}

void warn_of_off_frame(const OffFrameLookups& off_frame, std::vector<std::string>& warnings) {
  if (off_frame.share >= 0.01) warnings.push_back(to_text(off_frame));
}

void refuse_warnings(bool strict, const std::vector<std::string>& warnings) {
  if (!strict || warnings.empty()) return;
  throw Error(warnings.front() +
              (warnings.size() > 1
                   ? " (and " + std::to_string(warnings.size() - 1) + " more warnings)"
                   : ""));
}

}  // namespace limpid
