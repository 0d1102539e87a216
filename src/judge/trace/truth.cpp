#include "judge/trace/truth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "limpid/core/error.h"
#include "limpid/core/texture_levels.h"
#include "limpid/raster/render_plate.h"

#include "judge/trace/geometry.h"
#include "judge/trace/mean_light.h"
#include "ops/wave_normals_kernel.h"
#include "raster/check_rendered.h"
#include "run/each_once.h"

namespace limpid {
namespace {

using trace::Geometry;
using trace::Light;

void expect_in(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return;
  throw Error(std::string(name) + " = " + std::to_string(value) + ": expected " +
                  std::to_string(least) + " ... " + std::to_string(most),
              Fault::kUsage);
}

void check(const Model& model, const Scene& scene, const Look& look, const TruthOptions& options) {
  look.validate();
  check_rendered(scene, options.size);
  renderable(model, scene);
  expect_in("samples", options.samples, 1, kMaxTruthSamples);
  expect_in("paths", options.paths, 1, kMaxTruthPaths);
  expect_in("photons", options.photons, 0, kMaxTruthPhotons);
  for (Aov aov : options.aovs) {
    const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
    if (!info.of_buffers) continue;
    throw Error("'" + std::string(info.name) +
                    "' is not an AOV of the truth, which has no guesses and no buffers: expected "
                    "visible",
                Fault::kUsage);
  }
  expect_each_once(options.aovs);
  const bool bends = look.of<DepthFog>().sunlight == DepthFog::Sunlight::kRefracted;
  if (options.photons > 0 && (options.light == TruthOptions::Light::kOnce || !bends)) {
    throw Error("photons = " + std::to_string(options.photons) +
                    ": expected 0 unless light = paths and depth_fog.sunlight = refracted",
                Fault::kUsage);
  }
  const double above = glm::dot(scene.camera->eye(), scene.water->up) - scene.water->height;
  if (scene.camera->orthographic() && above < 0) {
    throw Error("an orthographic camera below the water: expected one above it");
  }
}

/// The frame for the chain's formulas, without planes: its size, and the waves.
Frame frame_of(const Scene& scene, const Look& look, const TruthOptions& options) {
  Frame frame;
  frame.display = rect_of(options.size);
  frame.wave_map = options.wave_map;
  const WaveNormals::Params& waves = look.of<WaveNormals>();
  if (frame.wave_map && Kernel<WaveNormals>::needs_wave_variance(waves)) {
    LevelMaker maker;
    if (!frame.wave_map.levels) maker.make(frame.wave_map);
    const TextureLevels* levels = frame.wave_map.levels;
    frame.wave_variance =
        Kernel<WaveNormals>::wave_variance(waves, levels ? *levels : maker.levels(), scene.time);
  }
  return frame;
}

/// The pass for formulas at one point of the surface. Rays replace planes: they find the surface
/// itself, and the sun's shadow on it.
Pass pass_of(const Model& model, const Scene& scene, const Look& look,
             const TruthOptions& options) {
  const PlaneSet traced{PlaneId::kSurfaceDepth, PlaneId::kSurfaceShadow};
  const PlaneSet there = renderable(model, scene) & traced;
  Pass pass(scene, frame_of(scene, look, options), look.water.ior, {},
            {.raises = there.has(PlaneId::kSurfaceDepth), .waves = {}});
  pass.planes = there;
  return pass;
}

TruthPicture picture_for(const TruthOptions& options) {
  TruthPicture picture;
  picture.window = rect_of(options.size);
  const auto add = [&] {
    picture.planes.emplace_back(picture.window);
    return picture.planes.back().view();
  };
  for (View<float>& view : picture.target.color) view = add();
  picture.target.alpha = add();
  for (Aov aov : options.aovs) {
    const std::size_t channels = aovs()[static_cast<std::size_t>(aov)].suffixes.size();
    for (std::size_t i = 0; i < channels; ++i) picture.target.of(aov)[i] = add();
  }
  if (options.visible) {
    for (View<float>& view : picture.visible) view = add();
    for (View<float>& view : picture.visible_below) view = add();
  }
  return picture;
}

/// The mean of many samples.
class Mean {
 public:
  void add(const Light& light) {
    sum_.transmitted = sum_.transmitted + light.transmitted;
    sum_.in_scatter = sum_.in_scatter + light.in_scatter;
    sum_.reflected = sum_.reflected + light.reflected;
    sum_.highlight = sum_.highlight + light.highlight;
    sum_.transmittance = sum_.transmittance + light.transmittance;
    sum_.fresnel += light.fresnel;
    count_ += 1;
    color_.add(light.sum());
  }
  const trace::MeanLight& color() const { return color_; }
  Light light() const {
    const double share = 1 / count_;
    return {share * sum_.transmitted, share * sum_.in_scatter, share * sum_.reflected,
            share * sum_.highlight,   share * sum_.fresnel,    share * sum_.transmittance};
  }

 private:
  Light sum_{.transmittance = {0, 0, 0}};
  double count_ = 0;
  trace::MeanLight color_;
};

double sum_of(const Rgb<double>& c) { return c.r + c.g + c.b; }

/// Differs from the seeds of places in pixels.
constexpr std::uint64_t kPathSeed = 0x5a11ed;

class Painter {
 public:
  Painter(const Model& model, const Scene& scene, const Look& look, const TruthOptions& options,
          TruthPicture& picture, Executor& executor)
      : options_(options),
        picture_(picture),
        pass_(pass_of(model, scene, look, options)),
        eye_(*scene.camera, options.size),
        tracer_(model, scene, look, options, pass_, eye_, executor),
        paths_(options.light == TruthOptions::Light::kPaths ? options.paths : 1),
        steps_(std::max(4, 32 / (options.samples * options.samples))),
        rows_(static_cast<std::size_t>(options.size.height)) {}

  void paint_row(int y) {
    for (int x = 0; x < options_.size.width; ++x) {
      const Mean mean = seen_at(x, y);
      put(x, y, mean.light());
      Row& row = rows_[static_cast<std::size_t>(y)];
      row.light += sum_of(mean.color().mean());
      row.error += sum_of(mean.color().error());
      if (wants_geometry()) {
        const bool in_water = begins_in_water(x + 0.5, y + 0.5);
        put(x, y, geometry_at(tracer_, eye_, pass_, x + 0.5, y + 0.5, in_water));
      }
    }
  }

  double relative_error() const {
    if (options_.samples * options_.samples * paths_ < 2) return std::nan("");
    Row all;
    for (const Row& row : rows_) {
      all.light += row.light;
      all.error += row.error;
    }
    return all.light > 0 ? all.error / all.light : std::nan("");
  }

 private:
  struct Row {
    double light = 0, error = 0;
  };

  Mean seen_at(int x, int y) const {
    const int n = options_.samples;
    Mean mean;
    for (int i = 0; i < n * n; ++i) {
      trace::Samples samples = n > 1 ? trace::Samples(options_.seed, x, y, i) : trace::Samples();
      trace::Samples paths(options_.seed + kPathSeed, x, y, i);
      for (int path = 0; path < paths_; ++path) {
        const double at_x = x + (i % n + samples.next()) / n;
        const double at_y = y + (i / n + samples.next()) / n;
        mean.add(tracer_.seen(eye_.beam_at(at_x, at_y, 1.0 / n), begins_in_water(at_x, at_y),
                              steps_, samples, paths));
      }
    }
    return mean;
  }

  bool begins_in_water(double x, double y) const {
    return limpid::begins_in_water(pass_, RowRays<double>(pass_, y), x) > 0;
  }

  bool wants_geometry() const {
    constexpr Aov kGeometric[] = {Aov::kPath,   Aov::kNormal, Aov::kSurfaceDepth,
                                  Aov::kStmapR, Aov::kStmapG, Aov::kStmapB};
    return picture_.visible[0] || std::any_of(std::begin(kGeometric), std::end(kGeometric),
                                              [&](Aov aov) { return view_of(aov)[0].data; });
  }

  const std::array<View<float>, 3>& view_of(Aov aov) const { return picture_.target.of(aov); }
  void put(const std::array<View<float>, 3>& to, int x, int y, const Rgb<double>& value) const {
    const double values[] = {value.r, value.g, value.b};
    for (std::size_t c = 0; c < 3; ++c) {
      if (to[c]) to[c].at(x, y) = static_cast<float>(values[c]);
    }
  }

  void put(int x, int y, const Light& light) const {
    put(picture_.target.color, x, y, light.sum());
    picture_.target.alpha.at(x, y) = 1;
    put(view_of(Aov::kTransmitted), x, y, light.transmitted);
    put(view_of(Aov::kInScatter), x, y, light.in_scatter);
    put(view_of(Aov::kReflected), x, y, light.reflected);
    put(view_of(Aov::kHighlight), x, y, light.highlight);
    put(view_of(Aov::kFresnel), x, y, {light.fresnel, 0, 0});
    put(view_of(Aov::kTransmittance), x, y, light.transmittance);
  }

  void put(int x, int y, const Geometry& g) const {
    put(view_of(Aov::kPath), x, y, {g.path, 0, 0});
    put(view_of(Aov::kSurfaceDepth), x, y, {g.surface_depth, 0, 0});
    put(view_of(Aov::kNormal), x, y, {g.normal.x, g.normal.y, g.normal.z});
    for (int c = 0; c < 3; ++c) {
      const glm::dvec2& uv = g.uv[static_cast<std::size_t>(c)];
      put(view_of(static_cast<Aov>(static_cast<int>(Aov::kStmapR) + c)), x, y, {uv.x, 1 - uv.y, 0});
    }
    const auto shares = [](const std::array<bool, 3>& seen) {
      return Rgb<double>{double(seen[0]), double(seen[1]), double(seen[2])};
    };
    put(picture_.visible, x, y, shares(g.visible));
    put(picture_.visible_below, x, y, shares(g.visible_below));
  }

  const TruthOptions& options_;
  TruthPicture& picture_;
  Pass pass_;
  trace::Eye eye_;
  trace::Tracer tracer_;
  int paths_, steps_;
  std::vector<Row> rows_;
};

}  // namespace

TruthPicture trace_truth(const Model& model, const Scene& scene, const Look& look,
                         const TruthOptions& options, Executor& executor) {
  check(model, scene, look, options);
  TruthPicture picture = picture_for(options);
  Painter painter(model, scene, look, options, picture, executor);
  run_each(executor, options.size.height, [&](int y) { painter.paint_row(y); });
  picture.relative_error = painter.relative_error();
  return picture;
}

}  // namespace limpid
