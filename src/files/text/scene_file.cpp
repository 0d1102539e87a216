#include "limpid/files/text/scene_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limpid/core/frame.h"
#include "limpid/files/text/scene_keys.h"

#include "core/value_text.h"
#include "files/text/scene_tables.h"
#include "files/text/toml_value.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

template <class P>
std::vector<std::string> names_of(const FieldTable<P>& keys) {
  Names names;
  for (const Field<P>& field : keys.fields) names.emplace_back(field.name);
  return names;
}

/// The values of the table, and defaults for other keys.
template <class P>
P read_table(const TomlNode& table, const FieldTable<P>& keys) {
  table.expect_keys(names_of(keys));
  if (!keys.required.empty() && !table.find(keys.required)) {
    throw Error(table.place + table.path + ": expected " + std::string(keys.expected));
  }
  P params;
  read_fields(table, keys.fields, params);
  return params;
}

static_assert(kMaxWaves == 1024, "scene_tables.h says the number");
void expect_few_waves(const WaterPlane& water) {
  if (water.waves.size() <= kMaxWaves) return;
  throw Error("water.waves: " + std::to_string(water.waves.size()) + " waves: expected at most " +
              std::to_string(kMaxWaves));
}

WaterPlane water_of(const TomlNode& table) {
  const TomlNode* waves = table.find("waves");
  if (waves && waves->kind == TomlNode::Kind::kList) {  // for an error, names the wrong row
    constexpr std::size_t kAll = std::size(SineWave::kColumns);
    for (const TomlNode& wave : waves->items) {
      wave.finite_numbers(wave.items.size() == kAll ? kAll : SineWave::kLeastColumns);
    }
  }
  const WaterPlane water = read_table(table, kWaterTable);
  if (waves) at_place(waves->place, [&] { expect_few_waves(water); });
  return water;
}

/// "FILE" or "FILE:CHANNELS" of a role.
std::string plate_of(const TomlNode& node, const fs::path& folder) {
  const PlateName name = split_plate(node.word());
  if (name.file.empty() || node.text.back() == ':') node.refuse("FILE or FILE:CHANNELS");
  const std::string file = (folder / name.file).lexically_normal().string();
  return name.channels.empty() ? file : file + ":" + name.channels;
}

void read_plates(const TomlNode& table, const fs::path& folder, SceneFile& file) {
  Names known = names_of(kPlatesTable);
  for (const Role& role : roles()) known.emplace_back(role.name);
  table.expect_keys(known);
  PlateKeys keys;
  read_fields(table, kPlatesTable.fields, keys);
  const TomlNode* environment = table.find("environment");
  const TomlNode* rotation = table.find("environment_rotation");
  if (rotation && !environment) {
    throw Error(rotation->key_place + rotation->path + ": expected an environment beside it");
  }
  if (environment) file.environment = (folder / keys.environment).lexically_normal();
  file.environment_rotation = keys.environment_rotation * std::numbers::pi / 180;
  for (const Role& role : roles()) {
    if (const TomlNode* node = table.find(role.name)) {
      file.plates[node->key] = plate_of(*node, folder);
    }
  }
}

/// The file's near and far, for any use.
void read_range(const TomlNode& table, const CameraKeys& keys, SceneFile& file) {
  const TomlNode* far = table.find("far");
  if (table.find("near")) file.near = keys.near;
  if (far) file.far = keys.far;
  if (file.near && file.far && !(*file.far > *file.near)) far->refuse("more than near");
}

void read_depth(const TomlNode& table, const CameraKeys& keys, SceneFile& file) {
  file.depth = keys.depth;
  const bool finite_range = file.near && file.far && std::isfinite(*file.far);
  if (file.depth == DepthKind::kNormalised && !finite_range) {
    table.find("depth")->refuse("near and a finite far beside it");
  }
}

struct LensKey {
  std::string_view name;
  CameraSpec::Lens lens;
};
constexpr LensKey kLensKeys[] = {{"projection", CameraSpec::Lens::kProjection},
                                 {"fov_x", CameraSpec::Lens::kFovX},
                                 {"fov_y", CameraSpec::Lens::kFovY},
                                 {"orthographic", CameraSpec::Lens::kOrthographic}};
constexpr const char* kLensNames = "projection, fov_x, fov_y and orthographic";

/// The only key of the table that sets the projection, or nullptr.
const TomlNode* lens_node(const TomlNode& table, CameraSpec::Lens& lens) {
  const TomlNode* found = nullptr;
  for (const LensKey& key : kLensKeys) {
    const TomlNode* node = table.find(key.name);
    if (!node) continue;
    if (found) {
      throw Error(node->key_place + node->path + " and " + found->path + ": expected only one of " +
                  kLensNames);
    }
    found = node;
    lens = key.lens;
  }
  return found;
}

double field_of_view_of(const TomlNode& node) {
  if (!(node.number > 0 && node.number < 180)) node.refuse("degrees above 0 and below 180");
  return node.number * std::numbers::pi / 180;
}

void read_lens(const TomlNode& lens, const TomlNode& table, const SceneFile& file,
               CameraSpec& spec) {
  if (spec.lens == CameraSpec::Lens::kProjection) return;
  const bool flat = spec.lens == CameraSpec::Lens::kOrthographic;
  spec.extent = flat ? lens.number : field_of_view_of(lens);
  if (file.depth == DepthKind::kDevice && !(file.near && file.far)) {
    table.find("depth")->refuse("near and far beside " + lens.key);
  }
  spec.near = file.near.value_or(flat ? 0 : 0.01);
  spec.far = file.far.value_or(flat ? spec.near + 1e4 : std::numeric_limits<double>::infinity());
}

/// A view and a lens, or neither and no `clip`.
void expect_pair(const TomlNode& table, const TomlNode* lens) {
  const TomlNode* view = table.find("view");
  const TomlNode* clip = table.find("clip");
  if (!view && !lens && clip) {
    throw Error(clip->key_place + "camera.clip: expected a projection beside it");
  }
  if (view && !lens) {
    throw Error(view->key_place + "camera.view: expected one of " + kLensNames + " beside it");
  }
  if (lens && !view) throw Error(lens->key_place + lens->path + ": expected a view beside it");
}

void read_camera(const TomlNode& table, SceneFile& file) {
  table.expect_keys(names_of(kCameraTable));
  CameraSpec spec;
  const TomlNode* lens = lens_node(table, spec.lens);
  expect_pair(table, lens);
  const CameraKeys keys = read_table(table, kCameraTable);
  if (table.find("depth_nothing")) file.depth_nothing = keys.depth_nothing;
  read_range(table, keys, file);
  read_depth(table, keys, file);
  if (!lens) return;
  spec.view = keys.view;
  spec.projection = keys.projection;
  spec.clip = keys.clip;
  at_place(table.find("view")->place, [&] {
    Camera{spec.view, perspective(1, 1, 1, 2, ClipSpace::kGl), ClipSpace::kGl}.validate();
  });
  read_lens(*lens, table, file, spec);
  at_place(lens->place, [&] { camera_for(spec, {1, 1}); });
  file.camera = spec;
}

SceneFile scene_of(const TomlNode& root, const fs::path& folder) {
  Names tables;
  for (const SceneTable& table : scene_tables()) tables.emplace_back(table.name);
  root.expect_keys(tables);
  SceneFile file;
  for (const TomlNode& table : root.items) {
    if (table.key == "geometry") {
      file.geometry = (folder / read_table(table, kGeometryTable).gltf).lexically_normal();
    }
    if (table.key == "plates") read_plates(table, folder, file);
    if (table.key == "camera") read_camera(table, file);
    if (table.key == "water") file.scene.water = water_of(table);
    if (table.key == "sun") file.scene.sun = read_table(table, kSunTable);
    if (table.key == "sky") file.scene.sky = read_table(table, kSkyTable);
    if (table.key == "scene") {
      const Scene read = read_table(table, kSceneTable);
      file.scene.time = read.time;
      file.scene.primaries = read.primaries;
      if (table.find("time")) file.time = read.time;
      if (table.find("colorspace")) file.primaries = read.primaries;
    }
  }
  return file;
}

/// The keys of the table that are among `names`, or all.
template <class P>
std::string table_text(const FieldTable<P>& keys, const P& params,
                       std::initializer_list<std::string_view> names = {}) {
  std::string text = "[" + std::string(keys.name) + "]\n";
  for (const Field<P>& field : keys.fields) {
    const bool named = std::find(names.begin(), names.end(), field.name) != names.end();
    if (named || names.size() == 0) text += toml_line(field.name, field.get(params));
  }
  return text;
}

}  // namespace

SceneFile load_scene(const fs::path& path) {
  SceneFile scene = scene_of(parse_toml(path), fs::absolute(path).parent_path());
  scene.file = fs::absolute(path);
  return scene;
}

SceneFile scene_from_toml(const std::string& text, const std::string& name) {
  return scene_of(parse_toml_text(text, name), {});
}

std::string to_toml(const Scene& scene) {
  // No primaries if they are the default.
  std::string text = agree(scene.primaries, kRec709) ? table_text(kSceneTable, scene, {"time"})
                                                     : table_text(kSceneTable, scene);
  if (const std::optional<Camera>& camera = scene.camera) {
    CameraKeys keys;
    keys.view = camera->view;
    keys.projection = camera->projection;
    keys.clip = camera->clip;
    text += table_text(kCameraTable, keys, {"view", "projection", "clip"});
  }
  if (scene.water) {
    expect_few_waves(*scene.water);
    text += table_text(kWaterTable, *scene.water);
  }
  if (scene.sun) text += table_text(kSunTable, *scene.sun);
  if (scene.sky) text += table_text(kSkyTable, *scene.sky);
  return text;
}

PlateName split_plate(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || text.find('/', colon) != std::string_view::npos) {
    return {std::string(text), ""};
  }
  return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

std::string_view depth_kind_name(DepthKind kind) { return kDepths[static_cast<std::size_t>(kind)]; }

DepthKind depth_kind_named(std::string_view word) {
  const auto found = std::find(std::begin(kDepths), std::end(kDepths), word);
  if (found != std::end(kDepths)) return static_cast<DepthKind>(found - std::begin(kDepths));
  const Names names(std::begin(kDepths), std::end(kDepths));
  throw Error("depth kind '" + std::string(word) + "': expected one of " + join(names) +
                  did_you_mean(word, names),
              Fault::kUsage);
}

}  // namespace limpid
