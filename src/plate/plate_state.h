#pragma once
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/plate/inspect.h"
#include "limpid/plate/plate.h"

#include "plate/layer_views.h"
#include "plate/pass_through.h"
#include "plate/plate_deep.h"
#include "plate/plate_file.h"

namespace limpid {

/// "FILE:CHANNELS", "FILE" or "CHANNELS" as on a command line: a file exists or ends like an EXR.
PlateName split_layer(const std::string& text);

/// A resolved request: open files, and the channels of each plane.
struct __attribute__((visibility("hidden"))) Plate::State {
  Limits limits;
  std::vector<PlateFile> files;
  int of_request = 0;  ///< the first of them are PlateRequest::files, this many
  std::string motion;  ///< PlateRequest::motion
  LayerChoices choices;
  PlaneSet named;                                    ///< of roles that the request names
  std::map<std::string_view, std::string> problems;  ///< collected instead of thrown, for inspect

  const ExrPart& part_of(const ChannelRef& ref) const {
    return files[static_cast<std::size_t>(ref.file)].parts[static_cast<std::size_t>(ref.part)];
  }
  const LayerChoice* choice(std::string_view role) const {
    const auto found = choices.find(role);
    return found == choices.end() ? nullptr : &found->second;
  }
  const ChannelRef& color_ref() const { return choices.at("color").channels.front(); }

  int index_of_file(const std::string& path) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (files[i].path == path) return static_cast<int>(i);
    }
    files.push_back(PlateFile::open(path, limits));
    return static_cast<int>(files.size()) - 1;
  }

  std::vector<LayerSource> sources_of(int first, int last) const {
    std::vector<LayerSource> sources;
    for (int i = first; i < last; ++i) {
      const PlateFile& file = files[static_cast<std::size_t>(i)];
      const auto more = layer_sources(i, file.path.filename().string(), file.parts);
      sources.insert(sources.end(), more.begin(), more.end());
    }
    return sources;
  }

  std::vector<LayerSource> all_sources() const {
    return sources_of(0, static_cast<int>(files.size()));
  }

  /// The role as the request names it, or as it is found among the request's files.
  std::optional<LayerChoice> resolve(const Role& role, const PlateRequest& request) {
    const int searched = static_cast<int>(request.files.size());
    const LayerChoice* color = choice("color");
    const std::string view = request.view.empty() && color ? color->view : request.view;
    const auto decided = [&](const PlateName& name) {
      const int index = name.file.empty() ? 0 : index_of_file(name.file);
      const int end = name.file.empty() ? searched : index + 1;
      return choose_layer(role, name.channels, sources_of(index, end), view);
    };
    const std::string name(role.name);
    if (const auto found = request.layers.find(name); found != request.layers.end()) {
      if (found->second == "none") return std::nullopt;
      named = named | role.planes();
      return decided(split_layer(found->second));
    }
    if (const auto found = request.named.find(name); found != request.named.end()) {
      named = named | role.planes();
      return decided(split_plate(found->second));
    }
    return find_layer(role, sources_of(0, searched), view);
  }

  void check_view(const std::string& asked) const {
    const std::vector<std::string> views = views_of(all_sources());
    const auto is_asked = [&](const std::string& view) { return is_same_view(view, asked); };
    if (asked.empty() || std::any_of(views.begin(), views.end(), is_asked)) return;
    throw Error("view '" + asked + "': expected " +
                (views.empty() ? "none, since no plate has views" : "one of " + join(views)) +
                did_you_mean(asked, views));
  }

  /// Whether the deep samples of that part give the plane.
  bool is_deep(const ChannelRef& ref, PlaneId plane) const {
    return part_of(ref).deep && ref.name == deep_channel(plane);
  }

  bool gives_deep_below(PlaneSet wanted) const {
    for (const std::string_view role : {"below_color", "below_depth"}) {
      const LayerChoice* below = choice(role);
      const PlaneId first = role_named(role).first;
      if (below && wanted.has(first) && is_deep(below->channels.front(), first)) return true;
    }
    return false;
  }

  /// The planes to read for the wanted planes: the layer below begins at the surface.
  PlaneSet read_for(PlaneSet wanted) const {
    return gives_deep_below(wanted) ? wanted | PlaneSet{PlaneId::kSurfaceDepth} : wanted;
  }

  /// A deep part that gives the color gives the layer below, too.
  void add_deep_below(const PlateRequest& request) {
    if (!choice("color") || !is_deep(color_ref(), PlaneId::kColorR)) return;
    const ChannelRef part = color_ref();
    for (const Role& role : roles()) {
      const bool open = !choices.contains(role.name) && !problems.contains(role.name) &&
                        !request.layers.contains(std::string(role.name));
      if (!open || !kBelowPlanes.covers(role.planes())) continue;
      LayerChoice below{{}, "deep samples behind the water"};
      for (int i = 0; i < role.count; ++i) {
        const std::string_view channel = deep_channel(plane_after(role.first, i));
        below.channels.push_back({part.file, part.part, std::string(channel)});
      }
      choices.emplace(role.name, std::move(below));
    }
  }

  void resolve_all(const PlateRequest& request, bool collect_problems) {
    limits = request.limits;
    for (const auto& [name, text] : request.layers) role_named(name);
    for (const std::filesystem::path& path : request.files) {
      files.push_back(PlateFile::open(path, limits));
    }
    of_request = static_cast<int>(files.size());
    motion = request.motion;
    for (const Role& role : roles()) {
      try {
        if (auto found = resolve(role, request)) choices.emplace(role.name, std::move(*found));
      } catch (const Error& error) {
        if (!collect_problems) throw;
        problems.emplace(role.name, error.what());
      }
    }
    check_view(request.view);
    add_deep_below(request);
  }

  /// The files from which layers are passed on.
  PassingPlate passing() const {
    std::vector<LayerSource> sources = sources_of(0, of_request);
    const int color = color_ref().file;
    if (color >= of_request) {
      for (const LayerSource& source : sources_of(color, color + 1)) sources.push_back(source);
    }
    return {files, std::move(sources), choices};
  }

  InspectedViews views(const std::string& asked) const {
    const std::vector<LayerSource> sources = all_sources();
    const LayerChoice* color = choice("color");
    return {views_of(sources), !asked.empty() ? asked
                               : color        ? color->view
                                              : default_view(sources)};
  }
};

}  // namespace limpid
