#include "job/pass_through.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "limpid/core/error.h"
#include "limpid/run/aov_names.h"

#include "job/motion.h"

namespace limpid {
namespace {

constexpr std::string_view kLossless[] = {"none", "rle", "zips", "zip", "piz"};

/// The source of each channel name in the picture's part.
std::map<std::string, std::string> written_names(const std::vector<MotionLayer>& motion,
                                                 const OutputChoice& choice) {
  std::map<std::string, std::string> names;
  for (const std::string& name : picture_channels(choice.aov_names)) {
    names.emplace(name, "that of the picture");
  }
  for (const Aov aov : choice.aovs) {
    for (const AovChannel& channel : aov_channels(aov, choice.aov_names)) {
      names.emplace(channel.name,
                    "that of the AOV " + std::string(aovs()[static_cast<std::size_t>(aov)].name));
    }
  }
  for (const MotionLayer& layer : motion) {
    for (const bool reflected : {false, true}) {
      if (!(reflected ? choice.motion_reflected : choice.motion)) continue;
      for (const std::string& name : motion_names(layer, choice.aov_names, reflected)) {
        names.emplace(name,
                      reflected ? "that of the AOV motion_reflected" : "that of the AOV motion");
      }
    }
  }
  return names;
}

const ExrPart& part_of(const PassedPart& passed) {
  return passed.file->parts()[static_cast<std::size_t>(passed.part)];
}

std::string place_of(const PassedPart& passed) {
  return passed.file->path().string() + ", part " + std::to_string(passed.part);
}

ExrCopy copy_of(const PassedPart& passed) { return {passed.file, passed.part, passed.channels}; }

}  // namespace

void expect_passable(const std::vector<PassedPart>& passed, const std::vector<MotionLayer>& motion,
                     const OutputChoice& choice) {
  if (passed.empty()) return;
  const std::string compression = choice.compression.substr(0, choice.compression.find(':'));
  if (std::find(std::begin(kLossless), std::end(kLossless), compression) == std::end(kLossless)) {
    throw Error(
        "compression '" + choice.compression +
            "': expected none, rle, zips, zip or piz, since passed-through layers keep their bits",
        Fault::kUsage);
  }
  const std::map<std::string, std::string> written = written_names(motion, choice);
  for (const PassedPart& part : passed) {
    if (!part.of_color) continue;
    for (const std::string& channel : part.channels) {
      const auto found = written.find(channel);
      if (found == written.end()) continue;
      throw Error(part.file->path().string() + ": its channel '" + channel +
                      "', which is passed through, and " + found->second +
                      " have the same name: expected one of the two, or other names (--aov-names)",
                  Fault::kUsage);
    }
  }
}

std::vector<std::string> manifest_warnings(const std::vector<PassedPart>& passed,
                                           const OutputChoice& choice) {
  namespace fs = std::filesystem;
  std::vector<std::string> warnings;
  for (const PassedPart& part : passed) {
    for (const auto& [key, attribute] : part.attributes) {
      if (!key.starts_with("cryptomatte/") || !key.ends_with("/manif_file")) continue;
      const std::string name(attribute.bytes.begin(), attribute.bytes.end());
      const auto folder = [](const fs::path& path) { return fs::absolute(path).parent_path(); };
      if (folder(part.file->path()) == folder(choice.picture)) continue;
      warnings.push_back("the manifest " + name + " of a passed-through cryptomatte lies beside " +
                         part.file->path().string() + ": copy it to the folder of " +
                         choice.picture.string());
    }
  }
  return warnings;
}

std::vector<ExrOutput> pass_through(const std::vector<PassedPart>& passed, ExrOutput& picture) {
  std::vector<ExrOutput> parts;
  for (const PassedPart& part : passed) {
    if (part.of_color) {
      picture.copies.push_back(copy_of(part));
      picture.inherited.insert(part.attributes.begin(), part.attributes.end());
      continue;
    }
    const ExrPart& stored = part_of(part);
    if (stored.display != picture.display) {
      throw Error(place_of(part) +
                  ": is passed through and has a different display window: expected that of "
                  "the picture");
    }
    ExrOutput& output = parts.emplace_back();
    output.data = intersection(stored.data, picture.data);
    if (output.data.empty()) {
      throw Error(place_of(part) +
                  ": is passed through and its data window lies outside the "
                  "picture's: expected pixels of the picture");
    }
    output.display = picture.display;
    output.pixel_aspect = picture.pixel_aspect;
    output.compression = picture.compression;
    output.inherited = part.attributes;
    output.copies = {copy_of(part)};
    output.name = part.name;
    if (output.name == picture.name) {
      output.name = part.file->path().stem().string() + "." + part.name;
    }
  }
  return parts;
}

}  // namespace limpid
