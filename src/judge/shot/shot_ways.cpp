#include "judge/shot/shot_ways.h"

#include <utility>

#include "job/composite_inputs.h"
#include "judge/report/rounds.h"

namespace limpid {

ShotWays::ShotWays(const CompositeJob& job, Executor& executor)
    : executor_(executor), held_(job), scene_(scene_of(held_.job(), held_.plate())) {}

ShotWay ShotWays::planned(std::string name, const Look& look, std::vector<Aov> aovs,
                          const std::vector<std::string>& left_out) const {
  ShotWay way{std::move(name), held_.job(), {}};
  way.job.look = look;
  way.job.output.aovs = std::move(aovs);
  way.plan = plan_of(way.job, held_.plate(), scene_, left_out);
  return way;
}

void ShotWays::read(std::vector<ShotWay>& ways) {
  PlaneSet all;
  for (const ShotWay& way : ways) all = all | way.plan.planes;
  held_.read(all, scene_);
  for (ShotWay& way : ways) {
    way.frame = held_.whole(way.plan.planes, scene_);
    way.textures = textures_.load(textures_read(way.plan, way.job.scene), way.job.plate.limits);
    way.textures.show_in(way.frame);
  }
}

const Target& ShotWays::run(const ShotWay& way, RunTimes* times) {
  canvas_for(canvas_, window(), way.job.output)
      .paint(way.plan, way.frame, scene_, way.job.output, executor_, times);
  return canvas_->target();
}

void ShotWays::time(std::vector<ShotWay>& ways, int rounds) {
  std::vector<Timed> timed;
  for (const ShotWay& way : ways) timed.push_back({[&] { run(way); }, Clock::kWall});
  for (const Timed& work : timed) work.run();
  time_rounds(timed, rounds);
  for (std::size_t i = 0; i < ways.size(); ++i) ways[i].seconds = timed[i].best_seconds;
}

}  // namespace limpid
