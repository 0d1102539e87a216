#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/plane.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/job/job_files.h"

#include "composite_job.h"
#include "data_folder.h"
#include "desk/desk.h"
#include "given.h"
#include "job/canvas.h"
#include "known_looks.h"
#include "notes.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

void print_list(const std::vector<DeskLook>& looks) {
  std::size_t widest = 0;
  for (const DeskLook& look : looks) widest = std::max(widest, look.word.size());
  for (const bool presets : {false, true}) {
    const char* title =
        presets ? "\nPresets: looks for one kind and size of water\n" : "Looks: models of water\n";
    for (const DeskLook& look : looks) {
      if (look.is_preset() != presets) continue;
      std::printf("%s  %-*s  %s\n", title, static_cast<int>(widest), look.word.c_str(),
                  look.look.about.empty() ? look.look.file.c_str() : look.look.about.c_str());
      title = "";
    }
  }
}

/// Pictures of one size in rows, a few pixels apart.
class Sheet {
 public:
  Sheet(Size tile, int count)
      : tile_(tile), columns_(std::min(count, kColumns)), rows_((count + kColumns - 1) / kColumns) {
    const Size whole{columns_ * (tile.width + kGap) - kGap, rows_ * (tile.height + kGap) - kGap};
    for (Plane& plane : planes_) plane = Plane(rect_of(whole));
  }

  void put(int number, const Shown& picture) {
    const int left = number % kColumns * (tile_.width + kGap);
    const int top = number / kColumns * (tile_.height + kGap);
    const std::uint8_t* from = picture.rgba.data();
    for (int y = 0; y < tile_.height; ++y) {
      for (int x = 0; x < tile_.width; ++x, from += 4) {
        for (std::size_t c = 0; c < 3; ++c) {
          planes_[c].view().at(left + x, top + y) = static_cast<float>(from[c]) / 255;
        }
      }
    }
  }

  void write(const std::string& path) const {
    write_image8(path, {planes_[0].view(), planes_[1].view(), planes_[2].view()});
  }

  /// "3 by 2"
  std::string shape() const { return std::to_string(columns_) + " by " + std::to_string(rows_); }

 private:
  static constexpr int kColumns = 4, kGap = 4;
  Size tile_;
  int columns_, rows_;
  Plane planes_[3];
};

DeskOptions desk_options(LooksArguments a, const CommonArguments& common) {
  CompositeArguments& plate = a.composite;
  if (plate.plates.empty() && plate.layers.empty() && plate.scene.empty()) {
    plate.scene = (data_folder() / "plates/lagoon/lagoon.toml").string();
    plate.layers = {"surface_normal=none"};  // all looks would have the plate's waves
  }
  DeskOptions options;
  const CompositeJob job = common_job(plate, {}, common);
  expect_one_view(job, "looks");
  options.job_of = [job](std::optional<int>) { return job; };
  options.looks = known_looks(plate.water.look);
  options.start = plate.water.look;
  return options;
}

/// What there is to say of them.
std::string write_pictures(const LooksArguments& a, const CommonArguments& common) {
  as_usage([&] { expect_image8(a.pictures); });
  expect_preview_writable(a.pictures);
  const DeskOptions options = desk_options(a, common);
  JobFiles files = files_of(options.job_of({}));
  for (const DeskLook& look : options.looks) {
    files.inputs.push_back(look.look.file);
    files.inputs.insert(files.inputs.end(), look.look.bases.begin(), look.look.bases.end());
  }
  files.outputs = {a.pictures};
  expect_apart(files);
  const auto executor = executor_of(common);
  Desk desk(options, *executor);
  std::optional<Sheet> sheet;
  int number = 0;
  for (const DeskLook& look : options.looks) {
    PictureRequest request;
    request.look = look.word;
    request.half = true;
    const DeskPicture picture = desk.paint(request);
    tell_warnings(picture.warnings, common.quiet);
    if (!sheet) sheet.emplace(picture.shown.size, static_cast<int>(options.looks.size()));
    sheet->put(number++, picture.shown);
  }
  sheet->write(a.pictures);
  return a.pictures + ": " + sheet->shape() +
         " pictures, from left to right in the order of the list\n";
}

void expect_no_plate(const CompositeArguments& a) {
  const Given given[] = {{"PLATE", !a.plates.empty()},
                         {"--scene", !a.scene.empty()},
                         {"--layer", !a.layers.empty()},
                         {"--view", !a.view.empty()},
                         {"--depth-kind", !a.depth_kind.empty()},
                         {"--depth-nothing", a.depth_nothing.has_value()},
                         {"--colorspace", !a.colorspace.empty()},
                         {"--time", a.water.time.has_value()},
                         {"--simd", !a.water.simd.empty()},
                         {"--runner", a.water.runner != WaterOptions{}.runner},
                         {"--gpu", !a.water.gpu.empty()}};
  refuse_given("looks", given, "is for pictures of the looks: expected --pictures FILE beside it");
}

}  // namespace

int looks_verb(const LooksArguments& a, const CommonArguments& common) {
  if (a.pictures.empty()) expect_no_plate(a.composite);
  const std::string written = a.pictures.empty() ? "" : write_pictures(a, common);
  if (common.quiet && !written.empty()) return 0;
  print_list(known_looks(a.composite.water.look));
  std::printf("%s%s", written.empty() ? "" : "\n", written.c_str());
  return 0;
}

}  // namespace limpid::tool
