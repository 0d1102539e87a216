#include "compared_picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/picture/preview.h"

#include "core/convert_color.h"
#include "plate/primaries.h"

namespace limpid::tool {
namespace {

bool among(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string component_of(const std::string& channel) {
  return channel.substr(channel.rfind('.') + 1);
}

/// The channel of that name, else all channels of the layer of that name.
std::vector<std::string> named_in(const std::vector<std::string>& known, const std::string& name) {
  if (among(name, known)) return {name};
  std::vector<std::string> of_layer;
  for (const std::string& channel : known) {
    if (!name.empty() && channel == name + "." + component_of(channel)) of_layer.push_back(channel);
  }
  return of_layer;
}

/// Throws Error if the picture has neither.
std::vector<std::string> expect_named(const std::string& path,
                                      const std::vector<std::string>& known,
                                      const std::string& name) {
  std::vector<std::string> named = named_in(known, name);
  if (!named.empty()) return named;
  throw Error(path + " has no channel or layer '" + name + "': there is " + join(known) +
              did_you_mean(name, known));
}

/// Pairs the channels of both by component; single channels are paired regardless of their names.
std::vector<ChannelPair> paired(const std::string& text, const std::vector<std::string>& a,
                                const std::vector<std::string>& b) {
  if (a.size() == 1 && b.size() == 1) return {{a[0], b[0]}};
  std::vector<ChannelPair> pairs;
  for (const std::string& channel : a) {
    const auto same = std::find_if(b.begin(), b.end(), [&](const std::string& other) {
      return component_of(other) == component_of(channel);
    });
    if (same != b.end()) pairs.push_back({channel, *same});
  }
  if (pairs.size() == a.size() && pairs.size() == b.size()) return pairs;
  throw Error("--channels " + text + ": " + join(a) + " cannot be compared with " + join(b) +
              ": expected the same components");
}

std::vector<ChannelPair> pairs_of(const std::string& text, const std::string& a,
                                  const std::vector<std::string>& known_a, const std::string& b,
                                  const std::vector<std::string>& known_b) {
  const std::size_t first = text.find('=');
  const bool whole = !named_in(known_a, text).empty() || !named_in(known_b, text).empty();
  if (whole || first == std::string::npos) {
    const std::vector<std::string> of_a = expect_named(a, known_a, text);
    return paired(text, of_a, expect_named(b, known_b, text));
  }
  // A name may hold an '=' itself.
  std::size_t split = first;
  for (std::size_t at = first; at != std::string::npos; at = text.find('=', at + 1)) {
    const bool fits = !named_in(known_a, text.substr(0, at)).empty() &&
                      !named_in(known_b, text.substr(at + 1)).empty();
    if (fits) split = at;
  }
  const std::vector<std::string> of_a = expect_named(a, known_a, text.substr(0, split));
  return paired(text, of_a, expect_named(b, known_b, text.substr(split + 1)));
}

/// The channel of that name, or the only channel of a layer; null if there is none.
const Plane* color_plane(const ComparedPicture& picture, const std::string& name) {
  if (const Plane* plane = picture.find(name)) return plane;
  const Plane* found = nullptr;
  for (std::size_t i = 0; i < picture.names.size(); ++i) {
    if (component_of(picture.names[i]) != name) continue;
    if (found != nullptr) return nullptr;
    found = &picture.planes[i];
  }
  return found;
}

/// The name of an EXR channel here: in all parts but the first with the part's name in front.
struct NamedChannel {
  std::string name;
  int part;
  std::string channel;
};

std::vector<NamedChannel> channels_named(const ExrFile& file) {
  std::vector<NamedChannel> channels;
  for (int part = 0; part < static_cast<int>(file.parts().size()); ++part) {
    const ExrPart& of = file.parts()[static_cast<std::size_t>(part)];
    if (part > 0 && of.deep) continue;
    for (const ExrChannel& channel : of.channels) {
      channels.push_back(
          {part > 0 ? of.name + "." + channel.name : channel.name, part, channel.name});
    }
  }
  return channels;
}

}  // namespace

std::vector<std::string> channel_names(const std::string& path, const Limits& limits) {
  if (!holds_exr(path)) return read_image(path, limits).channels;
  std::vector<std::string> names;
  const ExrFile file = ExrFile::open(path, limits);
  for (const NamedChannel& channel : channels_named(file)) names.push_back(channel.name);
  return names;
}

std::vector<ChannelPair> pairs_of(const std::vector<std::string>& texts, const std::string& a,
                                  const std::vector<std::string>& known_a, const std::string& b,
                                  const std::vector<std::string>& known_b) {
  std::vector<ChannelPair> pairs;
  for (const std::string& text : texts) {
    for (const ChannelPair& pair : pairs_of(text, a, known_a, b, known_b)) {
      if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
  }
  return pairs;
}

const Plane* ComparedPicture::find(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? nullptr : &planes[static_cast<std::size_t>(at - names.begin())];
}

ComparedPicture read_picture(const std::string& path, const std::vector<std::string>& wanted,
                             const Limits& limits) {
  const auto is_wanted = [&](const std::string& name, int part = 0) {
    return wanted.empty() ? part == 0 : among(name, wanted);
  };
  ComparedPicture picture;
  picture.path = path;
  std::vector<std::string> known;
  if (holds_exr(path)) {
    const ExrFile file = ExrFile::open(path, limits);
    picture.display = file.parts().front().display.size();
    std::vector<ExrRequest> requests;
    for (const NamedChannel& channel : channels_named(file)) {
      known.push_back(channel.name);
      if (!is_wanted(channel.name, channel.part)) continue;
      picture.names.push_back(channel.name);
      picture.planes.emplace_back(file.parts()[static_cast<std::size_t>(channel.part)].data);
      requests.push_back({channel.part, channel.channel, picture.planes.back().view(), 0});
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
  if (!holds_exr(path)) return false;
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
                join(b.names) + ": expected --channels with the channels to compare");
  }
  std::vector<ComparedChannel> channels;
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    channels.push_back({a.names[i], a.planes[i].view(), b.find(a.names[i])->view()});
  }
  return channels;
}

std::vector<ComparedChannel> channels_of(const ComparedPicture& a, const ComparedPicture& b,
                                         const std::vector<ChannelPair>& pairs) {
  std::vector<ComparedChannel> channels;
  for (const ChannelPair& pair : pairs) {
    const std::string name = pair.a == pair.b ? pair.a : pair.a + "=" + pair.b;
    channels.push_back({name, a.find(pair.a)->view(), b.find(pair.b)->view()});
  }
  return channels;
}

bool is_linear(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return holds_exr(path) || among(extension, {".hdr", ".rgbe", ".pfm"});
}

Primaries primaries_of(const std::string& path, const std::optional<Primaries>& named,
                       const Primaries& untold) {
  if (!is_linear(path)) return kRec709;
  return named ? *named : told_primaries(path).value_or(untold);
}

LinearColor::LinearColor(const ComparedPicture& picture, const std::optional<double>& clip,
                         const Primaries& from, const Primaries& to) {
  const bool decode = !is_linear(picture.path);
  const float most = clip ? static_cast<float>(*clip) : HUGE_VALF;
  const std::array<const char*, 3> names = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Plane* plane = color_plane(picture, names[c]);
    if (plane == nullptr) {
      throw Error(
          picture.path +
          ": metrics of color need the channels R, G and B, and the compared channels are " +
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
  convert_color({planes_[0].view(), planes_[1].view(), planes_[2].view()}, to, from);
}

PictureColor read_color(const std::string& path, const Primaries& to, const Limits& limits) {
  std::vector<std::string> wanted = {"R", "G", "B"};
  const std::vector<std::string> known = channel_names(path, limits);
  const bool plain = std::all_of(wanted.begin(), wanted.end(),
                                 [&](const std::string& name) { return among(name, known); });
  if (!plain) wanted.clear();  // channels of a layer, for any layer name
  const ComparedPicture picture = read_picture(path, wanted, limits);
  return {picture.display,
          LinearColor(picture, std::nullopt, primaries_of(path, {}, to), to).take()};
}

}  // namespace limpid::tool
