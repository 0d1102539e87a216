#include "judge/shot/shot_variants.h"

#include <utility>

#include "job/composite_inputs.h"
#include "judge/report/rounds.h"

namespace limpid {

ShotVariants::ShotVariants(const CompositeJob& job, Executor& executor)
    : executor_(executor), held_(job), scene_(scene_of(held_.job(), held_.plate())) {}

ShotVariant ShotVariants::planned(std::string name, const Look& look, std::vector<Aov> aovs,
                                  const std::vector<std::string>& left_out) const {
  ShotVariant variant{std::move(name), held_.job(), {}};
  variant.job.look = look;
  variant.job.output.aovs = std::move(aovs);
  variant.plan = plan_of(variant.job, held_.plate(), scene_, left_out);
  return variant;
}

void ShotVariants::read(std::vector<ShotVariant>& variants) {
  PlaneSet all;
  for (const ShotVariant& variant : variants) all = all | variant.plan.planes;
  held_.read(all, scene_);
  for (ShotVariant& variant : variants) {
    variant.frame = held_.whole(variant.plan.planes, scene_);
    variant.textures =
        textures_.load(textures_read(variant.plan, variant.job.scene), variant.job.plate.limits);
    variant.textures.show_in(variant.frame);
  }
}

const Target& ShotVariants::run(const ShotVariant& variant, RunTimes* times) {
  canvas_for(canvas_, window(), variant.job.output)
      .paint(variant.plan, variant.frame, scene_, variant.job.output, executor_, times);
  return canvas_->target();
}

void ShotVariants::time(std::vector<ShotVariant>& variants, int rounds) {
  std::vector<Timed> timed;
  for (const ShotVariant& variant : variants)
    timed.push_back({[&] { run(variant); }, Clock::kWall});
  for (const Timed& work : timed) work.run();
  time_rounds(timed, rounds);
  for (std::size_t i = 0; i < variants.size(); ++i) variants[i].seconds = timed[i].best_seconds;
}

}  // namespace limpid
