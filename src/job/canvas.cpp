#include "job/canvas.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "complete/rows.h"
#include "files/exr/exr_whole.h"
#include "files/picture/whole_image.h"
#include "job/held_gpu.h"
#include "job/sheet.h"
#include "run/each_once.h"
#include "show/encoded.h"

namespace limpid {
namespace {

/// Whether both are the same part of the same file: a part that views share is written once.
bool is_same_copy(const ExrOutput& a, const ExrOutput& b) {
  const ExrCopy &of_a = a.copies.front(), &of_b = b.copies.front();
  return of_a.from->path() == of_b.from->path() && of_a.part == of_b.part &&
         of_a.channels == of_b.channels;
}

bool has_mean(Aov aov) { return aovs()[static_cast<std::size_t>(aov)].filter == Filter::kMean; }

float block_mean(const View<float>& from, int x, int y, int n) {
  double sum = 0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) sum += from.at(x * n + i, y * n + j);
  }
  return static_cast<float>(sum / (n * n));
}

void expect_samples(const OutputChoice& choice) {
  const std::string said = "wave_samples = " + std::to_string(choice.wave_samples);
  if (choice.wave_samples < 1 || choice.wave_samples > OutputChoice::kMaxWaveSamples) {
    throw Error(said + ": expected 1 ... " + std::to_string(OutputChoice::kMaxWaveSamples),
                Fault::kUsage);
  }
  if (choice.wave_samples > 1 && !choice.deep.empty()) {
    throw Error(said + " and a deep file: expected 1, since depths of several samples have no mean",
                Fault::kUsage);
  }
}

void expect_overscan(const OutputChoice& choice) {
  if (choice.overscan >= 0 && choice.overscan <= OutputChoice::kMaxOverscan) return;
  throw Error("overscan = " + std::to_string(choice.overscan) + ": expected 0 ... " +
                  std::to_string(OutputChoice::kMaxOverscan) + " (pixels)",
              Fault::kUsage);
}

/// The parts beside the pictures, each once. A part that not all views share belongs to its view,
/// and gets the view's name unless its own name has it.
std::vector<ExrOutput> parts_beside(const std::vector<WrittenView>& views) {
  std::vector<ExrOutput> parts;
  const auto has = [](const std::vector<ExrOutput>& list, const ExrOutput& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](const ExrOutput& other) { return is_same_copy(other, part); });
  };
  for (const WrittenView& view : views) {
    for (const ExrOutput& part : view.others) {
      if (has(parts, part)) continue;
      parts.push_back(part);
      const bool shared = std::all_of(views.begin(), views.end(), [&](const WrittenView& other) {
        return has(other.others, part);
      });
      if (shared || part.inherited.contains("view")) continue;
      parts.back().name += "." + view.view;
      parts.back().view = view.view;
    }
  }
  return parts;
}

View<const float> cropped(View<const float> view, const Rect& to) {
  view.data = &view.at(to.x0, to.y0);
  view.window = to;
  return view;
}

}  // namespace

std::vector<Aov> computed_aovs(const OutputChoice& choice) {
  std::vector<Aov> list = choice.aovs;
  const auto add = [&](Aov aov) {
    if (std::find(list.begin(), list.end(), aov) == list.end()) list.push_back(aov);
  };
  if (!choice.deep.empty()) std::for_each(std::begin(kDeepAovs), std::end(kDeepAovs), add);
  if (choice.motion) {
    add(Aov::kStmapG);
    add(Aov::kSurfaceDepth);
    add(Aov::kNormal);  // for vectors to a second frame
  }
  if (choice.motion_reflected) {
    add(Aov::kSurfaceDepth);
    add(Aov::kNormal);
    add(Aov::kReflectionDepth);
  }
  if (!choice.contact_sheet.empty()) {
    for (const AovInfo& info : aovs()) add(aov_named(info.name));
  }
  return list;
}

void expect_writable(const OutputChoice& choice) {
  expect_samples(choice);
  expect_overscan(choice);
  expect_each_once(choice.aovs);
  expect_writable(choice.picture);
  if (!choice.deep.empty()) expect_writable(choice.deep);
  if (!choice.preview.empty()) expect_preview_writable(choice.preview);
  if (!choice.contact_sheet.empty()) expect_preview_writable(choice.contact_sheet);
  if (choice.shows()) expect_display(choice.display);
}

void expect_writable(const std::filesystem::path& file) { expect_replaceable(file); }

void expect_display(const DisplayChoice& display) { DisplayTransform{display}; }

void expect_preview_writable(const std::filesystem::path& file) {
  expect_writable(file);
  expect_image8(file);
}

Canvas::Canvas(Rect window, const OutputChoice& choice)
    : window_(window),
      made_{choice.aovs, computed_aovs(choice), choice.aov_names, choice.store_float} {
  const std::vector<std::string> names = picture_channels(choice.aov_names);
  for (int i = 0; i < 3; ++i) {
    target_.color[i] = add(names[static_cast<std::size_t>(i)], !choice.store_float);
  }
  target_.alpha = add(names[3], !choice.store_float);
  View<float> ones;
  for (Aov aov : choice.aovs) {
    const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
    const bool half = info.storage == Storage::kHalf && !choice.store_float;
    for (const AovChannel& channel : aov_channels(aov, choice.aov_names)) {
      if (channel.plane >= 0) {
        target_.of(aov)[static_cast<std::size_t>(channel.plane)] = add(channel.name, half);
        continue;
      }
      if (!ones) {
        ones = add();
        for (int y = window.y0; y < window.y1; ++y) {
          std::fill_n(ones.row(y), window.width(), 1.0f);
        }
      }
      channels_.push_back({channel.name, ones, half});
    }
  }
  for (Aov aov : computed_aovs(choice)) {
    for (std::size_t i = 0; i < aovs()[static_cast<std::size_t>(aov)].suffixes.size(); ++i) {
      if (!target_.of(aov)[i]) target_.of(aov)[i] = add();
    }
  }
  if (!choice.deep.empty()) target_.uncovered = add();
}

Canvas& canvas_for(std::optional<Canvas>& kept, Rect window, const OutputChoice& choice) {
  if (!kept || !kept->fits(window, choice)) {
    kept.reset();
    kept.emplace(window, choice);
  }
  return *kept;
}

bool Canvas::fits(Rect window, const OutputChoice& choice) const {
  return window == window_ &&
         made_ == Made{choice.aovs, computed_aovs(choice), choice.aov_names, choice.store_float};
}

View<float> Canvas::add() {
  planes_.emplace_back(window_);
  return planes_.back().view();
}

View<float> Canvas::add(const std::string& name, bool half) {
  const View<float> view = add();
  channels_.push_back({name, view, half});
  return view;
}

void Canvas::paint(const Plan& plan, const Frame& frame, const Scene& scene,
                   const OutputChoice& choice, Executor& executor, RunTimes* times,
                   const std::stop_token& stop) {
  const int middle = (choice.wave_samples - 1) / 2;
  Scene seen = scene;
  for (int i = 1; i <= choice.wave_samples; ++i) {
    expect_wanted(stop);
    seen.part = {(middle + i) % choice.wave_samples,
                 choice.wave_samples};  // the middle sample comes last
    switch (choice.runner) {
      case Runner::kReference:
        run_reference(plan, frame, seen, target_);
        break;
      case Runner::kGpu:
        if (!gpu_) gpu_.emplace(gpu_options(choice));
        gpu_->run(plan, frame, seen, target_, executor);
        break;
      case Runner::kFused:
        runner_.run(plan, frame, seen, target_, executor,
                    {.simd = choice.simd, .times = times, .stop = stop});
        break;
    }
    if (choice.wave_samples > 1) take_mean(i, executor);
  }
  if (!choice.deep.empty()) extent_ = water_extent(plan, frame, scene, target_);
}

void Canvas::take_mean(int count, Executor& executor) {
  std::vector<View<float>> mixed(std::begin(target_.color), std::end(target_.color));
  mixed.push_back(target_.alpha);
  for (Aov aov : made_.computed) {
    if (!has_mean(aov)) continue;
    for (const View<float>& view : target_.of(aov)) {
      if (view) mixed.push_back(view);
    }
  }
  means_.resize(mixed.size());
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (!means_[i]) means_[i] = Plane(window_);
    const View<float> mean = means_[i].view();
    // In this order, the mean of equal parts has their exact bits.
    const float share = 1 / static_cast<float>(count);
    each_row(executor, window_, [&](int y) {
      float *so_far = mean.row(y), *last = mixed[i].row(y);
      for (int x = 0; x < window_.width(); ++x) {
        so_far[x] = count == 1 ? last[x] : so_far[x] + share * (last[x] - so_far[x]);
        last[x] = so_far[x];
      }
    });
  }
}

Canvas Canvas::filtered(int n, const OutputChoice& choice) const {
  const Rect small{window_.x0 / n, window_.y0 / n, window_.x1 / n, window_.y1 / n};
  Canvas canvas(small, choice);
  const auto shrink = [&](const View<float>& from, const View<float>& to, bool mean) {
    if (!from) return;
    for (int y = small.y0; y < small.y1; ++y) {
      for (int x = small.x0; x < small.x1; ++x) {
        to.at(x, y) =
            mean ? block_mean(from, x, y, n) : from.at(x * n + (n - 1) / 2, y * n + (n - 1) / 2);
      }
    }
  };
  for (int i = 0; i < 3; ++i) shrink(target_.color[i], canvas.target_.color[i], true);
  shrink(target_.alpha, canvas.target_.alpha, true);
  for (Aov aov : computed_aovs(choice)) {
    for (int i = 0; i < 3; ++i) {
      shrink(target_.of(aov)[i], canvas.target_.of(aov)[i], has_mean(aov));
    }
  }
  return canvas;
}

DeepWater Canvas::deep_water(const ExrHeading& heading, const OutputChoice& choice) const {
  DeepWater water;
  static_cast<ExrHeading&>(water) = heading;
  water.front = extent_.front.view();
  water.back = extent_.back.view();
  for (std::size_t c = 0; c < 3; ++c) {
    water.transmittance[c] = target_.of(Aov::kTransmittance)[c];
    water.in_scatter[c] = extent_.in_scatter[c].view();
  }
  water.half = !choice.store_float;
  return water;
}

void Canvas::write(ExrOutput described, const OutputChoice& choice) const {
  write_frame({{this, std::move(described)}}, choice);
}

void write_frame(std::vector<WrittenView> views, const OutputChoice& choice) {
  const WrittenView& first = views.front();
  AtomicFiles files;
  DisplayTransform display;
  if (choice.shows()) display = DisplayTransform(choice.display, first.primaries);
  if (!choice.preview.empty()) {
    const Rect shown = intersection(first.canvas->window(), first.described.display);
    const auto color = [&](int i) { return cropped(first.canvas->target().color[i], shown); };
    write_preview(files, choice.preview, {color(0), color(1), color(2)}, display,
                  first.described.text);
  }
  if (!choice.contact_sheet.empty()) {
    const Shown sheet = sheet_of(*first.canvas, first.described.display, display);
    write_shown(files, choice.contact_sheet, sheet, first.described.text);
  }
  if (!choice.deep.empty()) {
    ExrHeading heading = first.described;
    heading.data = first.canvas->window();
    write_deep_water(files, choice.deep, first.canvas->deep_water(heading, choice));
  }
  std::vector<ExrOutput> others = parts_beside(views);
  std::vector<ExrOutput> parts;
  for (WrittenView& view : views) {
    ExrOutput& part = parts.emplace_back(std::move(view.described));
    part.data = view.canvas->window();
    part.compression = choice.compression;
    part.channels.insert(part.channels.begin(), view.canvas->channels().begin(),
                         view.canvas->channels().end());
    if (views.size() > 1) part.name = part.view = view.view;
  }
  std::move(others.begin(), others.end(), std::back_inserter(parts));
  write_exr(files, choice.picture, parts);
  files.commit();
}

}  // namespace limpid
