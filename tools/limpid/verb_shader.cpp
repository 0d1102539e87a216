#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <glm/ext/matrix_transform.hpp>

#include "limpid/core/error.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/job/shader.h"
#include "limpid/plate/plate.h"
#include "limpid/plate/texture.h"

#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

namespace fs = std::filesystem;

/// Calm water two units below a camera that looks slightly down, and a sun: the numbers until a
/// host sets its own.
Scene usual_scene() {
  Scene scene;
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 1.5, -1), glm::dvec3(0, 1, 0));
  camera.projection = perspective(0.9, 16.0 / 9, 0.1, 1000, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  scene.sun = Sun{{0, 0.6, -0.8}, {3, 2.8, 2.5}};
  return scene;
}

PlaneSet planes_of(const std::vector<std::string>& names) {
  PlaneSet planes = kColorPlanes | PlaneSet{PlaneId::kDepth};
  return as_usage([&] {
    for (const std::string& name : names) planes = planes | role_named(name).planes();
    return planes;
  });
}

/// The frame for recording a shader: of a scene's plates, or one without pixels, which only knows
/// which planes there are.
struct Subject {
  Subject(Scene of, PlaneSet has) : scene(std::move(of)) {
    frame.display = rect_of({16, 9});
    for (const Role& role : roles()) {
      for (int k = 0; k < role.count; ++k) {
        const PlaneId plane = plane_after(role.first, k);
        if (!has.has(plane)) continue;
        loaded.planes.emplace_back(frame.display);
        const View<float> view = loaded.planes.back().view();
        for (int y = 0; y < 9; ++y) std::fill_n(view.row(y), 16, role.missing);
        frame.planes[static_cast<std::size_t>(index_of(plane))] = view;
      }
    }
  }
  Subject(Scene of, LoadedPlate plate)
      : real(true), scene(std::move(of)), loaded(std::move(plate)), frame(loaded.frame) {}

  bool real = false;
  Scene scene;
  LoadedPlate loaded;
  LoadedTexture surroundings;
  Frame frame;
};

Subject subject_of(const SceneFile& file, const ShaderArguments& a) {
  Scene scene = usual_scene();
  if (file.scene.water) scene.water = file.scene.water;
  if (file.scene.sun) scene.sun = file.scene.sun;
  scene.sky = file.scene.sky;
  scene.time = file.scene.time;
  scene.primaries = file.scene.primaries;
  const bool plates = !file.plates.empty() && a.planes.empty();
  if (plates && !file.camera) throw Error(a.scene + ": expected a [camera] for its plates");
  Subject subject = [&] {
    if (!plates) return Subject(scene, planes_of(a.planes));
    PlateRequest request;
    request.named = file.plates;
    const Plate plate = Plate::open(request);
    if (!file.primaries) scene.primaries = plate.primaries().value_or(kRec709);
    scene.camera = camera_for(*file.camera, plate.display().size(), plate.pixel_aspect());
    const DepthMeaning depth{file.depth, file.near.value_or(0), file.far.value_or(0)};
    return Subject(scene, plate.read(plate.planes(), scene, depth));
  }();
  if (!file.environment.empty()) {
    subject.surroundings =
        load_environment(file.environment, file.environment_rotation, scene.primaries);
    subject.frame.environment = subject.surroundings.texture;
  }
  return subject;
}

ShaderOptions::Stage stage_named(const std::string& name) {
  if (name == "compute") return ShaderOptions::Stage::kCompute;
  if (name == "fragment") return ShaderOptions::Stage::kFragment;
  if (name == "none") return ShaderOptions::Stage::kFunction;
  throw Error("--main " + name + ": expected none, compute or fragment");
}

}  // namespace

int shader_verb(const ShaderArguments& a, const CommonArguments& common) {
  const ShaderLanguage language = as_usage([&] { return shader_language_named(a.language); });
  ShaderOptions options;
  options.stage = as_usage([&] { return stage_named(a.main); });
  options.function = a.function;
  options.set = a.descriptor_set;
  options.first_binding = a.first_binding;
  for (const std::string& name : a.aovs) {
    options.aovs.push_back(as_usage([&] { return aov_named(name); }));
  }
  const Look look = look_of(a.water);
  const Subject subject = a.scene.empty() ? Subject(usual_scene(), planes_of(a.planes))
                                          : subject_of(load_scene(a.scene), a);
  Frame frame = subject.frame;
  const LoadedTexture map = load_texture(look.of<WaveNormals>().map);
  frame.wave_map = map.texture;
  Plan plan = make_plan(
      look,
      {frame.present(), true, subject.scene.sun.has_value(), static_cast<bool>(frame.environment),
       subject.scene.has_waves(), subject.scene.primaries},
      state_shown_by(options.aovs));
  if (!subject.real) plan.completed = {};  // a host makes its own buffers or has none
  const ShaderText shader =
      as_usage([&] { return ShaderText(plan, frame, subject.scene, options); });
  if (a.output.empty()) {
    if (language == ShaderLanguage::kSpirv) {
      throw Error("spirv is binary: expected -o FILE", Fault::kUsage);
    }
    std::fputs(in_language(shader, language).c_str(), stdout);
    return 0;
  }
  const std::vector<fs::path> paths =
      write_shader(a.output, shader, language, subject.real ? &frame : nullptr);
  if (common.quiet) return 0;
  std::printf("%s: %s, %zu numbers, %zu textures, id %s\n", a.output.c_str(), a.language.c_str(),
              shader.numbers().size(), shader.textures().size(), shader.id().c_str());
  std::vector<std::string> beside;
  for (const fs::path& path : paths) beside.push_back(path.filename().string());
  beside.erase(beside.begin());
  std::printf("beside it: %s\n", join(beside).c_str());
  return 0;
}

}  // namespace limpid::tool
