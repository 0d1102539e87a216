#include "judge/hard/hard.h"

#include <utility>

#include "limpid/core/error.h"

#include "judge/hard/hard_case.h"

namespace limpid {
namespace {

std::string name_of(const HardCase& hard) { return hard.group + ": " + hard.name; }

HardRow measured(const HardCase& hard, const HardWorld& world) {
  const Worst worst = hard.measure(world);
  return {hard.group, hard.name,     hard.quantity, hard.reason,
          hard.bound, worst.value(), worst.count(), worst.where()};
}

}  // namespace

struct HardSuite::State {
  State(const std::filesystem::path& data, int threads, const GpuOptions* gpu)
      : world(data, threads, gpu) {}

  HardWorld world;
  HardCases cases = hard_cases();
};

HardSuite::HardSuite(const std::filesystem::path& data, int threads, const GpuOptions* gpu)
    : state_(std::make_unique<State>(data, threads, gpu)) {}
HardSuite::HardSuite(HardSuite&&) noexcept = default;
HardSuite& HardSuite::operator=(HardSuite&&) noexcept = default;
HardSuite::~HardSuite() = default;

std::vector<std::string> HardSuite::names() {
  std::vector<std::string> names;
  for (const HardCase& hard : hard_cases()) names.push_back(name_of(hard));
  return names;
}

HardRow HardSuite::measure(const std::string& name) const {
  for (const HardCase& hard : state_->cases) {
    if (name_of(hard) == name) return measured(hard, state_->world);
  }
  throw Error("hard case '" + name + "' is unknown" + did_you_mean(name, names()));
}

std::vector<HardRow> HardSuite::measure_all() const {
  std::vector<HardRow> rows;
  for (const HardCase& hard : state_->cases) rows.push_back(measured(hard, state_->world));
  return rows;
}

Worst unsound_values(const HardWorld& world, const HardFrame& frame, const Scene& scene) {
  Worst worst;
  bool has_water = false;
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, scene);
      picture.for_each_value([&](float value, int x, int y, bool aov) {
        const bool sound = aov ? !std::isnan(value) : std::isfinite(value);
        worst.expect(sound, [&] { return place_text(runner, look.name, x, y); });
      });
      has_water = has_water || picture.has_water();
    }
  }
  worst.expect(has_water, [] { return std::string("nowhere is any water"); });
  return worst;
}

HardCases hard_cases() {
  HardCases cases;
  add_depth_cases(cases);
  add_camera_cases(cases);
  add_angle_cases(cases);
  add_projection_cases(cases);
  add_scale_cases(cases);
  add_shore_cases(cases);
  add_sky_cases(cases);
  add_pixel_cases(cases);
  add_normal_cases(cases);
  add_power_cases(cases);
  add_time_cases(cases);
  add_lookup_cases(cases);
  add_size_cases(cases);
  return cases;
}

}  // namespace limpid
