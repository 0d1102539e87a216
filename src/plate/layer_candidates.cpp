#include "plate/layer_candidates.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr std::size_t kListed = 24;  // names in a sentence

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool is_in_other_parts(const std::string& channel, const LayerSource& source,
                       std::span<const LayerSource> sources) {
  return std::any_of(sources.begin(), sources.end(), [&](const LayerSource& other) {
    return other.file == source.file && other.part != source.part &&
           contains(other.channels, channel);
  });
}

std::string file_prefix(const LayerSource& source, std::span<const LayerSource> sources) {
  const bool several = std::any_of(sources.begin(), sources.end(), [&](const LayerSource& other) {
    return other.file != source.file;
  });
  return several ? source.file_name + ":" : "";
}

/// The text after `--layer depth=` that selects only this candidate.
std::string selector(const Candidate& candidate, std::span<const LayerSource> sources) {
  const LayerGroup& group = *candidate.group;
  const LayerSource& source = *group.source;
  const std::string file = file_prefix(source, sources);
  const bool say_part = is_in_other_parts(candidate.channels[0], source, sources);
  const std::string part = say_part ? source.part_name + "." : "";
  if (candidate.channels.size() == 1) return file + part + candidate.channels[0];
  if (!group.path.empty()) return file + part + group.path;
  return file + (say_part ? source.part_name : join(candidate.channels, ","));
}

/// The first texts and the number of the rest: a header may have thousands.
std::string listed(std::vector<std::string> texts, std::size_t count) {
  if (texts.size() < count) texts.push_back(std::to_string(count - texts.size()) + " more");
  return join(texts);
}

[[noreturn]] void fail_ambiguous(const Role& role, const std::string& subject,
                                 const std::vector<Candidate>& candidates,
                                 std::span<const LayerSource> sources) {
  std::vector<std::string> texts, views;
  for (const Candidate& candidate : candidates) {
    if (texts.size() < kListed) texts.push_back(selector(candidate, sources));
    const std::string& view = candidate.group->view;
    if (!contains(views, view.empty() ? "default" : view)) {
      views.push_back(view.empty() ? "default" : view);
    }
  }
  const std::string of_views = views.size() > 1 ? " (views " + join(views) + ")" : "";
  throw Error(subject + ": " + std::to_string(candidates.size()) + " candidates fit equally well" +
              of_views + ": " + listed(texts, candidates.size()) + "; choose one, as in --layer " +
              std::string(role.name) + "=" + texts[0]);
}

}  // namespace

std::vector<Candidate> candidates_of(LayerRank rank, const Role& role,
                                     const std::vector<LayerGroup>& groups) {
  std::vector<Candidate> candidates;
  for (const LayerGroup& group : groups) {
    for (const LayerRule& rule : layer_rules()) {
      if (rule.rank != rank || rule.role != role.name) continue;
      std::vector<std::string> channels = match(rule, group);
      if (channels.empty()) continue;
      candidates.push_back({&group, std::move(channels), &rule});
      break;
    }
  }
  return candidates;
}

const Candidate* only_one(const Role& role, const std::string& subject,
                          const std::vector<Candidate>& candidates,
                          std::span<const LayerSource> sources) {
  if (candidates.empty()) return nullptr;
  const auto is_flat = [](const Candidate& c) { return !c.group->source->deep; };
  const auto flat = std::find_if(candidates.begin(), candidates.end(), is_flat);
  const auto flat_ones = std::count_if(candidates.begin(), candidates.end(), is_flat);
  if (candidates.size() > 1 && flat_ones != 1) {
    fail_ambiguous(role, subject, candidates, sources);
  }
  return flat_ones == 1 ? &*flat : &candidates[0];
}

std::string layer_list(const std::vector<LayerGroup>& groups,
                       std::span<const LayerSource> sources) {
  std::vector<std::string> texts;
  for (const LayerGroup& group : groups) {
    if (texts.size() == kListed) break;
    std::vector<std::string> components;
    for (const std::string& channel : group.channels) {
      components.push_back(split_channel(channel).component);
    }
    sort_components(components);
    const std::string& part = group.source->part_name;
    const bool say_part = is_in_other_parts(group.channels[0], *group.source, sources);
    const std::string name = group.path.empty() ? part : (say_part ? part + "." : "") + group.path;
    const std::string text = join(components, " ");
    texts.push_back(file_prefix(*group.source, sources) +
                    (name.empty() ? text : name + " (" + text + ")"));
  }
  return texts.empty() ? "no channel" : listed(texts, groups.size());
}

bool is_picture(const Role& role) { return role.sanitise == Sanitise::kColor; }

LayerChoice choice_of(const Role& role, const Candidate& candidate, std::string reason) {
  LayerChoice choice{{}, std::move(reason), candidate.group->view};
  const LayerSource& source = *candidate.group->source;
  for (const std::string& channel : candidate.channels) {
    choice.channels.push_back({source.file, source.part, channel});
  }
  if (is_picture(role) && choice.channels.size() == 1) {
    choice.channels.resize(3, choice.channels[0]);
  }
  return choice;
}

}  // namespace limpid
