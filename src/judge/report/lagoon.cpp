#include "judge/report/lagoon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/run/fused.h"

#include "judge/report/picture.h"

namespace limpid {
namespace {

constexpr float kSure = 0.999f;

std::array<Plane, 3> read_rgb(const std::filesystem::path& path, Rect window) {
  const ExrFile file = ExrFile::open(path);
  std::array<Plane, 3> planes{Plane(window), Plane(window), Plane(window)};
  const ExrRequest requests[] = {
      {0, "R", planes[0].view()}, {0, "G", planes[1].view()}, {0, "B", planes[2].view()}};
  file.read(requests);
  return planes;
}

}  // namespace

Lagoon::Lagoon(const std::filesystem::path& folder) {
  const SceneFile file = load_scene(folder / "lagoon.toml");
  PlateRequest request;
  request.named = file.plates;
  request.named["surface_normal"] = (folder / "water_normal_flat.exr").string();
  const Plate plate = Plate::open(request);
  scene_ = file.scene;
  scene_.camera = camera_for(*file.camera, plate.display().size(), plate.pixel_aspect());
  plate_ = plate.read(plate.planes(), scene_, {.kind = file.depth});
  truth_ = read_rgb(folder / "truth_flat.exr", window());

  sure_ = Plane(window());
  Picture picture(window());
  picture.target.of(Aov::kConfidence)[0] = sure_.view();
  run(plan(truth_look(), StateSet{StatePart::kConfidence}), picture.target, *make_executor(1));
}

Look Lagoon::with_its_water(Look look) {
  look.water.ior = 1.333;
  look.of<PrismSplit>().gain = 0;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = {0.42, 0.085, 0.055};
  fog.scattering = fog.ambient = {0, 0, 0};
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.crossing = DepthFog::Crossing::kNone;
  look.of<Caustics>().strength = 0;  // Cycles' water transmits sunlight straight
  look.of<Caustics>().sunlight = Caustics::Sunlight::kStraight;
  look.of<SunHighlight>().roughness = 0;  // the sea mirrors the sun's disc
  return look;
}

Look Lagoon::truth_look() {
  Look look = with_its_water({});
  Refraction::Params& refraction = look.of<Refraction>();
  refraction.model = Refraction::Model::kSnell;
  refraction.steps = Refraction::kMarch;
  refraction.rejection = Refraction::Rejection::kShorten;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.model = DepthFog::Model::kBeerLambert;
  fog.distance = DepthFog::Distance::kRefracted;
  FresnelReflection::Params& mirror = look.of<FresnelReflection>();
  mirror.reflectance = FresnelReflection::Reflectance::kExact;
  mirror.source = FresnelReflection::Source::kPlanar;
  mirror.lookup = FresnelReflection::Lookup::kRay;
  look.of<SunHighlight>().model = SunHighlight::Model::kGgx;
  return look;
}

std::vector<SineWave> Lagoon::waves() {
  return {{0.00139261, 17.0053, 5.7527, 2.7692},    {0.00178933, -7.8484, 11.559, 5.72383},
          {0.00229908, 10.1047, 4.01714, 3.65824},  {0.00295405, 5.31121, 6.58884, 0.527399},
          {0.0037956, 4.99447, 4.29397, 1.48792},   {0.0048769, -2.68686, 4.36564, 4.95601},
          {0.00626624, 0.213654, 3.98391, 3.91619}, {0.00805138, 1.67929, 2.61178, 0.933396},
          {0.0103451, -0.61976, 2.33579, 0.718878}};
}

std::vector<Lagoon::Refracted> Lagoon::refraction_variants() {
  using Rejection = Refraction::Rejection;
  Look none = truth_look();
  // The normals are calm: normal_offset shifts by 0, at any strength.
  none.of<Refraction>().model = Refraction::Model::kNormalOffset;
  none.of<Refraction>().strength = 0;
  std::vector<Refracted> variants{{"no refraction", none}};
  for (const int steps : {0, 1, 2, 4, Refraction::kMarch}) {
    const std::string variant =
        steps == Refraction::kMarch ? "snell march" : "snell steps " + std::to_string(steps);
    const std::pair<const char*, Rejection> rejections[] = {
        {"none", Rejection::kNone}, {"snap", Rejection::kSnap}, {"shorten", Rejection::kShorten}};
    for (const auto& [name, rejection] : rejections) {
      Look look = truth_look();
      look.of<Refraction>().steps = steps;
      look.of<Refraction>().rejection = rejection;
      variants.push_back({variant + ", " + name, look});
    }
  }
  return variants;
}

Plan Lagoon::plan(const Look& look, StateSet outputs) const {
  return make_plan(look, {.planes = plate_.frame.present(), .sun = true}, outputs);
}

void Lagoon::run(const Plan& plan, const Target& target, Executor& executor,
                 const std::string& simd) const {
  run_fused(plan, plate_.frame, scene_, target, executor, {.simd = simd});
}

bool Lagoon::wet(int x, int y) const {
  const float surface = plate_.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
  return std::isfinite(surface) && surface < plate_.frame.plane(PlaneId::kDepth).at(x, y);
}

TruthError Lagoon::error_of(const std::array<View<const float>, 3>& color) const {
  double truth = 0, off = 0, truth_in_frame = 0, off_in_frame = 0;
  const Rect w = window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      if (!wet(x, y)) continue;
      const bool in_frame = sure_.view().at(x, y) > kSure;
      for (std::size_t c = 0; c < 3; ++c) {
        const double right = std::min<double>(truth_[c].view().at(x, y), kBrightest);
        const double error = std::abs(std::min<double>(color[c].at(x, y), kBrightest) - right);
        truth += right;
        off += error;
        truth_in_frame += in_frame ? right : 0;
        off_in_frame += in_frame ? error : 0;
      }
    }
  }
  return {off / truth, off_in_frame / truth_in_frame};
}

std::array<View<const float>, 3> Lagoon::dry() const {
  const Frame& frame = plate_.frame;
  return {frame.plane(PlaneId::kColorR), frame.plane(PlaneId::kColorG),
          frame.plane(PlaneId::kColorB)};
}

std::array<View<const float>, 3> Lagoon::truth() const {
  return {truth_[0].view(), truth_[1].view(), truth_[2].view()};
}

double Lagoon::wet_share() const {
  double count = 0;
  const Rect w = window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) count += wet(x, y);
  }
  return count / (double(w.width()) * w.height());
}

double Lagoon::in_frame_share() const {
  double wet_count = 0, count = 0;
  const Rect w = window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      wet_count += wet(x, y);
      count += wet(x, y) && sure_.view().at(x, y) > kSure;
    }
  }
  return count / wet_count;
}

}  // namespace limpid
