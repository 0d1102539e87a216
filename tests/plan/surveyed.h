#pragma once
#include <map>
#include <utility>

#include "limpid/plan/survey.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "complete/completer.h"
#include "op/pass.h"
#include "support.h"

/// The plainest use of a survey: for each kind of cell the whole picture is run without the steps
/// that such cells skip, and the pixels of these cells are taken from this picture.

namespace limpid::test {

inline Survey surveyed(const Plan& plan, const Frame& frame, const Scene& scene) {
  Survey survey;
  const Pass pass(scene, frame, plan.look.water.ior, plan.made);
  survey.make(plan, frame, pass, *make_executor(1));
  return survey;
}

/// As runners do it: with what completers make.
inline Survey surveyed_completed(const Plan& plan, const Frame& frame, const Scene& scene) {
  Completer completer;
  const Pass before(scene, frame, plan.look.water.ior, plan.made);
  return surveyed(plan, completer.complete(plan, frame, before, *make_executor(1)), scene);
}

using RunPlan = void (*)(const Plan&, const Frame&, const Scene&, const Target&);

inline void by_reference(const Plan& plan, const Frame& frame, const Scene& scene,
                         const Target& target) {
  run_reference(plan, frame, scene, target);
}
inline void by_fused(const Plan& plan, const Frame& frame, const Scene& scene,
                     const Target& target) {
  run_fused(plan, frame, scene, target, *make_executor(1));
}

inline Picture picture_of(const Plan& plan, const Frame& frame, const Scene& scene, RunPlan run) {
  Picture picture(frame.work());
  run(plan, frame, scene, picture.target);
  return picture;
}

/// The picture with every pixel run as the cells of this kind are. State that is made stays
/// declared as made. A scene just nearer than "nothing hit", without offset, gives an endless path.
inline Picture run_as(CellNeeds kind, Plan plan, Frame frame, const Scene& scene, RunPlan run) {
  plan.max_error = 0;
  const Rect window = frame.plane(PlaneId::kDepth).window;
  Buffers far(window);
  Completer completer;
  if (kind.opaque) {
    // Of the bottom as it is.
    const Pass pass_before(scene, frame, plan.look.water.ior, plan.made);
    const Frame whole = completer.complete(plan, frame, pass_before, *make_executor(1));
    for (int i = 0; i < kPlaneCount; ++i) {
      const PlaneId id = static_cast<PlaneId>(i);
      const PlaneSet of_bottom = kAlbedoPlanes | PlaneSet{PlaneId::kBasin, PlaneId::kSurfaceShadow};
      if (!(plan.completed & of_bottom).has(id)) continue;
      frame.planes[index_of(id)] = whole.planes[index_of(id)];
      plan.planes = plan.planes | PlaneSet{id};
    }
    const View<const float>& depth = frame.plane(PlaneId::kDepth);
    const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
    const Pass pass(scene, frame, 1.333, {});
    far.set(PlaneId::kDepth, [&](int x, int y) {
      const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
      const double water = surface ? surface.at(x, y) : rays.calm_depth(x - pass.corner.x + 0.5);
      return water < depth.at(x, y) && depth.at(x, y) < kInf ? 9e29f : depth.at(x, y);
    });
    frame.planes[index_of(PlaneId::kDepth)] = far.frame.plane(PlaneId::kDepth);
    for (PlaneId id :
         {PlaneId::kBelowR, PlaneId::kBelowG, PlaneId::kBelowB, PlaneId::kBelowDepth}) {
      frame.planes[index_of(id)] = {};
      plan.planes = plan.planes - PlaneSet{id};
    }
    Refraction::Params& params = plan.look.of<Refraction>();
    params.model = Refraction::Model::kNormalOffset;
    params.strength = 0;
    params.rejection = Refraction::Rejection::kNone;
    params.off_frame = Refraction::OffFrame::kClamp;
  } else if (kind.open) {
    // Snap reads depths only for its test, except of rays that know their depths, and of layers
    // below, whose empty places it leaves.
    Refraction::Params& params = plan.look.of<Refraction>();
    const bool knows = params.model == Refraction::Model::kSnell && params.steps != 0;
    const bool below = frame.present().covers(kBelowPlanes);
    if (params.rejection == Refraction::Rejection::kSnap && !knows && !below) {
      params.rejection = Refraction::Rejection::kNone;
    }
  }
  Chain::for_each([&]<class Op, int I>() {
    const bool stands_in = kind.opaque && std::is_same_v<Op, Refraction>;
    if (!kind.needs(I) && !stands_in) plan.operators[I].verdict = Verdict::kInvisible;
  });
  return picture_of(plan, frame, scene, run);
}

/// Calls visit(needs, x, y, picture) for each pixel, with the picture that its cell's kind gives.
template <class Visit>
void for_each_as_surveyed(const Survey& survey, const Plan& plan, const Frame& frame,
                          const Scene& scene, RunPlan run, Visit&& visit) {
  std::map<std::pair<int, int>, Picture> pictures;
  for (int i = 0; i < survey.count(); ++i) {
    const CellNeeds& needs = survey.cell(i);
    const std::pair<int, int> kind{needs.skips, needs.opaque * 2 + needs.open};
    if (!pictures.contains(kind)) {
      pictures.emplace(kind, run_as(needs, plan, frame, scene, run));
    }
    const Picture& picture = pictures.at(kind);
    const Rect pixels = survey.pixels(i);
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) visit(needs, x, y, picture);
    }
  }
}

}  // namespace limpid::test
