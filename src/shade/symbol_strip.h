#pragma once
#include "limpid/core/error.h"

#include "op/bottom_layer.h"
#include "op/caustics_table.h"
#include "op/continuation.h"
#include "op/edge_surfaces.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "shade/symbol.h"

namespace limpid {

/// The strip of one recorded pixel (op/operator.h has the functions of a strip): its samplers
/// record lookups.
class SymbolStrip {
 public:
  using Number = Symbol;

  explicit SymbolStrip(const Pass& pass) : pass_(pass) {}
  Pixel<Symbol>& pixel() { return pixel_; }

  template <class Fn>
  void each(Fn&& fn) {
    fn(pixel_);
  }
  template <class Into>
  void own(PlaneId plane, Into&& into) {
    into(pixel_, own_at(plane));
  }
  template <class Into>
  void own3(PlaneId first, Into&& into) {
    into(pixel_,
         Vec3<Symbol>{own_at(first), own_at(plane_after(first, 1)), own_at(plane_after(first, 2))});
  }
  template <class Into>
  void around3(PlaneId first, Into&& into) {
    Around<Symbol> values;
    for (int k = 0; k < 9; ++k) {
      values.at[k] = {beside(first, k), beside(plane_after(first, 1), k),
                      beside(plane_after(first, 2), k)};
    }
    into(pixel_, values);
  }
  template <class Where, class Into>
  void nearest(PlaneId plane, Where&& where, Into&& into) {
    into(pixel_, Tap{*this}.nearest(plane, where(pixel_)));
  }
  template <class Where, class Into>
  void bilinear(PlaneId plane, Where&& where, Into&& into) {
    into(pixel_, at(plane, NodeOp::kBilinear, where(pixel_)));
  }
  template <class Where, class Into>
  void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    const Vec2<Symbol> shift = where(pixel_);
    if (!pass_.planes.has(first)) {
      return into(pixel_, Rgb<Symbol>{missing(first), missing(first), missing(first)});
    }
    into(pixel_, rgb(record(NodeOp::kBilinear3, NodeType::kThree, shift, index_of(first))));
  }
  template <class Where, class Into>
  void tiled_rgb(const Texture& texture, Where&& where, Into&& into) {
    into(pixel_, tiled(texture, where(pixel_)));
  }
  template <class Width, class Where, class Into>
  void tiled_rgb(const Texture& texture, Width&& width, Where&& where, Into&& into) {
    if (!texture.levels) return tiled_rgb(texture, where, into);
    const Vec2<Symbol> periods = where(pixel_);
    into(pixel_, rgb(record(NodeOp::kTiledWide, NodeType::kThree, periods, id_of(texture),
                            width(pixel_).node())));
  }
  template <class Wanted, class Where, class Into>
  void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where, Into&& into) {
    if_any(wanted(pixel_), [&] { tiled_rgb(texture, where, into); });
  }
  template <class Wanted, class Width, class Where, class Into>
  void tiled_slopes_if(const SlopeLevels&, Wanted&& wanted, Width&& width, Where&& where,
                       Into&& into) {
    if_any(wanted(pixel_), [&] {
      const Vec2<Symbol> periods = where(pixel_);
      const int wide = width(pixel_).node(), id = static_cast<int>(TextureId::kWaveSlopes);
      const int mean = record(NodeOp::kSlopeMean, NodeType::kTwo, periods, id, wide);
      const int square = record(NodeOp::kSlopeSquare, NodeType::kThree, periods, id, wide);
      into(pixel_, SlopeMoments<Symbol>{{part(mean, 0), part(mean, 1)},
                                        {part(square, 0), part(square, 1), part(square, 2)}});
    });
  }

  struct Quad {
    Symbol corner;  ///< kQuad; a handle, because a block may select it
    Symbol u, v;
    Symbol weight(int k) const { return (k & 1 ? u : Symbol(1) - u) * (k & 2 ? v : Symbol(1) - v); }
  };

  struct Tap {
    const SymbolStrip& strip;

    Symbol nearest(PlaneId plane, Vec2<Symbol> shift) const {
      return strip.at(plane, NodeOp::kNearest, shift);
    }
    Symbol own(PlaneId plane) const { return strip.own_at(plane); }
    Quad quad(Vec2<Symbol> shift) const {
      const int node = record(NodeOp::kQuad, NodeType::kFour, shift);
      return {Symbol::of(node), part(node, 2), part(node, 3)};
    }
    Four<Symbol> read(PlaneId plane, const Quad& quad) const {
      if (!strip.pass_.planes.has(plane)) {
        return {missing(plane), missing(plane), missing(plane), missing(plane)};
      }
      const int four = Recorder::current().add(NodeOp::kRead, NodeType::kFour,
                                               {quad.corner.node(), -1, -1}, index_of(plane));
      return {part(four, 0), part(four, 1), part(four, 2), part(four, 3)};
    }
    Vec2<Symbol> place(PlaneId plane, const Quad& quad, int k) const {
      const int two = Recorder::current().add(NodeOp::kPlace, NodeType::kTwo,
                                              {quad.corner.node(), -1, -1}, index_of(plane), k);
      return {part(two, 0), part(two, 1)};
    }
    /// Not known when recording.
    static SeenHeights heights(PlaneId, const SymbolMask&, Vec2<Symbol>, Vec2<Symbol>) {
      return {};
    }
    static SeenRange range(PlaneId, const SymbolMask&, Vec2<Symbol>, Vec2<Symbol>) { return {}; }
    static SymbolMask wet() { return SymbolMask(true); }
    Rgb<Symbol> lat_long_rgb(const Texture& map, Vec2<Symbol> place) const {
      return rgb(record(NodeOp::kLatLong, NodeType::kThree, place, strip.id_of(map)));
    }
    Symbol grid(const View<const float>& table, Vec2<Symbol> texels) const {
      return Symbol::of(record(NodeOp::kGrid, NodeType::kNumber, texels, strip.id_of(table)));
    }
  };

  template <class Fn>
  void probe(Fn&& fn) {
    fn(pixel_, Tap{*this});
  }

  Symbol own_at(PlaneId plane) const {
    if (!pass_.planes.has(plane)) return missing(plane);
    return Symbol::of(
        Recorder::current().add(NodeOp::kOwn, NodeType::kNumber, {-1, -1, -1}, index_of(plane)));
  }

 private:
  static int record(NodeOp op, NodeType type, const Vec2<Symbol>& at, int what = 0, int wide = -1) {
    return Recorder::current().add(op, type, {at.x.node(), at.y.node(), wide}, what);
  }
  static Symbol part(int vector, int k) { return Symbol::of(Recorder::current().part(vector, k)); }
  static Rgb<Symbol> rgb(int three) { return {part(three, 0), part(three, 1), part(three, 2)}; }
  static Symbol missing(PlaneId plane) {
    for (const Role& role : roles()) {
      if (role.planes().has(plane)) return Symbol(double(role.missing));
    }
    throw Error("a plane without a role");
  }

  Symbol at(PlaneId plane, NodeOp op, const Vec2<Symbol>& shift) const {
    if (!pass_.planes.has(plane)) return missing(plane);
    return Symbol::of(record(op, NodeType::kNumber, shift, index_of(plane)));
  }
  Symbol beside(PlaneId plane, int k) const {
    if (!pass_.planes.has(plane)) return missing(plane);
    return Symbol::of(Recorder::current().add(NodeOp::kBeside, NodeType::kNumber, {-1, -1, -1},
                                              index_of(plane), k));
  }
  Rgb<Symbol> tiled(const Texture& texture, const Vec2<Symbol>& periods) const {
    return rgb(record(NodeOp::kTiled, NodeType::kThree, periods, id_of(texture)));
  }

  int id_of(const Texture& texture) const {
    const auto is = [&](const Texture& known) { return &texture == &known; };
    const auto id = [](TextureId name) { return static_cast<int>(name); };
    if (is(pass_.wave_map)) return id(TextureId::kWaveMap);
    if (is(pass_.environment)) return id(TextureId::kEnvironment);
    if (pass_.edge_surfaces && is(pass_.edge_surfaces->colors)) return id(TextureId::kEdgeColors);
    if (pass_.edge_surfaces && is(pass_.edge_surfaces->shape)) return id(TextureId::kEdgeShape);
    if (pass_.continuation && is(pass_.continuation->colors)) return id(TextureId::kContinuation);
    if (pass_.bottom_layer && is(pass_.bottom_layer->colors)) return id(TextureId::kBottomColors);
    if (pass_.bottom_layer && is(pass_.bottom_layer->shape)) return id(TextureId::kBottomShape);
    throw Error("an operator looks up a texture that no shader knows");
  }
  int id_of(const View<const float>& table) const {
    for (const CausticsTable* all = pass_.caustics; all; all = all->in_water) {
      for (int k = 0; k < all->count; ++k) {
        const auto& level = all->levels[static_cast<std::size_t>(k)];
        if (&table == &level.light) return static_cast<int>(TextureId::kCaustics) + all->first + k;
      }
    }
    throw Error("an operator looks up a table that no shader knows");
  }

  const Pass& pass_;
  Pixel<Symbol> pixel_;
};

}  // namespace limpid
