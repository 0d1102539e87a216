#include <algorithm>
#include <cstdio>

#include "limpid/core/error.h"
#include "limpid/load/exr_file.h"
#include "limpid/load/image_file.h"
#include "limpid/report/compare.h"
#include "limpid/report/heat_map.h"

#include "verbs.h"

namespace limpid::tool {
namespace {

struct Picture {
  std::vector<std::string> names;
  std::vector<Plane> planes;
};

/// All channels of the first part of an EXR, or of another format, that `wanted` names; all when it
/// is empty.
Picture read_picture(const std::string& path, const std::vector<std::string>& wanted) {
  const auto is_wanted = [&](const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  Picture picture;
  std::vector<std::string> known;
  if (is_exr(path)) {
    const ExrFile file = ExrFile::open(path);
    const ExrPart& part = file.parts().front();
    std::vector<ExrRequest> requests;
    for (const ExrChannel& channel : part.channels) {
      known.push_back(channel.name);
      if (!is_wanted(channel.name)) continue;
      picture.names.push_back(channel.name);
      picture.planes.emplace_back(part.data);
      requests.push_back({0, channel.name, picture.planes.back().view(), 0});
    }
    file.read(requests);
  } else {
    ImageFile image = read_image(path);
    known = image.channels;
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
      if (!is_wanted(image.channels[i])) continue;
      picture.names.push_back(image.channels[i]);
      picture.planes.push_back(std::move(image.planes[i]));
    }
  }
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(path + " has no channel '" + name + "': there is " + join(known) +
                  did_you_mean(name, known));
    }
  }
  return picture;
}

}  // namespace

int compare_verb(const CompareArguments& a) {
  const Picture left = read_picture(a.a, a.channels), right = read_picture(a.b, a.channels);
  std::vector<std::string> left_names = left.names, right_names = right.names;
  std::sort(left_names.begin(), left_names.end());
  std::sort(right_names.begin(), right_names.end());
  if (left_names != right_names) {
    throw Error(a.a + " has the channels " + join(left.names) + " and " + a.b + " has " +
                join(right.names) + ": name those to compare with --channels");
  }
  std::vector<ComparedChannel> channels;
  for (std::size_t i = 0; i < left.names.size(); ++i) {
    const auto at = std::find(right.names.begin(), right.names.end(), left.names[i]);
    const auto j = static_cast<std::size_t>(at - right.names.begin());
    channels.push_back({left.names[i], left.planes[i].view(), right.planes[j].view()});
  }
  CompareOptions options;
  options.tolerance = {a.tolerance, a.allowed_percent,
                       a.hard_limit.value_or(options.tolerance.hard_limit)};
  options.epsilon = a.epsilon;
  options.clip = a.clip;
  const Comparison result = compare(channels, options);
  std::printf("%s", to_text(result).c_str());
  if (!a.diff.empty()) {
    const double brightest = result.overall.max > 0 ? result.overall.max : 1;
    write_heat_map(a.diff, channels, {.maximum = brightest, .decades = 6});
    std::printf("%s\n", a.diff.c_str());
  }
  return within(result) ? 0 : 1;
}

}  // namespace limpid::tool
