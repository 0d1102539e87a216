#include "limpid/plate/texture.h"

#include <array>
#include <string>

#include "limpid/core/error.h"
#include "limpid/enter/sanitise.h"

#include "core/convert_color.h"
#include "plate/environment.h"
#include "plate/plate_file.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

/// `what` needs the channels, as in "a normal map"; for the Error.
LoadedTexture rgb_of(const PlateFile& file, const std::string& what) {
  const ExrPart& part = file.parts.front();
  const auto name_of = [&](std::string_view letter, std::size_t position) -> std::string {
    for (const ExrChannel& c : part.channels) {
      if (c.name == letter) return c.name;
    }
    return file.image && position < part.channels.size() ? part.channels[position].name : "";
  };
  LoadedTexture loaded;
  std::vector<ExrRequest> requests;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = name_of(std::array{"R", "G", "B"}[i], i);
    if (name.empty()) {
      throw Error(file.path.string() + ": " + what + " needs the channels R, G and B");
    }
    loaded.planes.emplace_back(part.data);
    requests.push_back({0, name, loaded.planes.back().view(), 0});
  }
  file.read(requests);
  for (std::size_t i = 0; i < 3; ++i) {
    sanitise_color(loaded.planes[i].view());
    loaded.texture.channels[i] = loaded.planes[i].view();
  }
  return loaded;
}

/// The layout by the shape of the picture, or by the attribute `envmap` if it has one.
EnvironmentLayout layout_of(const PlateFile& file) {
  const Rect& data = file.parts.front().data;
  const bool lat_long = data.width() == 2 * data.height(), cube = data.height() == 6 * data.width();
  std::string said;
  bool agrees = lat_long || cube;
  if (file.exr) {
    const auto attributes = file.exr->attributes(0);
    const auto found = attributes.find("envmap");
    if (found != attributes.end() && found->second.type == "envmap" &&
        found->second.bytes.size() == 1) {
      const bool says_cube = found->second.bytes[0] != 0;
      said =
          std::string("the attribute envmap says ") + (says_cube ? "cube" : "lat-long") + " and ";
      agrees = says_cube ? cube : lat_long;
    }
  }
  if (!agrees) {
    throw Error(file.path.string() + ": " + said + std::to_string(data.width()) + "x" +
                std::to_string(data.height()) +
                " pixels: expected a lat-long map, twice as wide as high, or the six faces of a "
                "cube, one below the other");
  }
  return cube ? EnvironmentLayout::kCube : EnvironmentLayout::kLatLong;
}

void check_size(const PlateFile& file, Size size, const Limits& limits) {
  const std::int64_t pixels = rect_of(size).area();
  if (pixels <= limits.max_pixels && pixels * 12 <= limits.max_memory) return;
  throw Error(file.path.string() + ": becomes a lat-long map of " + std::to_string(size.width) +
              "x" + std::to_string(size.height) + " pixels, more than the limit");
}

}  // namespace

LoadedTexture load_texture(const std::filesystem::path& path, const Limits& limits) {
  LoadedTexture loaded = rgb_of(PlateFile::open(path, limits), "a normal map");
  loaded.bytes = pack_bytes(loaded.texture);
  if (!loaded.bytes.empty()) loaded.texture.bytes = loaded.bytes.data();
  const auto levels = std::make_shared<LevelMaker>();
  levels->make(loaded.texture);
  loaded.texture.levels = &levels->levels();
  loaded.levels = levels;
  return loaded;
}

LoadedTexture load_environment(const std::filesystem::path& path, double rotation,
                               const Primaries& primaries, const Limits& limits) {
  const PlateFile file = PlateFile::open(path, limits);
  const EnvironmentLayout layout = layout_of(file);
  const int face = file.parts.front().data.width();
  if (layout == EnvironmentLayout::kCube) check_size(file, lat_long_of_cube(face), limits);
  LoadedTexture loaded = rgb_of(file, "an environment");
  loaded.planes = environment_planes(loaded.planes, layout, rotation);
  if (const auto told = told_primaries(path)) {
    convert_color({loaded.planes[0].view(), loaded.planes[1].view(), loaded.planes[2].view()},
                  primaries, *told);
  }
  for (std::size_t i = 0; i < 3; ++i) loaded.texture.channels[i] = loaded.planes[i].view();
  return loaded;
}

}  // namespace limpid
