#include "limpid/files/text/scene_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/toml_text.h"

#include "files/text/toml.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kClips[] = {"gl", "d3d", "reversed"};
constexpr std::string_view kDepths[] = {"eye", "ray", "inverse", "normalised", "device"};

using Names = std::vector<std::string>;

/// Four rows in the file; GLM keeps columns.
glm::dmat4 matrix_of(const TomlNode& node) {
  if (node.kind != TomlNode::Kind::kList || node.items.size() != 4) {
    node.refuse("a list of 4 rows of 4 numbers");
  }
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row) {
    const std::vector<double> entries = node.items[row].finite_numbers(4);
    for (int column = 0; column < 4; ++column) matrix[column][row] = entries[column];
  }
  return matrix;
}

glm::dvec3 direction_of(const TomlNode& node) {
  const std::vector<double> v = node.finite_numbers(3);
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (largest == 0) node.refuse("a vector that is not zero");
  const glm::dvec3 direction(v[0], v[1], v[2]);
  // What is unit to rounding stays as it is: a direction that was written out reads back the same.
  if (std::abs(glm::dot(direction, direction) - 1) < 1e-14) return direction;
  return glm::normalize(direction / largest);
}

SineWave wave_of(const TomlNode& node) {
  constexpr std::size_t kAll = std::size(SineWave::kColumns);
  const bool complete = node.items.size() == kAll;
  return SineWave::from_row(node.finite_numbers(complete ? kAll : SineWave::kLeastColumns));
}

/// "1025 waves: expected at most 1024", or "".
std::string too_many(std::size_t waves) {
  if (waves <= kMaxWaves) return "";
  return std::to_string(waves) + " waves: expected at most " + std::to_string(kMaxWaves);
}

WaterPlane water_of(const TomlNode& table) {
  table.expect_keys(Names{"up", "height", "waves"});
  WaterPlane water;
  if (const TomlNode* up = table.find("up")) water.up = direction_of(*up);
  if (const TomlNode* height = table.find("height")) water.height = height->finite_number();
  if (const TomlNode* waves = table.find("waves")) {
    if (waves->kind != TomlNode::Kind::kList)
      waves->refuse("a list of [amplitude, k_x, k_y, phase]");
    const std::string fault = too_many(waves->items.size());
    if (!fault.empty()) throw Error(waves->place + waves->path + ": " + fault);
    for (const TomlNode& wave : waves->items) water.waves.push_back(wave_of(wave));
  }
  return water;
}

Rgb<double> light_of(const TomlNode& node) {
  const std::vector<double> c = node.finite_numbers(3);
  const auto in_range = [](double x) { return x >= 0 && x <= Sun::kBrightest; };
  if (!std::all_of(c.begin(), c.end(), in_range)) node.refuse("three numbers of 0 ... 1e9");
  return {c[0], c[1], c[2]};
}

SkyLight sky_of(const TomlNode& table) {
  table.expect_keys(Names{"radiance"});
  const TomlNode* radiance = table.find("radiance");
  if (!radiance) throw Error(table.place + "sky: expected its radiance, three numbers");
  return {light_of(*radiance)};
}

Sun sun_of(const TomlNode& table) {
  table.expect_keys(Names{"direction", "color", "diameter"});
  Sun sun;
  const TomlNode* direction = table.find("direction");
  if (!direction) throw Error(table.place + "sun: expected a direction towards the sun");
  sun.direction = direction_of(*direction);
  if (const TomlNode* color = table.find("color")) sun.color = light_of(*color);
  if (const TomlNode* diameter = table.find("diameter")) {
    sun.diameter = diameter->finite_number();
    if (!(sun.diameter >= Sun::kNarrowest && sun.diameter <= Sun::kWidest)) {
      diameter->refuse("a number of degrees, 0.01 ... 90");
    }
  }
  return sun;
}

fs::path path_of(const TomlNode& node, const fs::path& folder) {
  if (node.word().empty()) node.refuse("FILE");
  return (folder / node.word()).lexically_normal();
}

/// "FILE" or "FILE:CHANNELS" of a role.
std::string plate_of(const TomlNode& node, const fs::path& folder) {
  const PlateName name = split_plate(node.word());
  if (name.file.empty() || node.text.back() == ':') node.refuse("FILE or FILE:CHANNELS");
  const std::string file = (folder / name.file).lexically_normal().string();
  return name.channels.empty() ? file : file + ":" + name.channels;
}

void read_plates(const TomlNode& table, const fs::path& folder, SceneFile& file) {
  Names known = {"environment", "environment_rotation"};
  for (const Role& role : roles()) known.emplace_back(role.name);
  table.expect_keys(known);
  for (const TomlNode& node : table.items) {
    if (node.key == "environment") {
      file.environment = path_of(node, folder);
    } else if (node.key == "environment_rotation") {
      if (!table.find("environment")) {
        throw Error(node.key_place + node.path + ": expected an environment beside it");
      }
      file.environment_rotation = node.finite_number() * std::numbers::pi / 180;
    } else {
      file.plates[node.key] = plate_of(node, folder);
    }
  }
}

fs::path geometry_of(const TomlNode& table, const fs::path& folder) {
  table.expect_keys(Names{"gltf"});
  const TomlNode* gltf = table.find("gltf");
  if (!gltf) throw Error(table.place + "geometry: expected gltf = FILE");
  return (folder / gltf->word()).lexically_normal();
}

/// What the file says of near and far, whatever they are used for.
void read_range(const TomlNode& table, SceneFile& file) {
  const TomlNode* near = table.find("near");
  const TomlNode* far = table.find("far");
  if (near) file.near = near->finite_number();
  if (!far) return;
  if (far->kind != TomlNode::Kind::kNumber || std::isnan(far->number)) {
    far->refuse("a number or inf");
  }
  file.far = far->number;
  if (!(*file.far > file.near.value_or(-std::numeric_limits<double>::infinity()))) {
    far->refuse(near ? "more than near" : "a number or inf");
  }
}

void read_depth(const TomlNode& table, SceneFile& file) {
  const TomlNode* node = table.find("depth");
  if (!node) return;
  file.depth = static_cast<DepthKind>(node->choice(kDepths));
  const bool finite_range = file.near && file.far && std::isfinite(*file.far);
  if (file.depth == DepthKind::kNormalised && !finite_range) {
    node->refuse("near and a finite far beside it");
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

/// The one key of the table that says how the camera projects, or nullptr.
const TomlNode* lens_node(const TomlNode& table, CameraSpec& spec) {
  const TomlNode* found = nullptr;
  for (const LensKey& key : kLensKeys) {
    const TomlNode* node = table.find(key.name);
    if (!node) continue;
    if (found) {
      throw Error(node->key_place + node->path + " and " + found->path + ": expected only one of " +
                  kLensNames);
    }
    found = node;
    spec.lens = key.lens;
  }
  return found;
}

double field_of_view_of(const TomlNode& node) {
  const double degrees = node.finite_number();
  if (!(degrees > 0 && degrees < 180)) node.refuse("degrees above 0 and below 180");
  return degrees * std::numbers::pi / 180;
}

void read_lens(const TomlNode& node, const TomlNode& table, const SceneFile& file,
               CameraSpec& spec) {
  if (spec.lens == CameraSpec::Lens::kProjection) {
    spec.projection = matrix_of(node);
    return;
  }
  const bool flat = spec.lens == CameraSpec::Lens::kOrthographic;
  spec.extent = flat ? node.finite_number() : field_of_view_of(node);
  if (file.depth == DepthKind::kDevice && !(file.near && file.far)) {
    table.find("depth")->refuse("near and far beside " + node.key);
  }
  spec.near = file.near.value_or(flat ? 0 : 0.01);
  spec.far = file.far.value_or(flat ? spec.near + 1e4 : std::numeric_limits<double>::infinity());
}

std::optional<CameraSpec> camera_of(const TomlNode& table, const SceneFile& file) {
  CameraSpec spec;
  const TomlNode* view = table.find("view");
  const TomlNode* lens = lens_node(table, spec);
  const TomlNode* clip = table.find("clip");
  if (!view && !lens) {
    if (clip) throw Error(clip->key_place + "camera.clip without a projection that it could be of");
    return std::nullopt;
  }
  if (!lens)
    throw Error(view->key_place + "camera.view: expected one of " + kLensNames + " beside it");
  if (!view) throw Error(lens->key_place + lens->path + ": expected a view beside it");
  if (clip) spec.clip = static_cast<ClipSpace>(clip->choice(kClips));
  spec.view = matrix_of(*view);
  at_place(view->place, [&] {
    Camera{spec.view, perspective(1, 1, 1, 2, ClipSpace::kGl), ClipSpace::kGl}.validate();
  });
  read_lens(*lens, table, file, spec);
  at_place(lens->place, [&] { camera_for(spec, {1, 1}); });
  return spec;
}

void read_camera(const TomlNode& table, SceneFile& file) {
  table.expect_keys(Names{"view", "projection", "fov_x", "fov_y", "orthographic", "clip", "near",
                          "far", "depth", "depth_nothing"});
  if (const TomlNode* nothing = table.find("depth_nothing")) {
    file.depth_nothing = nothing->finite_number();
  }
  read_range(table, file);
  read_depth(table, file);
  file.camera = camera_of(table, file);
}

SceneFile scene_of(const TomlNode& root, const fs::path& folder) {
  root.expect_keys(Names{"geometry", "plates", "camera", "water", "sun", "sky", "scene"});
  SceneFile file;
  for (const TomlNode& table : root.items) {
    if (table.key == "geometry") file.geometry = geometry_of(table, folder);
    if (table.key == "plates") read_plates(table, folder, file);
    if (table.key == "camera") read_camera(table, file);
    if (table.key == "water") file.scene.water = water_of(table);
    if (table.key == "sun") file.scene.sun = sun_of(table);
    if (table.key == "sky") file.scene.sky = sky_of(table);
    if (table.key == "scene") {
      table.expect_keys(Names{"time"});
      if (const TomlNode* time = table.find("time")) {
        file.time = file.scene.time = time->finite_number();
      }
    }
  }
  return file;
}

std::string list_text(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (double x : numbers) texts.push_back(toml_text(x));
  return "[" + join(texts) + "]";
}

std::string matrix_text(const glm::dmat4& m) {
  std::vector<std::string> rows;
  for (int r = 0; r < 4; ++r) rows.push_back(list_text({m[0][r], m[1][r], m[2][r], m[3][r]}));
  return "[" + join(rows) + "]";
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
  std::string text = "[scene]\ntime = " + toml_text(scene.time) + "\n";
  if (scene.camera) {
    text += "[camera]\nview = " + matrix_text(scene.camera->view) +
            "\nprojection = " + matrix_text(scene.camera->projection) + "\nclip = \"" +
            std::string(kClips[static_cast<std::size_t>(scene.camera->clip)]) + "\"\n";
  }
  if (scene.water) {
    const WaterPlane& water = *scene.water;
    const std::string fault = too_many(water.waves.size());
    if (!fault.empty()) throw Error("water.waves: " + fault);
    std::vector<std::string> waves;
    for (const SineWave& wave : water.waves) waves.push_back(list_text(wave.to_row()));
    text += "[water]\nup = " + list_text({water.up.x, water.up.y, water.up.z}) +
            "\nheight = " + toml_text(water.height) + "\nwaves = [" + join(waves) + "]\n";
  }
  if (scene.sun) {
    const glm::dvec3& d = scene.sun->direction;
    const Rgb<double>& c = scene.sun->color;
    text += "[sun]\ndirection = " + list_text({d.x, d.y, d.z}) +
            "\ncolor = " + list_text({c.r, c.g, c.b}) +
            "\ndiameter = " + toml_text(scene.sun->diameter) + "\n";
  }
  if (scene.sky) {
    const Rgb<double>& c = scene.sky->radiance;
    text += "[sky]\nradiance = " + list_text({c.r, c.g, c.b}) + "\n";
  }
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
