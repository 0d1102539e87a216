#include "shade/interpret.h"

#include "limpid/core/error.h"

#include "op/bottom_layer.h"
#include "op/caustics_table.h"
#include "op/continuation.h"
#include "op/edge_surfaces.h"
#include "run/plain_taps.h"

namespace limpid {

/// Where the pixel is.
struct Interpreter::At {
  PlainTaps taps;
  double column;
  RowRays<double> row;
  int x, y;
};

Interpreter::Interpreter(const Recording& recording, const Pass& pass, const Frame& frame)
    : recording_(recording),
      pass_(pass),
      frame_(frame),
      values_(recording.nodes.size()),
      outputs_(recording.outputs.size()) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Node& node = recording.nodes[i];
    if (node.op == NodeOp::kLiteral) values_[i].of[0] = node.number;
    if (node.op == NodeOp::kGiven && recording.live[i]) {
      values_[i].of[0] = recording.given[static_cast<std::size_t>(node.what)].value;
    }
  }
  for (const Flow& flow : recording.flows) live_flows_.push_back(recording.is_live(flow));
}

const std::vector<double>& Interpreter::run(int x, int y) {
  const At at{PlainTaps(frame_, x, y), x - pass_.corner.x + 0.5,
              RowRays<double>(pass_, y - pass_.corner.y + 0.5), x, y};
  run_block(0, at);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    outputs_[i] = value(recording_.outputs[i].node).of[0];
  }
  return outputs_;
}

void Interpreter::run_block(int block, const At& at) {
  for (const Statement& s : recording_.blocks[static_cast<std::size_t>(block)].statements) {
    const auto what = static_cast<std::size_t>(s.what);
    if (s.kind == Statement::Kind::kNode && recording_.live[what]) run_node(s.what, at);
    if (s.kind == Statement::Kind::kFlow && live_flows_[what]) run_flow(recording_.flows[what], at);
  }
}

void Interpreter::run_flow(const Flow& flow, const At& at) {
  const auto set = [&](auto from) {
    std::vector<Value> now;  // all at once: one may be the source of another
    for (const Flow::Merge& m : flow.merges) now.push_back(from(m) < 0 ? Value{} : value(from(m)));
    for (std::size_t k = 0; k < now.size(); ++k) {
      values_[static_cast<std::size_t>(flow.merges[k].merged)] = now[k];
    }
  };
  set([](const Flow::Merge& m) { return m.before; });
  const auto after = [](const Flow::Merge& m) { return m.after; };
  if (!flow.loops) {
    if (value(flow.condition).of[0] == 0) return;
    run_block(flow.block, at);
    return set(after);
  }
  for (int i = flow.begin; i < flow.end; ++i) {
    values_[static_cast<std::size_t>(flow.index)].of[0] = i;
    run_block(flow.block, at);
    const bool goes_on = flow.condition < 0 || value(flow.condition).of[0] != 0;
    set(after);
    if (!goes_on) break;
  }
}

void Interpreter::run_node(int id, const At& at) {
  const Node& node = recording_.nodes[static_cast<std::size_t>(id)];
  Value& made = values_[static_cast<std::size_t>(id)];
  const auto arg = [&](std::size_t k) { return value(node.args[k]).of[0]; };
  const auto number = [&](double x) { made.of[0] = x; };
  const auto two = [&](const Vec2<double>& v) { made = {{v.x, v.y, 0, 0}}; };
  const auto three = [&](const Rgb<double>& v) { made = {{v.r, v.g, v.b, 0}}; };
  const PlaneId plane = static_cast<PlaneId>(node.what);
  const auto shift = [&] { return Vec2<double>{arg(0), arg(1)}; };
  const auto quad = [&] {
    const Value& q = value(node.args[0]);
    return PlainTaps::Quad{at.x + static_cast<int>(q.of[0]), at.y + static_cast<int>(q.of[1]),
                           q.of[2], q.of[3]};
  };
  const auto texture = [&]() -> const Texture& {
    switch (static_cast<TextureId>(node.what)) {
      case TextureId::kWaveMap:
        return pass_.wave_map;
      case TextureId::kEnvironment:
        return pass_.environment;
      case TextureId::kEdgeColors:
        return pass_.edge_surfaces->colors;
      case TextureId::kEdgeShape:
        return pass_.edge_surfaces->shape;
      case TextureId::kContinuation:
        return pass_.continuation->colors;
      case TextureId::kBottomColors:
        return pass_.bottom_layer->colors;
      case TextureId::kBottomShape:
        return pass_.bottom_layer->shape;
      default:
        throw Error("a recording looks up a texture that is none");
    }
  };
  if (is_arithmetic(node.op)) {
    const auto known = [&](std::size_t k) { return node.args[k] < 0 ? 0.0 : arg(k); };
    return number(computed(node.op, known(0), known(1), known(2)));
  }
  switch (node.op) {
    case NodeOp::kPart:
      return number(value(node.args[0]).of[node.what]);
    case NodeOp::kColumn:
      return number(at.column);
    case NodeOp::kRow: {
      const RowRays<double>& r = at.row;
      const double row[kRowValues] = {r.origin.x, r.origin.y, r.origin.z,  r.ray.x,     r.ray.y,
                                      r.ray.z,    r.v,        r.calm_over, r.calm_under};
      return number(row[node.what]);
    }
    case NodeOp::kOwn:
      return number(at.taps.own(plane));
    case NodeOp::kBeside:
      return number(at.taps.beside(plane, static_cast<int>(node.number)));
    case NodeOp::kNearest:
      return number(at.taps.nearest(plane, shift()));
    case NodeOp::kBilinear:
      return number(at.taps.bilinear(plane, shift()));
    case NodeOp::kBilinear3:
      return three({at.taps.bilinear(plane, shift()),
                    at.taps.bilinear(plane_after(plane, 1), shift()),
                    at.taps.bilinear(plane_after(plane, 2), shift())});
    case NodeOp::kQuad: {
      const PlainTaps::Quad q = at.taps.quad(shift());
      made = {{double(q.x - at.x), double(q.y - at.y), q.u, q.v}};
      return;
    }
    case NodeOp::kRead: {
      const Four<double> texels = at.taps.read(plane, quad());
      made = {{texels[0], texels[1], texels[2], texels[3]}};
      return;
    }
    case NodeOp::kPlace:
      return two(at.taps.place(plane, quad(), static_cast<int>(node.number)));
    case NodeOp::kTiled:
      return three(tiled_rgb_at(texture(), shift()));
    case NodeOp::kTiledWide:
      return three(tiled_rgb_at(texture(), shift(), arg(2)));
    case NodeOp::kSlopeMean:
      return two(tiled_slopes_at(*pass_.wave_slopes, shift(), arg(2)).mean);
    case NodeOp::kSlopeSquare: {
      const Sym2<double> s = tiled_slopes_at(*pass_.wave_slopes, shift(), arg(2)).square;
      return three({s.xx, s.xy, s.yy});
    }
    case NodeOp::kLatLong:
      return three(lat_long_rgb_at(texture(), shift()));
    case NodeOp::kGrid: {
      const int place = node.what - static_cast<int>(TextureId::kCaustics);
      const CausticsTable* table = pass_.caustics;
      while (place >= table->first + CausticsTable::kMaxLevels) table = table->in_water;
      const auto level = static_cast<std::size_t>(place - table->first);
      return number(grid_at(table->levels[level].light, shift()));
    }
    default:
      return;
  }
}

}  // namespace limpid
