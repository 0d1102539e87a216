#include "tool/made_plate.h"

#include <cmath>
#include <deque>
#include <limits>
#include <sstream>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/scene.h"

namespace limpid::test {
namespace {

constexpr double kEyeHeight = 2, kBottom = -1, kShoreHeight = 0.2, kFarthest = 50;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Channels of one window, filled by functions of the pixel within the display window.
class Channels {
 public:
  explicit Channels(ExrOutput& output) : output_(output) {}

  template <class Fn>
  void add(const std::string& name, Fn&& value, bool half = true) {
    Plane& plane = planes_.emplace_back(output_.data);
    const Rect &w = output_.data, &display = output_.display;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        plane.view().at(x, y) = static_cast<float>(value(x - display.x0, y - display.y0));
      }
    }
    output_.channels.push_back({name, plane.view(), half});
  }

 private:
  ExrOutput& output_;
  std::deque<Plane> planes_;
};

std::array<float, 16> floats_of(const glm::dmat4& matrix) {
  std::array<float, 16> floats;
  for (int i = 0; i < 16; ++i) floats[i] = static_cast<float>(glm::value_ptr(matrix)[i]);
  return floats;
}

ExrFile::Attribute text_attribute(const std::string& text) {
  return {"string", {text.begin(), text.end()}};
}

/// The standard attributes of a camera: left-handed, NDC 0 ... 1 with y down.
void add_camera(ExrOutput& output, const Camera& camera) {
  const glm::dmat4 flip_z = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1));
  const glm::dmat4 unit_from_ndc = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.5, 0)) *
                                   glm::scale(glm::dmat4(1), glm::dvec3(0.5, -0.5, 1));
  output.matrices["worldToCamera"] = floats_of(flip_z * camera.view);
  output.matrices["worldToNDC"] = floats_of(unit_from_ndc * camera.projection * camera.view);
}

}  // namespace

Camera plate_camera(ClipSpace clip) {
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0, kEyeHeight, 0),
                            glm::dvec3(0, kEyeHeight - std::tan(glm::radians(20.0)), -1),
                            glm::dvec3(0, 1, 0));
  camera.projection = perspective(glm::radians(50.0), 64.0 / 36, 0.1, 100, clip);
  camera.clip = clip;
  return camera;
}

void write_plate(const std::filesystem::path& path, const PlateOptions& options) {
  const Camera camera = plate_camera();
  const Rays rays = rays_of(camera, {kPicture.width(), kPicture.height()});
  const auto ray = [&](int x, int y) { return rays.ray_at(x + 0.5, y + 0.5); };
  const auto depth = [&](int x, int y) {
    const double height = x < kShore ? kShoreHeight : kBottom;
    const double z = (height - kEyeHeight) / ray(x, y).y;
    return z > 0 && z < kFarthest ? z : kInfinity;
  };
  const auto breaks = [&](int x, int y, int at_x, double with, double otherwise) {
    return options.broken && x == at_x && y == 30 ? with : otherwise;
  };
  const auto wave = [](int x, int y, int c) {
    return 0.5 + 0.4 * std::sin(0.4 * x + c) * std::cos(0.3 * y - c);
  };

  ExrOutput output;
  output.data = options.data;
  output.display = options.display;
  Channels channels(output);
  if (options.color) {
    for (int c = 0; c < 3; ++c) {
      channels.add(std::string(1, "RGB"[c]), [&](int x, int y) {
        const double bad = c == 0 ? std::nan("") : kInfinity;
        const bool lit = options.lamp != 0 && x / 2 == 20 && y / 2 == 2;
        return breaks(x, y, c == 2 ? -1 : 40 + c, bad, lit ? options.lamp : wave(x, y, c));
      });
    }
    channels.add("A", [](int, int y) { return y < 3 ? 0.5 : 1; });
  }
  if (options.depth) {
    const auto code = [&](int x, int y) {
      const double z = options.depth_code(depth(x, y), glm::length(ray(x, y)));
      return breaks(x, y, 42, std::nan(""), z);
    };
    channels.add("depth.Z", code, false);
  }
  channels.add("shadow.Y", [&](int x, int y) {
    return breaks(x, y, 43, std::nan(""), (x / 8 + y / 6) % 2 == 0 ? 1 : 0.25);
  });
  for (int c = 0; c < 3; ++c) {
    channels.add(std::string("reflection.") + "RGB"[c],
                 [&](int x, int y) { return 0.3 + 0.2 * wave(y, x, c) + 0.1 * c; });
  }
  output.inherited = {{"pond/studio", text_attribute("shallow end")},
                      {"shot/take", text_attribute("12b")}};
  if (options.camera) add_camera(output, camera);
  write_exr(path, output);
}

void write_waves(const std::filesystem::path& path) {
  const double turn = 2 * std::acos(-1.0) / 16;
  ExrOutput output;
  output.data = output.display = {0, 0, 16, 16};
  Channels channels(output);
  channels.add("R", [=](int x, int y) { return 0.5 + 0.15 * std::sin(turn * (x + 2 * y)); });
  channels.add("G", [=](int x, int y) { return 0.5 + 0.15 * std::cos(turn * (3 * x - y)); });
  channels.add("B", [](int, int) { return 0.97; });
  write_exr(path, output);
}

std::string scene_toml(const std::string& more) {
  const glm::dmat4 view = plate_camera().view;
  std::ostringstream rows;
  rows.precision(17);
  for (int r = 0; r < 4; ++r) {
    rows << (r == 0 ? "[" : ", [") << std::fixed << view[0][r] << ", " << view[1][r] << ", "
         << view[2][r] << ", " << view[3][r] << "]";
  }
  return "[camera]\nview = [" + rows.str() + "]\nfov_y = 50\n" + more +
         "\n[water]\nup = [0, 1, 0]\nheight = 0.0\n\n[sun]\ndirection = [0, 0.5, -0.9]\n"
         "color = [3, 2.8, 2.5]\n";
}

std::string look_toml() {
  return "[wave_normals]\nmodel = \"four_maps\"\nmap = \"waves.exr\"\ntile_size = 3.0\n\n"
         "[refraction]\nmodel = \"normal_offset\"\nrejection = \"snap\"\noff_frame = "
         "\"clamp\"\nstrength = 0.03\n\n"
         "[prism_split]\nmodel = \"axis\"\nstrength = 0.004\n\n"
         "[caustics]\nstrength = 0.0\nsunlight = \"straight\"\n\n"
         "[depth_fog]\nmodel = \"linear\"\ndistance = \"eye\"\ndensity = 0.15\n"
         "color = [0.02, 0.10, 0.12]\nalpha = 0.9\n\n"
         "[water_shadow]\nmodel = \"darken\"\nstrength = 0.5\n\n"
         "[fresnel_reflection]\nreflectance = \"schlick\"\nlookup = \"offset\"\nstrength = 0.02\n\n"
         "[sun_highlight]\nmodel = \"blinn_phong\"\npower = 20.0\nstrength = 0.5\n";
}

}  // namespace limpid::test
