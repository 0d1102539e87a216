#include "core/toml_text.h"
#include "plate/motion_layers.h"
#include "plate/plate_state.h"

/// Passed layers of a plate, and the record of the layers that are read.

namespace limpid {

std::vector<PassedPart> Plate::passed(const std::vector<std::string>& names) const {
  if (names.empty()) return {};
  return passed_parts(state_->passing(), names);
}

std::vector<std::string> Plate::other_layers() const {
  return limpid::other_layers(state_->passing());
}

std::vector<MotionLayer> Plate::motion_layers() const {
  const LayerChoice& color = *state_->choice("color");
  return find_motion_layers(state_->passing().sources, color.view, state_->motion);
}

std::vector<Plane> Plate::read_motion(const std::vector<MotionLayer>& layers) const {
  std::vector<Plane> planes;
  for (const MotionLayer& layer : layers) {
    std::vector<ExrRequest> requests;
    for (const ChannelRef& ref : layer.channels) {
      planes.emplace_back(state_->part_of(ref).data);
      requests.push_back({ref.part, ref.name, planes.back().view(), 0});
    }
    state_->files[static_cast<std::size_t>(layer.channels.front().file)].read(requests);
  }
  return planes;
}

std::string Plate::motion_text(const std::vector<MotionLayer>& layers) const {
  std::vector<std::string> texts;
  for (const MotionLayer& layer : layers) {
    const ChannelRef& first = layer.channels.front();
    std::vector<std::string> channels;
    for (const ChannelRef& ref : layer.channels) channels.push_back(toml_text(ref.name));
    texts.push_back(
        "{file = \"" + state_->files[static_cast<std::size_t>(first.file)].content_hash() +
        "\", part = " + std::to_string(first.part) + ", channels = [" + join(channels) + "]}");
  }
  return texts.empty() ? "" : "motion = [" + join(texts) + "]\n";
}

std::string Plate::passed_text(const std::vector<PassedPart>& parts) const {
  std::vector<std::string> texts;
  for (const PassedPart& part : parts) {
    std::vector<std::string> channels;
    for (const std::string& channel : part.channels) channels.push_back(toml_text(channel));
    texts.push_back("{file = \"" + part.file->content_hash() +
                    "\", part = " + std::to_string(part.part) + ", name = " + toml_text(part.name) +
                    ", channels = [" + join(channels) + "]}");
  }
  return texts.empty() ? "" : "pass_through = [" + join(texts) + "]\n";
}

std::string Plate::inputs_text(PlaneSet wanted) const {
  wanted = state_->read_for(wanted);
  std::map<int, std::string> hashes;
  const auto hash_of_file = [&](int file) -> const std::string& {
    std::string& hash = hashes[file];
    if (hash.empty()) hash = state_->files[static_cast<std::size_t>(file)].content_hash();
    return hash;
  };
  std::string text;
  for (const Role& role : roles()) {
    const LayerChoice* choice = state_->choice(role.name);
    if (!choice) continue;
    std::vector<ChannelRef> refs;
    for (std::size_t i = 0; i < choice->channels.size(); ++i) {
      if (wanted.has(plane_after(role.first, static_cast<int>(i)))) {
        refs.push_back(choice->channels[i]);
      }
    }
    if (refs.empty()) continue;
    std::vector<std::string> inputs;  // one per run of channels of one part
    for (std::size_t i = 0; i < refs.size();) {
      const ChannelRef& first = refs[i];
      std::vector<std::string> channels;
      for (; i < refs.size() && refs[i].file == first.file && refs[i].part == first.part; ++i) {
        channels.push_back(toml_text(refs[i].name));
      }
      inputs.push_back("{file = \"" + hash_of_file(first.file) + "\", part = " +
                       std::to_string(first.part) + ", channels = [" + join(channels) + "]}");
    }
    const std::string input = inputs.size() == 1 ? inputs[0] : "[" + join(inputs) + "]";
    text += std::string(role.name) + " = " + input + "\n";
  }
  return text;
}

}  // namespace limpid
