#include "compared_picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "limpid/core/error.h"
#include "limpid/load/exr_file.h"
#include "limpid/load/image_file.h"
#include "limpid/write/preview.h"

namespace limpid::tool {
namespace {

bool among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_linear(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return among(extension, {".exr", ".hdr", ".rgbe", ".pfm"});
}

}  // namespace

const Plane* ComparedPicture::find(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? nullptr : &planes[static_cast<std::size_t>(at - names.begin())];
}

ComparedPicture read_picture(const std::string& path, const std::vector<std::string>& wanted,
                             const Limits& limits) {
  const auto is_wanted = [&](const std::string& name) {
    return wanted.empty() || among(name, wanted);
  };
  ComparedPicture picture;
  picture.path = path;
  std::vector<std::string> known;
  if (is_exr(path)) {
    const ExrFile file = ExrFile::open(path, limits);
    const ExrPart& part = file.parts().front();
    picture.display = part.display.size();
    std::vector<ExrRequest> requests;
    for (const ExrChannel& channel : part.channels) {
      known.push_back(channel.name);
      if (!is_wanted(channel.name)) continue;
      picture.names.push_back(channel.name);
      picture.planes.emplace_back(part.data);
      requests.push_back({0, channel.name, picture.planes.back().view(), 0});
    }
    file.read(requests);
  } else {
    ImageFile image = read_image(path, limits);
    picture.display = image.window.size();
    known = image.channels;
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
      if (!is_wanted(image.channels[i])) continue;
      picture.names.push_back(image.channels[i]);
      picture.planes.push_back(std::move(image.planes[i]));
    }
  }
  for (const std::string& name : wanted) {
    if (!among(name, known)) {
      throw Error(path + " has no channel '" + name + "': there is " + join(known) +
                  did_you_mean(name, known));
    }
  }
  return picture;
}

bool has_channel(const std::string& path, const std::string& name) {
  if (!is_exr(path)) return false;
  const ExrFile file = ExrFile::open(path);
  const std::vector<ExrChannel>& channels = file.parts().front().channels;
  return std::any_of(channels.begin(), channels.end(),
                     [&](const ExrChannel& channel) { return channel.name == name; });
}

std::vector<ComparedChannel> channels_of(const ComparedPicture& a, const ComparedPicture& b) {
  std::vector<std::string> a_names = a.names, b_names = b.names;
  std::sort(a_names.begin(), a_names.end());
  std::sort(b_names.begin(), b_names.end());
  if (a_names != b_names) {
    throw Error(a.path + " has the channels " + join(a.names) + " and " + b.path + " has " +
                join(b.names) + ": name those to compare with --channels");
  }
  std::vector<ComparedChannel> channels;
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    channels.push_back({a.names[i], a.planes[i].view(), b.find(a.names[i])->view()});
  }
  return channels;
}

LinearColor::LinearColor(const ComparedPicture& picture, const std::optional<double>& clip) {
  const bool decode = !is_linear(picture.path);
  const float most = clip ? static_cast<float>(*clip) : HUGE_VALF;
  const std::array<const char*, 3> names = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Plane* plane = picture.find(names[c]);
    if (plane == nullptr) {
      throw Error(picture.path +
                  ": metrics of color need the channels R, G, B among those that are "
                  "compared, which are " +
                  join(picture.names));
    }
    const Rect window = plane->view().window;
    planes_[c] = Plane(window);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const float value = plane->view().at(x, y);
        const float linear = decode ? linear_from_srgb(value) : value;
        planes_[c].view().at(x, y) = linear > most ? most : linear;  // NaN stays
      }
    }
  }
}

}  // namespace limpid::tool
