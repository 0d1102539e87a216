#include "frame_options.h"

#include <cmath>

#include "limpid/core/error.h"
#include "limpid/load/frame_range.h"

namespace limpid::tool {
namespace {

constexpr double kUsualFps = 24;

std::string numbered(const std::filesystem::path& name, int frame) {
  return name_of_frame(name.string(), frame);
}

}  // namespace

Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs) {
  Sequence sequence;
  sequence.in_flight = options.in_flight.value_or(sequence.in_flight);
  check(sequence);
  if (options.fps && (!(*options.fps > 0) || std::isinf(*options.fps))) {
    throw Error("--fps " + std::to_string(*options.fps) + ": expected a number above 0",
                Fault::kUsage);
  }
  if (options.range.empty()) {
    if (options.fps || options.in_flight) {
      throw Error(std::string(options.fps ? "--fps" : "--frames-in-flight") +
                      ": expected --frames beside it",
                  Fault::kUsage);
    }
    return sequence;
  }
  sequence.frames = frames_of(options.range);
  for (const std::string& name : {outputs.output, outputs.preview, outputs.deep}) {
    if (sequence.frames.size() > 1 && !name.empty() && !has_frame_number(name)) {
      throw Error(name + ": expected %04d or # for the numbers of " +
                      std::to_string(sequence.frames.size()) + " frames",
                  Fault::kUsage);
    }
  }
  return sequence;
}

double time_of_frame(const FrameOptions& options, const WaterOptions& water, int frame) {
  return water.time.value_or(0) + frame / options.fps.value_or(kUsualFps);
}

OutputChoice output_of_frame(OutputChoice output, int frame) {
  output.picture = numbered(output.picture, frame);
  output.preview = numbered(output.preview, frame);
  output.deep = numbered(output.deep, frame);
  return output;
}

}  // namespace limpid::tool
