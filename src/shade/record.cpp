#include "shade/record.h"

#include "op/pixel_start.h"
#include "ops/kernels.h"
#include "run/aov_of.h"
#include "shade/symbol_strip.h"

namespace limpid {
namespace {

/// The rays of a row, as symbols.
RowRays<Symbol> row_of(const Pass& pass) {
  const auto value = [](RowValue which) {
    return Symbol::of(Recorder::current().add(NodeOp::kRow, NodeType::kNumber, {-1, -1, -1},
                                              static_cast<int>(which)));
  };
  const auto product = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  };
  RowRays<Symbol> row;
  row.origin = {value(RowValue::kOriginX), value(RowValue::kOriginY), value(RowValue::kOriginZ)};
  row.ray = {value(RowValue::kRayX), value(RowValue::kRayY), value(RowValue::kRayZ)};
  row.origin_dx = vec3_of<Symbol>(pass.rays.origin_dx);
  row.ray_dx = vec3_of<Symbol>(pass.rays.ray_dx);
  row.v = value(RowValue::kV);
  row.calm_over = value(RowValue::kCalmOver);
  row.calm_under = value(RowValue::kCalmUnder);
  row.calm_over_dx = given<Symbol>(-product(pass.up, pass.rays.origin_dx), "camera.calm_over_dx");
  row.calm_under_dx = given<Symbol>(product(pass.up, pass.rays.ray_dx), "camera.calm_under_dx");
  row.window = given<Symbol>(pass.submersible ? pass.near : 0, "camera.window");
  return row;
}

}  // namespace

Recording record(const Plan& plan, const Pass& frame_pass, std::span<const Aov> list) {
  // The number of levels of a caustics table differs from frame to frame: the program has all
  // levels, and absent levels cover no place.
  Pass pass = frame_pass;
  CausticsTable tables[2];  // of the bottom, and of the water
  const CausticsTable** named = &pass.caustics;
  for (CausticsTable& table : tables) {
    if (!*named) break;
    table = **named;
    for (int k = table.count; k < CausticsTable::kMaxLevels; ++k) {
      table.levels[static_cast<std::size_t>(k)] = {};  // may be left from another frame
    }
    table.count = CausticsTable::kMaxLevels;
    *named = &table;
    named = &table.in_water;
  }
  const NameTable names(plan, pass);
  Recorder recorder(names);
  SymbolStrip strip(pass);
  Pixel<Symbol>& p = strip.pixel();

  recorder.title("pixel");
  const Symbol x = Symbol::of(recorder.add(NodeOp::kColumn, NodeType::kNumber, {-1, -1, -1}));
  const RowRays<Symbol> row = row_of(pass);
  const Symbol dry = strip.own_at(PlaneId::kDepth);
  const Symbol water = pass.planes.has(PlaneId::kSurfaceDepth)
                           ? strip.own_at(PlaneId::kSurfaceDepth)
                           : row.calm_depth(x);
  const Rgb<Symbol> color{strip.own_at(PlaneId::kColorR), strip.own_at(PlaneId::kColorG),
                          strip.own_at(PlaneId::kColorB)};
  const PixelStart<Symbol> start(pass, row, x, water, dry, SymbolMask(true));

  Rgb<Symbol> picture = color;
  // Water is opaque; a dry pixel keeps the plate's alpha.
  Symbol alpha = pass.planes.has(PlaneId::kColorA) ? strip.own_at(PlaneId::kColorA) : Symbol(1.0);
  const Vec2<Symbol> uv{x * given<Symbol>(1.0 / pass.size.x, "camera.column"), row.v};
  std::vector<Vec3<Symbol>> shown;
  for (const Aov aov : list) {
    const double dry_value = aovs()[static_cast<std::size_t>(aov)].dry;
    shown.push_back(dry_aov_of(aov, color, uv, Symbol(dry_value)));
  }
  if_any(start.wet, [&] {
    begin_pixel(pass, row, x, start.side, start.surface_depth, start.dry_depth, p);
    begin_state(kWholeState, pass, color, p);
    Kernels::for_each([&]<class Op, int I>() {
      if (!plan.keeps(I)) return;
      recorder.title(std::string(Op::kName));
      Op::apply(plan.look.of<Op>(), pass, strip);
    });
    recorder.title("picture");
    picture = p.beauty();
    alpha = Symbol(1.0);
    for (std::size_t i = 0; i < list.size(); ++i) shown[i] = aov_of(p, list[i]);
  });

  recorder.output("color.r", picture.r.node());
  recorder.output("color.g", picture.g.node());
  recorder.output("color.b", picture.b.node());
  recorder.output("color.a", alpha.node());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const AovInfo& info = aovs()[static_cast<std::size_t>(list[i])];
    const Symbol* parts[] = {&shown[i].x, &shown[i].y, &shown[i].z};
    for (std::size_t k = 0; k < info.suffixes.size(); ++k) {
      recorder.output(std::string(info.name) + "." + info.suffixes[k], parts[k]->node());
    }
  }
  return recorder.take();
}

}  // namespace limpid
