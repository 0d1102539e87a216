#include "plate/pass_through.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "limpid/core/error.h"

#include "files/exr/exr_header.h"
#include "plate/layer_candidates.h"
#include "plate/layer_views.h"

namespace limpid {
namespace {

constexpr std::string_view kAll = "all";
constexpr std::string_view kCryptomatte = "cryptomatte/";

bool has_wildcard(const std::string& text) { return text.find_first_of("*?") != std::string::npos; }

/// Whether the text matches the pattern, in which * matches any characters and ? one.
bool fits_pattern(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] != '*') {
    return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
           fits_pattern(pattern.substr(1), text.substr(1));
  }
  while (pattern.size() > 1 && pattern[1] == '*') pattern.remove_prefix(1);
  for (std::size_t skipped = 0; skipped <= text.size(); ++skipped) {
    if (fits_pattern(pattern.substr(1), text.substr(skipped))) return true;
  }
  return false;
}

bool is_among(const std::string& word, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// "normals" of "normals.0012.exr".
std::string file_stem(const std::string& file_name) {
  std::string stem = file_name.substr(0, file_name.rfind('.'));
  const std::size_t end = stem.find_last_not_of("0123456789");
  if (end == std::string::npos) return stem;
  return stem.substr(0, end + (std::ispunct(static_cast<unsigned char>(stem[end])) ? 0 : 1));
}

std::string part_name_of(const LayerSource& source) {
  return source.part_name.empty() ? file_stem(source.file_name) : source.part_name;
}

/// A layer's whole name; for loose channels, their part's.
std::string layer_name(const LayerGroup& group) {
  return group.path.empty() ? group.source->part_name : group.path;
}

/// Whether the layer is one of the ranks of a cryptomatte of that name: "crypto00", "crypto01".
bool is_rank_of(const std::string& cryptomatte, const LayerGroup& group) {
  for (const std::string& name : {layer_name(group), with_part(group, group.path)}) {
    if (cryptomatte.empty() || !name.starts_with(cryptomatte)) continue;
    const std::string rank = name.substr(cryptomatte.size());
    if (std::all_of(rank.begin(), rank.end(), [](unsigned char c) { return std::isdigit(c); })) {
      return true;
    }
  }
  return false;
}

/// The attributes "cryptomatte/ID/..." of a file, by ID, and the name of each ID.
struct Manifest {
  std::string name;
  std::map<std::string, ExrFile::Attribute> attributes;
};
std::map<std::string, Manifest> manifests_of(const ExrFile& file) {
  std::map<std::string, Manifest> manifests;
  for (int part = 0; part < static_cast<int>(file.parts().size()); ++part) {
    for (const auto& [key, attribute] : file.attributes(part)) {
      const std::size_t end = key.find('/', kCryptomatte.size());
      if (!key.starts_with(kCryptomatte) || end == std::string::npos) continue;
      Manifest& manifest = manifests[key.substr(0, end)];
      manifest.attributes.emplace(key, attribute);
      if (key.substr(end) == "/name" && attribute.type == "string") {
        manifest.name = {attribute.bytes.begin(), attribute.bytes.end()};
      }
    }
  }
  return manifests;
}

/// The layers chosen for one output.
class Passing {
 public:
  explicit Passing(const PassingPlate& plate)
      : plate_(plate), groups_(group_layers(plate.sources)), color_(plate.roles.at("color")) {}

  void add(const std::string& name) { name == kAll ? add_all() : add_named(name); }

  /// Layers that feed no role and are not chosen.
  std::vector<std::string> others() const {
    std::vector<std::string> names;
    for (const LayerGroup& group : groups_) {
      const bool used = std::any_of(group.channels.begin(), group.channels.end(),
                                    [&](const std::string& c) { return feeds_role(group, c); });
      const std::string name = layer_name(group);
      if (used || !is_of_view(group) || group.source->deep || !exr_of(group)) continue;
      names.push_back(name.empty() ? join(group.channels, " ") : name);
    }
    return names;
  }

  std::vector<PassedPart> parts() const {
    std::vector<PassedPart> parts;
    for (const LayerSource& source : plate_.sources) {
      const auto found = chosen_.find({source.file, source.part});
      if (found == chosen_.end()) continue;
      PassedPart part;
      part.file = exr_of(source);
      part.part = source.part;
      part.of_color = is_color_part(source);
      part.name = part_name_of(source);
      for (const ExrChannel& channel : part.file->parts()[source.part].channels) {
        if (is_among(channel.name, found->second)) part.channels.push_back(channel.name);
      }
      if (!part.of_color) {
        part.attributes = part.file->attributes(source.part);
        std::erase_if(part.attributes, [](const auto& a) { return describes_content(a.first); });
      }
      add_manifests(source, found->second, part);
      parts.push_back(std::move(part));
    }
    tell_apart(parts);
    return parts;
  }

 private:
  const ExrFile* exr_of(const LayerSource& source) const {
    const PlateFile& file = plate_.files[static_cast<std::size_t>(source.file)];
    return file.exr ? &*file.exr : nullptr;
  }
  const ExrFile* exr_of(const LayerGroup& group) const { return exr_of(*group.source); }

  bool is_color_part(const LayerSource& source) const {
    const ChannelRef& color = color_.channels.front();
    return source.file == color.file && source.part == color.part;
  }

  bool is_of_view(const LayerGroup& group) const {
    return group.view.empty() || color_.view.empty() || is_same_view(group.view, color_.view);
  }

  static bool feeds(const LayerChoice& choice, const LayerGroup& group, const std::string& name) {
    const ChannelRef ref{group.source->file, group.source->part, name};
    return std::find(choice.channels.begin(), choice.channels.end(), ref) != choice.channels.end();
  }
  bool feeds_role(const LayerGroup& group, const std::string& name) const {
    return std::any_of(plate_.roles.begin(), plate_.roles.end(),
                       [&](const auto& role) { return feeds(role.second, group, name); });
  }

  void choose(const LayerGroup& group, const std::string& channel) {
    std::vector<std::string>& names = chosen_[{group.source->file, group.source->part}];
    if (!is_among(channel, names)) names.push_back(channel);
  }

  /// Chooses every layer except the color, which the picture replaces.
  void add_all() {
    for (const LayerGroup& group : groups_) {
      if (!is_of_view(group) || !exr_of(group)) continue;
      expect_flat(group);
      for (const std::string& channel : group.channels) {
        if (!feeds(color_, group, channel)) choose(group, channel);
      }
    }
  }

  void add_named(const std::string& typed) {
    if (add_where(typed, [&](const std::string& name) {
          return has_wildcard(typed) && fits_pattern(lower_case(typed), lower_case(name));
        })) {
      return;
    }
    for (const Agreement agreement : kAgreements) {
      if (add_where(typed,
                    [&](const std::string& name) { return agrees(agreement, name, typed); })) {
        return;
      }
    }
    const std::vector<std::string> known = known_names();
    throw Error("no layer or channel '" + typed + "' to pass through: there is " +
                    layer_list(groups_, plate_.sources) + did_you_mean(typed, known),
                Fault::kUsage);
  }

  /// Chooses the layers and channels whose names fit; returns whether there are any.
  template <class Fits>
  bool add_where(const std::string& typed, const Fits& fits) {
    bool any = false;
    for (const LayerGroup& group : groups_) {
      if (!is_of_view(group)) continue;
      const bool whole = fits(layer_name(group)) || fits(with_part(group, group.path)) ||
                         fits(part_name_of(*group.source)) || is_cryptomatte(typed, group);
      for (const std::string& channel : group.channels) {
        if (!whole && !fits(channel) && !fits(with_part(group, channel))) continue;
        expect_flat(group);
        choose(group, channel);
        any = true;
      }
    }
    return any;
  }

  /// Whether it is a rank of the cryptomatte of that name in the file.
  bool is_cryptomatte(const std::string& typed, const LayerGroup& group) const {
    if (!exr_of(group)) return false;
    const auto manifests = manifests_of(*exr_of(group));
    return std::any_of(manifests.begin(), manifests.end(), [&](const auto& manifest) {
      const std::string& name = manifest.second.name;
      return is_rank_of(name, group) &&
             std::any_of(std::begin(kAgreements), std::end(kAgreements),
                         [&](Agreement agreement) { return agrees(agreement, name, typed); });
    });
  }

  void expect_flat(const LayerGroup& group) const {
    const std::string file = group.source->file_name;
    if (!exr_of(group)) {
      throw Error(file + ": is not an EXR: expected layers of an EXR to pass through",
                  Fault::kUsage);
    }
    if (group.source->deep) {
      throw Error(file + ", part " + std::to_string(group.source->part) +
                      ": holds deep samples, which are not passed through: expected names of flat "
                      "layers, or none",
                  Fault::kUsage);
    }
  }

  std::vector<std::string> known_names() const {
    std::vector<std::string> known;
    for (const LayerGroup& group : groups_) {
      known.push_back(layer_name(group));
      known.insert(known.end(), group.channels.begin(), group.channels.end());
    }
    return known;
  }

  void add_manifests(const LayerSource& source, const std::vector<std::string>& channels,
                     PassedPart& part) const {
    for (const auto& found : manifests_of(*part.file)) {
      const auto& manifest = found.second;
      const bool passed = std::any_of(groups_.begin(), groups_.end(), [&](const LayerGroup& g) {
        return g.source->file == source.file && g.source->part == source.part &&
               is_rank_of(manifest.name, g) && is_among(g.channels.front(), channels);
      });
      if (passed) part.attributes.insert(manifest.attributes.begin(), manifest.attributes.end());
    }
  }

  /// Parts of several files may have the same name: all but the first then get their file's name in
  /// front.
  static void tell_apart(std::vector<PassedPart>& parts) {
    std::vector<std::string> names;
    for (PassedPart& part : parts) {
      if (is_among(part.name, names)) {
        part.name = file_stem(part.file->path().filename().string()) + "." + part.name;
      }
      names.push_back(part.name);
    }
  }

  const PassingPlate& plate_;
  std::vector<LayerGroup> groups_;
  const LayerChoice& color_;
  std::map<std::pair<int, int>, std::vector<std::string>> chosen_;  ///< channels, by file and part
};

}  // namespace

std::vector<PassedPart> passed_parts(const PassingPlate& plate,
                                     const std::vector<std::string>& names) {
  Passing passing(plate);
  for (const std::string& name : names) passing.add(name);
  return passing.parts();
}

std::vector<std::string> other_layers(const PassingPlate& plate) { return Passing(plate).others(); }

}  // namespace limpid
