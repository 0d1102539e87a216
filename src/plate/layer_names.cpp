#include "plate/layer_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <tuple>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr std::array<const char*, 2> kViews = {"left", "right"};
constexpr std::array<std::string_view, 2> kWaterWords = {"water", "surface"};
constexpr std::array<std::string_view, 11> kComponents = {"r", "g", "b",  "a",  "x", "y",
                                                          "z", "v", "nx", "ny", "nz"};

bool contains(const auto& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
/// Bytes of UTF-8 beyond ASCII count as letters.
bool is_letter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalpha(byte) != 0;
}

/// The channel of the group with this component, or "".
std::string channel_of(const LayerGroup& group, std::string_view component) {
  const std::string plain = plain_component(component);
  for (const std::string& channel : group.channels) {
    if (plain_component(split_channel(channel).component) == plain) return channel;
  }
  return "";
}

/// Distinguishes the Z of a depth from that of a vector.
bool is_vector_part(std::string_view component, const LayerGroup& group) {
  return (component == "Z" || component == "Y") && !channel_of(group, "X").empty();
}

std::vector<std::string> pick(std::string_view alternatives, const LayerGroup& group) {
  for (std::string_view alternative : split(alternatives, "|")) {
    if (alternative == "*") {
      if (group.channels.size() == 1) return group.channels;
      continue;
    }
    const std::vector<std::string_view> components = split(alternative, " ");
    if (components.size() == 1 && is_vector_part(components[0], group)) continue;
    std::vector<std::string> channels;
    for (std::string_view component : components) channels.push_back(channel_of(group, component));
    if (!contains(channels, "")) return channels;
  }
  return {};
}

bool one_of(std::string_view name, std::string_view alternatives) {
  return contains(split(alternatives, "|"), name);
}

/// Whether the file's words include all words of one alternative, and both or neither name the
/// water.
bool name_has(const std::vector<std::string>& file_words, std::string_view alternatives) {
  for (std::string_view alternative : split(alternatives, "|")) {
    const std::vector<std::string_view> wanted = split(alternative, " ");
    const auto in_file = [&](std::string_view word) { return contains(file_words, word); };
    if (std::all_of(wanted.begin(), wanted.end(), in_file) &&
        contains(wanted, "water") == in_file("water")) {
      return true;
    }
  }
  return false;
}

/// `topic` with "water" in front, as the rules spell it.
std::string with_water(const LayerGroup& group) {
  if (!group.water) return group.topic;
  return group.topic.empty() ? "water" : "water " + group.topic;
}

/// A view name used in a file.
struct ViewName {
  std::string name, lower;
  std::vector<std::string> words;

  ViewName(const std::string& view) : name(view), lower(lower_case(view)), words(words_of(view)) {}
};
using ViewNames = std::vector<ViewName>;

void add_view(ViewNames& views, const std::string& view) {
  const std::string lower = lower_case(view);
  const auto same = [&](const ViewName& other) { return other.lower == lower; };
  if (!view.empty() && std::none_of(views.begin(), views.end(), same)) views.emplace_back(view);
}

/// The view names of attributes, in their spelling, and names that need no attribute.
std::map<int, ViewNames> views_by_file(std::span<const LayerSource> sources) {
  std::map<int, ViewNames> views;
  for (const LayerSource& source : sources) {
    for (const std::string& view : source.views) add_view(views[source.file], view);
    add_view(views[source.file], source.view);
  }
  for (const LayerSource& source : sources) {
    for (const char* view : kViews) add_view(views[source.file], view);
  }
  return views;
}

void set_view(LayerGroup& group, const ViewName& view) {
  if (group.view.empty()) group.view = view.name;
}

void read_words(std::vector<std::string> words, LayerGroup& group) {
  const auto is_water = [](const std::string& word) { return contains(kWaterWords, word); };
  if (std::erase_if(words, is_water) > 0) group.water = true;
  group.topic = join(words, " ");
  group.named = true;
}

/// "depth_left": the name of a known layer followed or preceded by a view's name.
bool read_with_view(const std::vector<std::string>& words, const ViewNames& views,
                    LayerGroup& group) {
  const auto [topic, water, named] = std::tuple(group.topic, group.water, group.named);
  for (const ViewName& view : views) {
    if (view.words.empty() || words.size() <= view.words.size()) continue;
    const auto length = std::ssize(view.words);
    for (const auto first : {words.end() - length, words.begin()}) {
      if (!std::equal(first, first + length, view.words.begin())) continue;
      std::vector<std::string> rest(words.begin(), first);
      rest.insert(rest.end(), first + length, words.end());
      read_words(std::move(rest), group);
      if (is_known(group)) {
        set_view(group, view);
        return true;
      }
      std::tie(group.topic, group.water, group.named) = std::tie(topic, water, named);
    }
  }
  return false;
}

/// Parses a dotted name: its last part is the topic, a part with a view's name is the view, and any
/// part may name the water.
void read_name(std::string_view name, const ViewNames& views, LayerGroup& group) {
  for (std::string_view part : split(name, "./")) {
    if (part.empty()) continue;
    const auto view = std::find_if(views.begin(), views.end(),
                                   [&](const ViewName& v) { return v.lower == lower_case(part); });
    if (view != views.end()) {
      set_view(group, *view);
      continue;
    }
    const std::vector<std::string> words = words_of(part);
    if (!read_with_view(words, views, group)) read_words(words, group);
  }
}

/// The file's name counts only if the file holds one kind of channel. A picture may be named after
/// the water that it will get, so a layer's name counts more.
void read_file_name(LayerGroup& group) {
  if (!channel_of(group, "R").empty() && !channel_of(group, "Z").empty()) return;
  std::string_view stem = group.source->file_name;
  if (lower_case(stem).ends_with(".exr")) stem.remove_suffix(4);
  std::vector<std::string> words = words_of(stem);
  std::replace(words.begin(), words.end(), std::string("surface"), std::string("water"));
  if (group.named && is_known(group, "color")) return;
  if (contains(words, "water")) group.water = true;
  if (group.named) return;
  for (const LayerRule& rule : layer_rules()) {
    if (rule.rank != LayerRank::kFileName || !name_has(words, rule.layer)) continue;
    if (pick(rule.channels, group).empty()) continue;
    group.file_rule = &rule;
    return;
  }
}

/// Whether R G B of a part may be the picture, although no convention knows the part's name.
bool may_be_picture(const LayerGroup& group) {
  if (!group.path.empty() || group.source->part_name.empty() || group.water || is_known(group) ||
      channel_of(group, "R").empty()) {
    return false;
  }
  const std::vector<std::string> words = words_of(group.topic);
  const auto names_other = [&](const LayerRule& rule) {
    return rule.rank == LayerRank::kFileName && rule.role.empty() && name_has(words, rule.layer);
  };
  return std::none_of(layer_rules().begin(), layer_rules().end(), names_other);
}

}  // namespace

ChannelName split_channel(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return {"", std::string(name)};
  return {std::string(name.substr(0, dot)), std::string(name.substr(dot + 1))};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string plain_component(std::string_view component) {
  const std::string lower = lower_case(component);
  for (std::string_view color : {"red", "green", "blue", "alpha"}) {
    if (lower == color) return lower.substr(0, 1);
  }
  return lower;
}

void sort_components(std::vector<std::string>& components) {
  const auto place = [](const std::string& component) {
    return std::find(kComponents.begin(), kComponents.end(), plain_component(component));
  };
  std::stable_sort(components.begin(), components.end(),
                   [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  char before = ' ';
  for (char c : text) {
    const bool in_word = is_letter(c) || is_digit(c);
    const bool goes_on =
        is_digit(c) ? is_digit(before) : is_letter(before) && (is_upper(before) || !is_upper(c));
    if (in_word && !goes_on) words.emplace_back();
    if (in_word) words.back() += lower_case({&c, 1});
    before = c;
  }
  return words;
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find_first_of(separators);
    const std::string_view part = text.substr(0, end);
    const std::size_t first = part.find_first_not_of(' ');
    if (first == std::string_view::npos) {
      parts.emplace_back();
    } else {
      parts.push_back(part.substr(first, part.find_last_not_of(' ') - first + 1));
    }
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

bool agrees(Agreement agreement, const std::string& name, std::string_view typed) {
  if (name.empty() || typed.empty()) return false;
  switch (agreement) {
    case Agreement::kExact:
      return name == typed;
    case Agreement::kLetterCase:
      return lower_case(name) == lower_case(typed);
    case Agreement::kEnding:
      return lower_case(name).ends_with("." + lower_case(typed));
  }
  return false;
}

std::string with_part(const LayerGroup& group, const std::string& name) {
  const std::string& part = group.source->part_name;
  return part.empty() || name.empty() ? "" : part + "." + name;
}

bool is_known(const LayerGroup& group, std::string_view role) {
  for (const LayerRule& rule : layer_rules()) {
    if (rule.rank == LayerRank::kLayer && (role.empty() || rule.role == role) &&
        one_of(with_water(group), rule.layer)) {
      return true;
    }
  }
  return false;
}

std::vector<LayerGroup> group_layers(std::span<const LayerSource> sources) {
  std::map<int, ViewNames> views = views_by_file(sources);
  std::vector<LayerGroup> groups;
  std::map<std::array<std::string, 2>, std::size_t> places;  // part and layer -> index in groups
  std::map<int, int> parts_of_file, groups_of_file;
  for (const LayerSource& source : sources) {
    ++parts_of_file[source.file];
    places.clear();
    for (const std::string& channel : source.channels) {
      const ChannelName name = split_channel(channel);
      const bool is_component = contains(kComponents, plain_component(name.component));
      const std::string loose = name.layer.empty() && !is_component ? channel : "";
      const auto [place, is_new] = places.try_emplace({name.layer, loose}, groups.size());
      if (is_new) {
        ++groups_of_file[source.file];
        LayerGroup group;
        group.source = &source;
        group.path = name.layer;
        group.view = source.view;
        groups.push_back(group);
      }
      groups[place->second].channels.push_back(channel);
    }
  }
  for (LayerGroup& group : groups) {
    const LayerSource& source = *group.source;
    const int file = source.file;
    const ViewNames& views_of_file = views[file];
    read_name(source.part_name, views_of_file, group);
    if (parts_of_file[file] == 1 && group.path.empty() && !is_known(group)) {
      group.named = false;  // the only part of a file may have any name
      group.topic.clear();
    }
    read_name(group.path, views_of_file, group);
    const ChannelName first = split_channel(group.channels[0]);
    if (group.path.empty() && !contains(kComponents, plain_component(first.component))) {
      read_name(group.channels[0], views_of_file, group);
    }
    if (group.view.empty() && !source.views.empty()) group.view = source.views.front();
    if (groups_of_file[file] == 1) read_file_name(group);
  }
  return groups;
}

std::vector<std::string> match(const LayerRule& rule, const LayerGroup& group) {
  const auto names_fit = [&] {
    switch (rule.rank) {
      case LayerRank::kOwn:
        return lower_case(group.path) == rule.layer &&
               group.water == rule.layer.starts_with("surface");
      case LayerRank::kLayer:
        return group.named && one_of(with_water(group), rule.layer);
      case LayerRank::kFileName:
        return group.file_rule == &rule;
      case LayerRank::kBare:
        return !group.named && group.file_rule == nullptr;
      case LayerRank::kPart:
        return may_be_picture(group);
      case LayerRank::kGiven:
        return one_of(group.topic, rule.layer);
    }
    return false;
  };
  return names_fit() ? pick(rule.channels, group) : std::vector<std::string>();
}

}  // namespace limpid
