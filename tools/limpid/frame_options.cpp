#include "frame_options.h"

#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/frame_range.h"

#include "notes.h"

namespace limpid::tool {
namespace {

std::string numbered(const std::filesystem::path& name, int frame) {
  return name_of_frame(name.string(), frame);
}

}  // namespace

Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs) {
  Sequence sequence;
  sequence.in_flight = options.in_flight.value_or(sequence.in_flight);
  if (options.verify && !options.resume) {
    throw Error("--verify: expected --resume beside it", Fault::kUsage);
  }
  const bool fills = missing_named(options.missing) != Missing::kError;
  if (!outputs.show.empty() && (outputs.dry_run || !options.range.empty())) {
    throw Error(std::string("--show and ") + (outputs.dry_run ? "-n" : "--frames") +
                    ": expected one of them, since one picture is shown",
                Fault::kUsage);
  }
  if (options.range.empty()) {
    const char* alone = options.fps         ? "--fps"
                        : options.in_flight ? "--frames-in-flight"
                        : options.resume    ? "--resume"
                        : fills             ? "--missing"
                                            : nullptr;
    if (alone) throw Error(std::string(alone) + ": expected --frames beside it", Fault::kUsage);
    return sequence;
  }
  if (outputs.dry_run && (options.resume || fills)) {
    throw Error(std::string(options.resume ? "--resume" : "--missing") +
                    " and -n: expected one of them, since a dry run makes no frame",
                Fault::kUsage);
  }
  for (const auto& [option, name] : {std::pair("--preview ", &outputs.preview),
                                     std::pair("--contact-sheet ", &outputs.contact_sheet)}) {
    if (options.resume && !name->empty() && !is_png(*name)) {
      throw Error("--resume and " + (option + *name) +
                      ": expected a .png, since other formats do not record how they were made",
                  Fault::kUsage);
    }
  }
  sequence.frames = frames_of(options.range);
  for (const std::string& name :
       {outputs.output, outputs.preview, outputs.contact_sheet, outputs.deep}) {
    if (sequence.frames.size() > 1 && !name.empty() && !has_frame_number(name)) {
      throw Error(name + ": expected %04d or # for the numbers of " +
                      std::to_string(sequence.frames.size()) + " frames",
                  Fault::kUsage);
    }
  }
  return sequence;
}

Sequence rest_of(const Sequence& sequence, const FrameOptions& options,
                 const CommonArguments& common,
                 const std::function<Rest(const Sequence&, VerifyLevel)>& find) {
  if (!options.resume) return sequence;
  const Rest rest = find(sequence, options.verify ? VerifyLevel::kContents : VerifyLevel::kWhole);
  tell_rest(rest, common);
  return {rest.frames, sequence.in_flight};
}

Missing missing_named(const std::string& name) {
  if (name == "error") return Missing::kError;
  if (name == "skip") return Missing::kSkip;
  if (name == "hold") return Missing::kHold;
  throw Error("--missing " + name + ": expected error, skip or hold", Fault::kUsage);
}

JobTime time_of_frame(const FrameOptions& options, const WaterOptions& water,
                      const SceneFile& scene, bool scene_of_frame, int frame) {
  JobTime time{.explicit_time = water.time};
  const double begin = time.of(scene);
  time.fallback = begin + frame / options.fps.value_or(kUsualFps);
  const bool of_scene = scene.time && !scene_of_frame;
  if (water.time || options.fps || of_scene) time.explicit_time = time.fallback;
  return time;
}

OutputChoice output_of_frame(OutputChoice output, int frame) {
  output.picture = numbered(output.picture, frame);
  output.preview = numbered(output.preview, frame);
  output.contact_sheet = numbered(output.contact_sheet, frame);
  output.deep = numbered(output.deep, frame);
  return output;
}

}  // namespace limpid::tool
