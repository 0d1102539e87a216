#include "fuzz/read_exr.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "limpid/files/exr/deep.h"
#include "limpid/files/exr/exr_camera.h"
#include "limpid/plate/inspect.h"

#include "fuzz/harness.h"

namespace limpid::fuzz {
namespace {

constexpr std::size_t kAtOnce = 4;  // channels

void inspect(const ExrFile& file) {
  const InspectedFile files[] = {{file.path().string(), file.parts()}};
  const std::vector<LayerSource> sources = layer_sources(0, files[0].name, file.parts());
  for (const Role& role : roles()) {
    LayerChoices choices;
    accepts([&] {
      if (const auto choice = find_layer(role, sources)) choices.emplace(role.name, *choice);
    });
    expect(!inspect_text(files, choices).empty(), "there is something to say of a file");
  }
}

void read_attributes(const ExrFile& file, int part) {
  accepts([&] { camera_of(file, part); });
  for (const auto& [name, attribute] : file.attributes(part)) {
    file.matrix_attribute(part, name);
    file.number_attribute(part, name);
    file.text_attribute(part, name);
  }
}

void read_deep(const ExrFile& file, int index) {
  const ExrPart& part = file.parts()[index];
  std::vector<std::string> names;
  for (const ExrChannel& channel : part.channels) names.push_back(channel.name);
  std::int64_t pixels = 0;
  file.read_deep(index, names, [&](const DeepBlock& block) {
    pixels += block.window.area();
    expect(block.first.size() == static_cast<std::size_t>(block.window.area()) + 1,
           "each pixel of a deep block has its samples");
    for (const std::vector<float>& values : block.values) {
      expect(values.size() == block.first.back(), "each sample has a value");
    }
  });
  expect(pixels == part.data.area(), "deep blocks cover the data window once");
  Plane surface(part.data);
  for (int y = part.data.y0; y < part.data.y1; ++y) {
    std::fill_n(&surface.view().at(part.data.x0, y), part.data.width(), 1.0f);
  }
  accepts([&] { read_deep_layers(file, index, std::as_const(surface).view()); });
}

void read_flat(const ExrFile& file, int index) {
  const ExrPart& part = file.parts()[index];
  for (std::size_t first = 0; first < part.channels.size(); first += kAtOnce) {
    std::vector<Plane> planes;
    std::vector<ExrRequest> requests;
    const std::size_t end = std::min(first + kAtOnce, part.channels.size());
    for (std::size_t c = first; c < end; ++c) {
      planes.emplace_back(part.data);
      requests.push_back({index, part.channels[c].name, planes.back().view()});
    }
    file.read(requests);
  }
}

}  // namespace

void read_exr(const std::filesystem::path& path, const Limits& limits) {
  const ExrFile file = ExrFile::open(path, limits);
  inspect(file);
  for (int part = 0; part < static_cast<int>(file.parts().size()); ++part) {
    read_attributes(file, part);
    file.parts()[part].deep ? read_deep(file, part) : read_flat(file, part);
  }
}

}  // namespace limpid::fuzz
