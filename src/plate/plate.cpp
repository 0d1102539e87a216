#include "limpid/plate/plate.h"

#include <algorithm>
#include <set>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/plate/inspect.h"

#include "files/exr/exr_header.h"
#include "plate/layer_candidates.h"
#include "plate/layer_views.h"
#include "plate/plane_budget.h"
#include "plate/plate_deep.h"
#include "plate/plate_file.h"
#include "plate/plate_state.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

/// The requested planes of a deep part.
struct DeepRequest {
  Rect window;
  PlaneSet planes;
};

}  // namespace

/// "FILE:CHANNELS", "FILE" or "CHANNELS" as on a command line: a file exists or ends like an EXR.
PlateName split_layer(const std::string& text) {
  const auto names_file = [](const std::string& s) {
    std::error_code ignored;
    return is_exr(s) || std::filesystem::is_regular_file(s, ignored);
  };
  if (names_file(text)) return {text, ""};
  const PlateName split = split_plate(text);
  return names_file(split.file) ? split : PlateName{"", text};
}

std::vector<std::filesystem::path> files_of(const PlateRequest& request) {
  std::set<std::filesystem::path> files(request.files.begin(), request.files.end());
  for (const auto& [role, name] : request.named) {
    if (!request.layers.contains(role)) files.insert(split_plate(name).file);
  }
  for (const auto& [role, text] : request.layers) {
    if (const PlateName name = split_layer(text); !name.file.empty()) files.insert(name.file);
  }
  return {files.begin(), files.end()};
}

Plate::Plate(std::unique_ptr<State> state) : state_(std::move(state)) {}
Plate::Plate(Plate&&) noexcept = default;
Plate& Plate::operator=(Plate&&) noexcept = default;
Plate::~Plate() = default;

Plate Plate::open(const PlateRequest& request) {
  Plate plate(std::make_unique<State>());
  State& state = *plate.state_;
  state.resolve_all(request, false);
  if (!state.choice("color")) plate.refuse_without("color");
  const Rect display = plate.display();
  for (const auto& [role, choice] : state.choices) {
    const Rect other = state.part_of(choice.channels.front()).display;
    if (other == display) continue;
    const auto text = [](const Rect& r) {
      std::string size = std::to_string(r.width()) + "x" + std::to_string(r.height());
      if (r.x0 == 0 && r.y0 == 0) return size;
      return size + " at (" + std::to_string(r.x0) + ", " + std::to_string(r.y0) + ")";
    };
    const auto name = [&](std::string_view of) {
      const ChannelRef& ref = state.choices.at(of).channels.front();
      return std::string(of) + " (" +
             state.files[static_cast<std::size_t>(ref.file)].path.string() + ")";
    };
    throw Error(name(role) + " is " + text(other) + " pixels and " + name("color") + " is " +
                text(display) + ": expected one display window");
  }
  return plate;
}

std::vector<std::string> Plate::views(const PlateRequest& request) {
  State state;
  state.limits = request.limits;
  for (const std::filesystem::path& path : files_of(request)) state.index_of_file(path.string());
  return views_of(state.all_sources());
}

std::string Plate::inspect(const PlateRequest& request) {
  State state;
  state.resolve_all(request, true);
  std::vector<InspectedFile> files;
  for (const PlateFile& file : state.files) {
    files.push_back({file.path.string(), file.parts, file.made(), file.color_space()});
  }
  return inspect_text(files, state.choices, state.problems, state.views(request.view));
}

PlaneSet Plate::planes() const {
  PlaneSet set;
  for (const Role& role : roles()) {
    if (const LayerChoice* choice = state_->choice(role.name)) {
      for (std::size_t i = 0; i < choice->channels.size(); ++i) {
        set = set | PlaneSet{plane_after(role.first, static_cast<int>(i))};
      }
    }
  }
  return set;
}

PlaneSet Plate::named_planes() const { return planes() & state_->named; }

Rect Plate::display() const { return state_->part_of(state_->color_ref()).display; }

double Plate::pixel_aspect() const { return state_->part_of(state_->color_ref()).pixel_aspect; }

std::string Plate::part_name() const { return state_->part_of(state_->color_ref()).name; }

std::optional<Camera> Plate::camera() const {
  const ChannelRef& ref = state_->color_ref();
  const PlateFile& file = state_->files[static_cast<std::size_t>(ref.file)];
  if (!file.exr) return std::nullopt;
  return camera_of(*file.exr, ref.part);
}

SceneFile Plate::scene() const {
  const ChannelRef& ref = state_->color_ref();
  const PlateFile& file = state_->files[static_cast<std::size_t>(ref.file)];
  if (!file.exr) return {};
  const std::optional<std::string> text = file.exr->text_attribute(ref.part, "limpid/scene");
  return text ? scene_from_toml(*text, file.path.string() + ", limpid/scene") : SceneFile{};
}

bool Plate::has_scene() const {
  const ChannelRef& ref = state_->color_ref();
  const PlateFile& file = state_->files[static_cast<std::size_t>(ref.file)];
  return file.exr && file.exr->text_attribute(ref.part, "limpid/scene");
}

std::map<std::string, ExrFile::Attribute> Plate::attributes() const {
  const ChannelRef& ref = state_->color_ref();
  const PlateFile& file = state_->files[static_cast<std::size_t>(ref.file)];
  if (!file.exr) return {};
  auto attributes = file.exr->attributes(ref.part);
  std::erase_if(attributes, [](const auto& entry) { return describes_content(entry.first); });
  return attributes;
}

std::optional<Primaries> Plate::primaries() const {
  try {
    return told_primaries(attributes());
  } catch (const Error& error) {
    const ChannelRef& ref = state_->color_ref();
    throw Error(state_->files[static_cast<std::size_t>(ref.file)].path.string() + ": " +
                error.what() + ", or another [scene] colorspace");
  }
}

void Plate::refuse_without(std::string_view role) const {
  const std::vector<LayerSource> sources = state_->all_sources();
  throw Error("no " + std::string(role) + " found; there is " +
              layer_list(group_layers(sources), sources) + "; name it with --layer " +
              std::string(role) + "=LAYER");
}

PlaneSet Plate::read_for(PlaneSet wanted) const { return state_->read_for(wanted) & planes(); }

LoadedPlate Plate::read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth) const {
  LoadedPlate loaded;
  read(wanted, scene, depth, loaded);
  return loaded;
}

void Plate::read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth,
                 LoadedPlate& loaded) const {
  std::vector<Plane> old = std::exchange(loaded.planes, std::vector<Plane>(kPlaneCount));
  old.resize(kPlaneCount);
  loaded.frame = {};
  loaded.transparent = 0;
  loaded.frame.display = display();
  const Rect work = intersection(display(), state_->part_of(state_->color_ref()).data);
  if (work.empty()) throw Error("color: its data window lies outside the display window");
  wanted = state_->read_for(wanted);

  PlaneBudget budget(state_->limits);
  std::map<int, std::vector<ExrRequest>> requests;  // by file; each file decodes at once
  std::map<std::pair<int, int>, DeepRequest> deep;  // by file and part, read after all the others
  for (const Role& role : roles()) {
    const LayerChoice* choice = state_->choice(role.name);
    if (!choice) continue;
    for (std::size_t i = 0; i < choice->channels.size(); ++i) {
      const PlaneId id = plane_after(role.first, static_cast<int>(i));
      if (!wanted.has(id)) continue;
      const ChannelRef& ref = choice->channels[i];
      const Rect window = budget.take(std::string(role.name), state_->part_of(ref).data, work);
      if (state_->is_deep(ref, id)) {
        DeepRequest& request = deep[{ref.file, ref.part}];
        request = {window, request.planes | PlaneSet{id}};
        continue;
      }
      Plane& plane = loaded.planes[index_of(id)];
      plane = std::move(old[index_of(id)]);
      if (!plane || plane.view().window != window) plane = Plane(window);
      loaded.frame.planes[index_of(id)] = plane.view();
      requests[ref.file].push_back({ref.part, ref.name, plane.view(), role.missing});
    }
  }
  for (const auto& [file, list] : requests)
    state_->files[static_cast<std::size_t>(file)].read(list);

  const auto source_of = [&](const Role& role) -> DepthSource {
    const ChannelRef& ref = state_->choice(role.name)->channels.front();
    const auto& channels = state_->part_of(ref).channels;
    const bool half = std::any_of(channels.begin(), channels.end(), [&](const auto& c) {
      return c.name == ref.name && c.type == SampleType::kHalf;
    });
    DepthSource source{
        depth.kind, half,         depth.near, depth.far, scene.camera ? &*scene.camera : nullptr,
        display(),  depth.nothing};
    const Plane& alpha = loaded.planes[index_of(PlaneId::kColorA)];
    if (role.first == PlaneId::kDepth && alpha) {
      source.uncovered = [&alpha](int x, int y) {
        const View<const float> view = alpha.view();
        return view.window.contains({x, y, x + 1, y + 1}) && view.at(x, y) == 0;
      };
    }
    return source;
  };
  loaded.replaced = sanitise_planes(loaded.planes,
                                    scene.water ? scene.water->up : glm::dvec3(0, 1, 0), source_of);
  for (const auto& [place, request] : deep) {
    const ExrFile& file = *state_->files[static_cast<std::size_t>(place.first)].exr;
    read_deep_planes(file, place.second, request.planes, request.window, scene, depth, loaded);
  }
}

}  // namespace limpid
