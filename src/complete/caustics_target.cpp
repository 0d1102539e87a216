// Compiled once for each instruction set, as run/lanes_target.cpp is; the same holds here.
#include "complete/caustics_target.h"

#include <cmath>

#include "core/fetch.h"
#include "core/lanes.h"
#include "core/target_name.h"
#include "optics/fresnel.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// Rows have room for whole vectors. A vector's sines and cosines turn into the next one's; they
/// are taken anew before rounding adds up.
void add_sines(std::span<const SineOfRow> sines, int count, const SurfaceRow& to) {
  constexpr int kTurns = 64;
  constexpr double kTurn = 6.283185307179586;
  const Lane iota(hn::Iota(kD, 0.0f));
  for (const SineOfRow& wave : sines) {
    const Lane turn_cos(std::cos(kLanes * wave.step)), turn_sin(std::sin(kLanes * wave.step));
    const Lane amplitude(wave.amplitude), slope_x(wave.slope_x), slope_y(wave.slope_y);
    const Lane own = Lane(std::fmod(wave.step, kTurn)) * iota;
    Lane cosine(1), sine(0);
    for (int i = 0; i < count; i += kLanes) {
      if (i % (kLanes * kTurns) == 0) {
        const Lane phase = Lane(std::fmod(wave.phase + i * wave.step, kTurn)) + own;
        cosine = cos(phase), sine = sin(phase);
      }
      const auto add = [&](float* row, Lane value) LIMPID_LANES_LAMBDA {
        hn::StoreU(hn::Add(hn::LoadU(kD, row + i), value.v), kD, row + i);
      };
      add(to.height, amplitude * sine);
      add(to.slope_x, slope_x * cosine);
      add(to.slope_y, slope_y * cosine);
      const Lane turned = cosine * turn_cos - sine * turn_sin;
      sine = sine * turn_cos + cosine * turn_sin;
      cosine = turned;
    }
  }
}

struct Bottom {
  const LightRow& light;

  static LIMPID_LANES_INLINE Lane within(Lane at, int count) {
    return min(max(at, Lane(0)), Lane(count - 1));
  }
  LIMPID_LANES_INLINE Lane cell_of(Lane at) const {
    return at * Lane(light.per_cell) + Lane(light.cell_x);
  }
  LIMPID_LANES_INLINE VI index(VI x, VI y) const {
    return hn::Add(hn::Mul(y, hn::Set(kDI, light.across)), x);
  }
  LIMPID_LANES_INLINE Lane nearest(Lane x, Lane y) const {
    const VI column = whole_of(within(cell_of(x) + Lane(0.5), light.across));
    const VI row = whole_of(within(cell_of(y) + Lane(0.5), light.down));
    return fetch(light.bottom, Places(index(column, row)));
  }
  LIMPID_LANES_INLINE Lane between(Lane x, Lane y) const {
    const Lane at_x = within(cell_of(x), light.across - 1),
               at_y = within(cell_of(y), light.down - 1);
    const Lane column = floor(at_x), row = floor(at_y);
    const Places upper(index(whole_of(column), whole_of(row)));
    const Pair top = fetch_pairs(light.bottom, upper);
    const Pair low = fetch_pairs(light.bottom + light.across, upper);
    const Lane u = at_x - column;
    return lerp(lerp(top.left, top.right, u), lerp(low.left, low.right, u), at_y - row);
  }
};

void follow(const LightRow& light, int count, const SurfaceRow& surface, const SplatRow& to) {
  const Bottom bottom{light};
  const Lane iota(hn::Iota(kD, 0.0f)), one(1), row_y(light.at_y), per_length(light.per_length);
  const Lane sun_x(light.sun_x), sun_y(light.sun_y), sun_z(light.sun_z), eta(light.eta);
  for (int i = 0; i < count; i += kLanes) {
    const Lane slope_x(hn::LoadU(kD, surface.slope_x + i)),
        slope_y(hn::LoadU(kD, surface.slope_y + i));
    const Lane height(hn::LoadU(kD, surface.height + i));
    // The cosine of incidence, times the length of the normal (-slope_x, -slope_y, 1).
    const Lane facing = sun_z - sun_x * slope_x - sun_y * slope_y;
    const Lane per_normal = one / sqrt(one + slope_x * slope_x + slope_y * slope_y);
    const Lane cosine = facing * per_normal;
    const Lane left = max(one - eta * eta * (one - cosine * cosine), Lane(0));
    const Lane bend = (eta * cosine - sqrt(left)) * per_normal;
    const Lane per_sink = one / max(eta * sun_z - bend, Lane(0.02));
    const Lane aside_x = (Lane(0) - (eta * sun_x + bend * slope_x)) * per_sink;
    const Lane aside_y = (Lane(0) - (eta * sun_y + bend * slope_y)) * per_sink;
    const Lane gain_x = (aside_x - Lane(light.calm_x)) * per_length;
    const Lane gain_y = (aside_y - Lane(light.calm_y)) * per_length;
    const Lane row_x = Lane(light.first_x) + Lane(light.step_x) * (Lane(i) + iota);
    const Lane from_x = row_x + height * per_length * aside_x;
    const Lane from_y = row_y + height * per_length * aside_y;
    Lane depth = bottom.nearest(row_x, row_y);
    depth = bottom.between(from_x + depth * gain_x, from_y + depth * gain_y);
    const Lane x = from_x + depth * gain_x, y = from_y + depth * gain_y;
    const Mask inside =
        x > Lane(-1) && y > Lane(-1) && x < Lane(light.width) && y < Lane(light.height);
    const Lane column = select(inside, floor(x), Lane(-1)),
               row = select(inside, floor(y), Lane(-1));
    Lane power = max(facing, Lane(0)) * Lane(light.share);
    if (light.per_calm > 0) {
      power = power * Lane(light.per_calm) * (one - fresnel_exact(cosine, Lane(light.ior)));
    }
    const Lane weight = select(inside, power, Lane(0));
    const Lane u = select(inside, x - column, Lane(0)), v = select(inside, y - row, Lane(0));
    const VI texel = hn::Add(hn::Mul(whole_of(row + one), hn::Set(kDI, light.width + 2)),
                             whole_of(column + one));
    const Lane below = weight * v, above = weight - below;
    hn::StoreU(texel, kDI, to.texel + i);
    hn::StoreU((above * (one - u)).v, kD, to.here + i);
    hn::StoreU((above * u).v, kD, to.right + i);
    hn::StoreU((below * (one - u)).v, kD, to.below + i);
    hn::StoreU((below * u).v, kD, to.beside + i);
  }
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const CausticsTarget LIMPID_OF_TARGET(kCaustics_);
const CausticsTarget LIMPID_OF_TARGET(kCaustics_) = {HWY_NAMESPACE::add_sines,
                                                     HWY_NAMESPACE::follow};

}  // namespace limpid
