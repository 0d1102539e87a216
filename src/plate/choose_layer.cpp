#include <algorithm>

#include "limpid/core/error.h"
#include "limpid/plate/layers.h"

#include "plate/layer_candidates.h"
#include "plate/layer_views.h"

namespace limpid {
namespace {

constexpr const char* kReason = "named for the buffer";

/// One override: `text` names a layer or channels for `role`, in these sources.
class Choosing {
 public:
  Choosing(const Role& role, std::string_view text, std::span<const LayerSource> sources,
           const std::string& view)
      : role_(role), text_(text), sources_(sources), groups_(group_layers(sources)), asked_(view) {}

  LayerChoice choose() const {
    if (text_.empty()) return whole_file();
    if (std::optional<Candidate> one = named(text_)) return checked(*one);
    const std::vector<std::string_view> names = split(text_, ",");
    if (names.size() == 1) fail_unknown(text_);
    LayerChoice choice{{}, kReason, ""};
    for (std::string_view name : names) {
      const std::optional<Candidate> one = channel(name);
      if (!one) fail_unknown(name);
      const LayerSource& source = *one->group->source;
      if (choice.channels.empty()) choice.view = one->group->view;
      choice.channels.push_back({source.file, source.part, one->channels[0]});
    }
    check_count(names.size());
    return choice;
  }

 private:
  std::string subject() const {
    const std::string file = sources_.empty() ? "" : sources_[0].file_name;
    return std::string(role_.name) + "=" + (text_.empty() ? file : std::string(text_));
  }

  std::optional<Candidate> one_of(const std::vector<Candidate>& candidates) const {
    std::vector<Candidate> of_one;
    if (candidates.size() > 1) {
      of_one = of_view(candidates, asked_.empty() ? default_view(groups_) : asked_);
    }
    const Candidate* one =
        only_one(role_, subject(), of_one.empty() ? candidates : of_one, sources_);
    return one ? std::optional(*one) : std::nullopt;
  }

  /// The channel of that name; also with its part's name in front.
  std::optional<Candidate> channel(std::string_view name, Agreement agreement) const {
    std::vector<Candidate> found;
    for (const LayerGroup& group : groups_) {
      for (const std::string& full : group.channels) {
        if (agrees(agreement, full, name) || agrees(agreement, with_part(group, full), name)) {
          found.push_back({&group, {full}});
        }
      }
    }
    return one_of(found);
  }

  std::optional<Candidate> channel(std::string_view name) const {
    for (Agreement agreement : kAgreements) {
      if (std::optional<Candidate> one = channel(name, agreement)) return one;
    }
    return std::nullopt;
  }

  /// The role's channels in the layer or part of that name, loose channels first. All channels if
  /// none fit the role.
  std::optional<Candidate> layer(std::string_view name, Agreement agreement) const {
    std::vector<Candidate> of_path, of_part, of_loose;
    for (const LayerGroup& group : groups_) {
      std::vector<std::string> channels = channels_of(group);
      const Candidate candidate{&group, channels.empty() ? group.channels : std::move(channels)};
      if (agrees(agreement, group.path, name) ||
          agrees(agreement, with_part(group, group.path), name)) {
        of_path.push_back(candidate);
      } else if (agrees(agreement, group.source->part_name, name)) {
        (group.path.empty() ? of_loose : of_part).push_back(candidate);
      }
    }
    for (const std::vector<Candidate>& found : {of_path, of_loose, of_part}) {
      if (std::optional<Candidate> one = one_of(found)) return one;
    }
    return std::nullopt;
  }

  std::optional<Candidate> named(std::string_view name) const {
    for (Agreement agreement : kAgreements) {
      if (std::optional<Candidate> one = channel(name, agreement)) return one;
      if (std::optional<Candidate> one = layer(name, agreement)) return one;
    }
    return std::nullopt;
  }

  /// The role's channels in a layer, for any layer name.
  std::vector<std::string> channels_of(LayerGroup group) const {
    group.topic.clear();
    const std::vector<Candidate> fitting = candidates_of(LayerRank::kGiven, role_, {group});
    return fitting.empty() ? std::vector<std::string>() : fitting[0].channels;
  }

  LayerChoice whole_file() const {
    if (std::optional<LayerChoice> found = find_layer(role_, sources_, asked_)) return *found;
    if (std::optional<Candidate> one = one_of(candidates_of(LayerRank::kGiven, role_, groups_))) {
      return choice_of(role_, *one, kReason);
    }
    if (groups_.size() == 1) {
      const std::vector<std::string> channels = channels_of(groups_[0]);
      if (!channels.empty()) return choice_of(role_, {&groups_[0], channels}, kReason);
    }
    throw Error(subject() + ": no layer has a known name for " + std::string(role_.name) +
                "; name its channels; there is " + layer_list(groups_, sources_));
  }

  LayerChoice checked(const Candidate& candidate) const {
    check_count(candidate.channels.size());
    return choice_of(role_, candidate, kReason);
  }

  void check_count(std::size_t count) const {
    const bool fits = count == static_cast<std::size_t>(role_.count) ||
                      (is_picture(role_) && (count == 3 || count == 1));
    if (fits) return;
    std::string needed =
        std::to_string(role_.count) + (role_.count == 1 ? " channel" : " channels");
    if (role_.count == 4) needed += ", 3 (no alpha)";
    if (is_picture(role_)) needed += " or 1 (gray)";
    throw Error(subject() + " means " + std::to_string(count) +
                (count == 1 ? " channel" : " channels") + ": " + std::string(role_.name) +
                " needs " + needed);
  }

  [[noreturn]] void fail_unknown(std::string_view name) const {
    std::vector<std::string> known;
    for (const LayerGroup& group : groups_) {
      if (!group.path.empty()) known.push_back(group.path);
      if (!group.source->part_name.empty()) known.push_back(group.source->part_name);
      known.insert(known.end(), group.channels.begin(), group.channels.end());
      for (const std::string& channel : group.channels) {
        if (const std::string full = with_part(group, channel); !full.empty()) {
          known.push_back(full);
        }
      }
    }
    const std::string word(name);
    throw Error(subject() + ": no channel or layer '" + word + "'; there is " +
                layer_list(groups_, sources_) + did_you_mean(word, known));
  }

  const Role& role_;
  std::string_view text_;
  std::span<const LayerSource> sources_;
  std::vector<LayerGroup> groups_;
  const std::string& asked_;  ///< view, or ""
};

}  // namespace

LayerChoice choose_layer(const Role& role, std::string_view channels,
                         std::span<const LayerSource> sources, const std::string& view) {
  return Choosing(role, channels, sources, view).choose();
}

}  // namespace limpid
