#include <algorithm>
#include <cstdio>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/job/job_files.h"

#include "compared_picture.h"
#include "judge/compare/compare.h"
#include "judge/compare/heat_map.h"
#include "judge/compare/number_text.h"
#include "judge/compare/temporal.h"
#include "memory_limit.h"
#include "picture_metrics.h"
#include "verbs.h"

namespace limpid::tool {
namespace {

/// Prints results, unless only the exit code is requested.
class Out {
 public:
  explicit Out(const CommonArguments& common) : quiet_(common.quiet) {}
  void operator()(const std::string& text) const {
    if (quiet_) return;
    std::printf("%s", text.c_str());
    std::fflush(stdout);
  }

 private:
  bool quiet_;
};

CompareOptions options_of(const CompareArguments& a) {
  CompareOptions options;
  options.tolerance = {a.tolerance, a.allowed_percent,
                       a.hard_limit.value_or(options.tolerance.hard_limit)};
  options.epsilon = a.epsilon;
  options.clip = a.clip;
  return options;
}

/// Two pictures and their difference.
struct Pair {
  ComparedPicture a, b;
  std::vector<ComparedChannel> channels;  ///< of these pictures
  Comparison result;
  PictureMetrics metrics;

  bool passes() const { return within(result) && metrics.is_finite(); }
};

/// Reads, compares, and writes the maps.
Pair compare_pair(const CompareArguments& a, const WantedMetrics& wanted, const Limits& limits) {
  Pair pair;
  const std::vector<ChannelPair> chosen =
      a.channels.empty()
          ? std::vector<ChannelPair>()
          : pairs_of(a.channels, a.a, channel_names(a.a, limits), a.b, channel_names(a.b, limits));
  std::vector<std::string> of_a, of_b;
  for (const ChannelPair& names : chosen) {
    of_a.push_back(names.a);
    of_b.push_back(names.b);
  }
  pair.a = read_picture(a.a, of_a, limits);
  pair.b = read_picture(a.b, of_b, limits);
  pair.channels =
      chosen.empty() ? channels_of(pair.a, pair.b) : channels_of(pair.a, pair.b, chosen);
  pair.result = compare(pair.channels, options_of(a));
  pair.metrics = measure(wanted, pair.a, pair.b, limits);
  if (!a.diff.empty()) {
    const double brightest = pair.result.overall.max > 0 ? pair.result.overall.max : 1;
    write_heat_map(a.diff, pair.channels, {.maximum = brightest, .decades = 6});
  }
  if (!a.flip_map.empty()) write_flip_map(a.flip_map, pair.metrics);
  return pair;
}

std::string verdict(bool passes) { return passes ? "PASS\n" : "FAILURE\n"; }

// --- a sequence ---------------------------------------------------------------------------------

CompareArguments arguments_of_frame(const CompareArguments& a, int frame) {
  CompareArguments one = a;
  for (std::string* name : {&one.a, &one.b, &one.diff, &one.flip_map}) {
    *name = name_of_frame(*name, frame);
  }
  return one;
}

JobFiles files_of(const CompareArguments& a) { return {{a.a, a.b}, {a.diff, a.flip_map}}; }

std::vector<int> frames_to_compare(const CompareArguments& a) {
  for (const std::string& name : {a.a, a.b, a.diff, a.flip_map}) {
    if (name.empty() || has_frame_number(name)) continue;
    throw Error(name + ": expected %04d or # for the numbers of --frames", Fault::kUsage);
  }
  return frames_of(a.frames);
}

/// The numbers of one frame, a word each; "-" for none.
std::vector<std::string> row_of(const Pair& pair, const std::optional<Flicker>& change) {
  const Metrics& all = pair.result.overall;
  const PictureMetrics& m = pair.metrics;
  std::vector<std::string> row = {number_text(all.mean), number_text(all.rmse),
                                  number_text(all.rel_mse), number_text(all.max)};
  row.push_back(change ? number_text(change->mean) : "-");
  row.push_back(change ? number_text(change->p99) : "-");
  if (m.ssim) row.push_back(number_text(m.ssim->mean));
  if (m.flip) row.push_back(number_text(m.flip->mean));
  if (m.hdr_flip) row.push_back(number_text(m.hdr_flip->mean));
  if (m.offset) {
    row.push_back(number_text(m.offset->overall.median));
    row.push_back(number_text(m.offset->overall.p95));
  }
  return row;
}

std::vector<std::string> heading_of(const PictureMetrics& m) {
  std::vector<std::string> row = {"mean", "RMS", "rel. MSE", "max", "flicker", "99%"};
  if (m.ssim) row.push_back("SSIM");
  if (m.flip) row.push_back("FLIP");
  if (m.hdr_flip) row.push_back("HDR-FLIP");
  if (m.offset) row.insert(row.end(), {"offset 50%", "95%"});
  return row;
}

std::string line_of(const std::string& first, const std::vector<std::string>& cells) {
  const auto padded = [](const std::string& cell, std::size_t width) {
    return std::string(cell.size() < width ? width - cell.size() : 1, ' ') + cell;
  };
  std::string line = padded(first, 9);
  for (const std::string& cell : cells) line += padded(cell, 13);
  return line;
}

int compare_frames(const CompareArguments& a, WantedMetrics wanted, const Limits& limits,
                   const Out& print) {
  const std::vector<int> frames = frames_to_compare(a);
  expect_apart(frames, [&](int frame) { return files_of(arguments_of_frame(a, frame)); });
  std::optional<Pair> before;
  double flicker_sum = 0, flicker_max = 0;
  std::vector<std::string> failed;
  for (const int frame : frames) {
    Pair pair = compare_pair(arguments_of_frame(a, frame), wanted, limits);
    std::optional<Flicker> change;
    if (before) {
      change = flicker(before->channels, pair.channels, a.clip);
      flicker_sum += change->mean;
      flicker_max = std::max(flicker_max, change->max);
    } else {
      print(line_of("frame", heading_of(pair.metrics)) + "\n");
      // All frames must have the metrics of the first, because the table has fixed columns.
      if (wanted.all) wanted.offset = pair.metrics.offset.has_value();
      wanted.all = false;
    }
    if (!pair.passes()) failed.push_back(std::to_string(frame));
    print(line_of(std::to_string(frame), row_of(pair, change)) + "  " + verdict(pair.passes()));
    if (!pair.metrics.no_offset.empty() && !before) {
      print("  Offset not measured: " + pair.metrics.no_offset + "\n");
    }
    if (!pair.metrics.spaces.empty() && !before) {
      print("  Metrics of color in Rec.709, made of " + pair.metrics.spaces + "\n");
    }
    before = std::move(pair);
  }
  if (frames.size() > 1) {
    print("  Flicker = " + number_text(flicker_sum / static_cast<double>(frames.size() - 1)) +
          ", max " + number_text(flicker_max) + "\n");
  }
  if (!failed.empty()) {
    print("  " + std::to_string(failed.size()) + " of " + std::to_string(frames.size()) +
          " frames: " + join(failed) + "\n");
  }
  print(verdict(failed.empty()));
  return failed.empty() ? 0 : 1;
}

}  // namespace

int compare_verb(const CompareArguments& a, const CommonArguments& common) {
  const Limits limits = limits_of(common);
  const Out print(common);
  const WantedMetrics wanted = wanted_metrics(a);
  if (!a.frames.empty()) return compare_frames(a, wanted, limits, print);
  expect_apart(files_of(a));
  const Pair pair = compare_pair(a, wanted, limits);
  print(numbers_text(pair.result) + to_text(pair.metrics, wanted) + verdict(pair.passes()));
  for (const std::string& map : {a.diff, a.flip_map}) {
    if (!map.empty()) print(map + "\n");
  }
  return pair.passes() ? 0 : 1;
}

}  // namespace limpid::tool
