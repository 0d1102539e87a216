#include "picture_metrics.h"

#include <algorithm>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"

#include "judge/compare/heat_map.h"
#include "judge/compare/number_text.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

const std::vector<std::string> kNames = {"ssim", "flip", "hdrflip", "offset", "all"};
const std::vector<std::string> kMaps = {"stmap.r.U", "stmap.r.V", "stmap.g.U",
                                        "stmap.g.V", "stmap.b.U", "stmap.b.V"};

std::vector<std::string> with(std::vector<std::string> names,
                              const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}
const std::vector<std::string> kOfChain = with({"surface_depth.Z", "confidence.Y"}, kMaps);
const std::vector<std::string> kOfTruth = with({"visible.R", "visible.G", "visible.B"}, kMaps);
const char* const kBelow = "visible_below";

// Whether the chain looked up a layer below the water: of a model, or in layers of a plate.
bool looked_below(const std::string& path) {
  const auto inputs = ExrFile::open(path).text_attribute(0, "limpid/inputs");
  const auto says = [&](const std::string& key) {
    return ("\n" + inputs.value_or("")).find("\n" + key + " = ") != std::string::npos;
  };
  return says("model") || (says("below_color") && says("below_depth"));
}

bool tells_below(const std::string& path) {
  const auto told = [&](const char* color) {
    return has_channel(path, std::string(kBelow) + "." + color);
  };
  return told("R") && told("G") && told("B");
}

// A sentence about the first channel that the offset lacks; "" if all exist.
std::string lack(const std::string& path, const std::vector<std::string>& names,
                 const std::string& source) {
  for (const std::string& name : names) {
    if (!has_channel(path, name)) {
      return path + " has no channel '" + name + "': expected " + source;
    }
  }
  return "";
}

std::string lack(const std::string& a, const std::string& b) {
  const std::string of_a = lack(a, kOfChain, "a picture of composite or water with --aov all");
  return of_a != "" ? of_a : lack(b, kOfTruth, "a ray-traced truth with its lookups");
}

// `visible`: the truth's channels of visibility.
OffsetComparison measure_offset(const std::string& a, const std::string& b,
                                const std::string& visible, const Limits& limits) {
  const ComparedPicture chain = read_picture(a, kOfChain, limits);
  const ComparedPicture truth =
      read_picture(b, with({visible + ".R", visible + ".G", visible + ".B"}, kMaps), limits);
  if (chain.display != truth.display) {
    throw Error(a + " and " + b +
                " have different display windows: expected one, to compare lookups");
  }
  const auto of = [](const ComparedPicture& picture, const std::string& name) {
    return picture.find(name)->view();
  };
  OffsetPictures pictures{
      chain.display, of(chain, "surface_depth.Z"), of(chain, "confidence.Y"), {}};
  const char* letters[] = {"r", "g", "b"};
  const char* colors[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string map = std::string("stmap.") + letters[c];
    pictures.channels[c] = {of(chain, map + ".U"), of(chain, map + ".V"), of(truth, map + ".U"),
                            of(truth, map + ".V"), of(truth, visible + "." + colors[c])};
  }
  return offset_errors(pictures);
}

}  // namespace

WantedMetrics wanted_metrics(const CompareArguments& arguments) {
  WantedMetrics wanted;
  for (const std::string& name : arguments.metrics) {
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
      throw Error(
          "--metrics " + name + ": expected some of " + join(kNames) + did_you_mean(name, kNames),
          Fault::kUsage);
    }
    wanted.all |= name == "all";
    wanted.ssim |= name == "ssim" || name == "all";
    wanted.flip |= name == "flip" || name == "all";
    wanted.hdr_flip |= name == "hdrflip" || name == "all";
    wanted.offset |= name == "offset" || name == "all";
  }
  if (!arguments.flip_map.empty() && !wanted.hdr_flip) wanted.flip = true;
  if (arguments.ppd) {
    const double ppd = *arguments.ppd;
    if (!wanted.flip && !wanted.hdr_flip) {
      throw Error("--ppd: expected --metrics flip or hdrflip beside it", Fault::kUsage);
    }
    wanted.observer.pixels_per_degree = ppd;
  }
  wanted.clip = arguments.clip;
  if (!arguments.colorspace.empty()) {
    if (!wanted.of_color()) {
      throw Error("--colorspace: expected --metrics ssim, flip or hdrflip beside it",
                  Fault::kUsage);
    }
    wanted.primaries = as_usage([&] { return color_space_named(arguments.colorspace); });
  }
  return wanted;
}

PictureMetrics measure(const WantedMetrics& wanted, const ComparedPicture& a,
                       const ComparedPicture& b, const Limits& limits) {
  PictureMetrics metrics;
  if (wanted.offset) {
    metrics.no_offset = lack(a.path, b.path);
    if (metrics.no_offset.empty()) {
      metrics.below = looked_below(a.path);
      metrics.visible = metrics.below && tells_below(b.path) ? kBelow : "visible";
      metrics.offset = measure_offset(a.path, b.path, metrics.visible, limits);
    } else if (!wanted.all) {
      throw Error(metrics.no_offset);
    }
  }
  if (!wanted.of_color()) return metrics;
  if (wanted.primaries && !is_linear(a.path) && !is_linear(b.path)) {
    throw Error("--colorspace is for linear pictures, and " + a.path + " and " + b.path +
                    " are encoded as sRGB",
                Fault::kUsage);
  }
  const Primaries space_a = primaries_of(a.path, wanted.primaries);
  const Primaries space_b = primaries_of(b.path, wanted.primaries);
  if (!agree(space_a, kRec709) || !agree(space_b, kRec709)) {
    metrics.spaces = to_string(space_a) + " and " + to_string(space_b);
  }
  const LinearColor color_a(a, wanted.clip, space_a), color_b(b, wanted.clip, space_b);
  const ColorPair pair{color_a.views(), color_b.views()};
  if (wanted.ssim) metrics.ssim = ssim(pair);
  if (wanted.flip) metrics.flip = flip(pair, wanted.observer);
  if (wanted.hdr_flip) {
    metrics.exposures = exposures_of(pair.b);
    metrics.hdr_flip = hdr_flip(pair, metrics.exposures, wanted.observer);
  }
  return metrics;
}

std::string to_text(const PictureMetrics& metrics, const WantedMetrics& wanted) {
  std::string text;
  const std::string ppd = number_text(wanted.observer.pixels_per_degree) + " pixels a degree";
  if (!metrics.spaces.empty()) {
    text += "  Metrics of color in Rec.709, made of " + metrics.spaces + "\n";
  }
  if (metrics.ssim) text += "  SSIM = " + to_text(*metrics.ssim) + "\n";
  if (metrics.flip) text += "  FLIP = " + to_text(*metrics.flip) + " (" + ppd + ")\n";
  if (metrics.hdr_flip) {
    const Exposures& e = metrics.exposures;
    text += "  HDR-FLIP = " + to_text(*metrics.hdr_flip) + " (" + ppd + ", " +
            std::to_string(e.count) + " exposures " + number_text(e.start) + " ... " +
            number_text(e.stop) + ")\n";
  }
  if (metrics.below) {
    text += "  Lookups below the water alone, judged by " + metrics.visible + " of the truth\n";
  }
  if (metrics.offset) text += to_text(*metrics.offset);
  if (!metrics.no_offset.empty()) text += "  Offset not measured: " + metrics.no_offset + "\n";
  return text;
}

void write_flip_map(const std::string& path, const PictureMetrics& metrics) {
  const View<const float> map = (metrics.flip ? *metrics.flip : *metrics.hdr_flip).map.view();
  const float zero = 0;
  const ComparedChannel channel{"FLIP", map, {&zero, 0, 0, map.window}};
  write_heat_map(path, {&channel, 1}, {.maximum = 1});
}

}  // namespace limpid::tool
