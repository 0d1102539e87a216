#pragma once
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <string_view>

#include "limpid/core/field.h"
#include "limpid/core/frame.h"
#include "limpid/core/state.h"

#include "op/pass.h"
#include "op/pixel.h"
#include "op/ranges.h"

/// @file
/// The operator contract.
///
/// An operator may read the frame's *input* planes anywhere and the running state of *its own
/// pixel*; it writes only the state of its own pixel. So any subset of the chain may be fused into
/// one pass, and tiles equal the full frame bit for bit. (Counter-example: an operator that blurred
/// `transmitted` would read state of its neighbours, which a fused pass has not made yet; it would
/// need a pass of its own.)
///
/// Its work is written once, as a template over the strip it is applied to: a run of pixels of one
/// row, in `double` for the reference, in SIMD lanes for the fused pass. An operator never fetches
/// a texel itself. It says where (a function from pixel to shift), the strip's samplers fetch, it
/// goes on with the sample:
///
///     using F = typename Strip::Number;
///     strip.each([&](Pixel<F>& p) { ... });              // a formula on the state
///     strip.own(plane, [&](Pixel<F>& p, F value) {});     // the input at the pixel itself
///     strip.own3(first, [&](Pixel<F>& p, Vec3<F> v) {});  // three planes in a row (normals)
///     strip.around3(first, [&](Pixel<F>& p, const Around<F>& v) {});  // and at its neighbours
///     strip.nearest(plane, where, [&](Pixel<F>& p, F value) {});
///     strip.bilinear(plane, where, [&](Pixel<F>& p, F value) {});
///     strip.bilinear_rgb(first, where, [&](Pixel<F>& p, Rgb<F> value) {});
///     strip.tiled_rgb(texture, where, [&](Pixel<F>& p, Rgb<F> value) {});  // in periods of it
///     strip.tiled_rgb(texture, width, where, [&](Pixel<F>& p, Rgb<F> value) {});  // from levels
///     strip.tiled_rgb_if(texture, wanted, where, [&](Pixel<F>& p, Rgb<F> value) {});
///     strip.tiled_slopes_if(slopes, wanted, width, where, [&](Pixel<F>&, SlopeMoments<F>) {});
///     strip.probe([&](Pixel<F>& p, const auto& tap) { ... });  // what is seen says where to look
///
/// with `where(const Pixel<F>&) -> Vec2<F>`, a shift in uv from the pixel's own centre. Taps are
/// clamped to the plane's data window; a plane that is absent reads as its role's `missing` value.
///
/// `width(const Pixel<F>&) -> F` is how many texels wide the pixel is in the texture, or in the
/// first level of SlopeLevels; at 1 or less the lookup is that without. `wanted(const Pixel<F>&)`
/// is a mask: where it does not hold, nothing may have been looked up, or `into` may have been
/// called as well, for other pixels of the vector, and keeps what it does there by select().
///
/// What operators do is run on double and on lanes, and written down as a shader, too
/// (src/shade/record.h). So for numbers of the type F
///
///   - a number decides no branch of C++: what to do where a mask holds, or how often, is said by
///     if_any(), repeat() and steps() (core/number.h). any() may leave out what would change
///     nothing;
///   - a body of those changes numbers and masks that live outside of it, nothing else, and may be
///     run several times;
///   - a mask stays a mask: auto, never bool;
///   - numbers of scene, look, frame and time enter by given(), F() is for the formula's own.
///
/// What is the same for red, green and blue is written once, with each(), pick() and only(): a
/// shader is a loop then, not three times as long.
///
/// A branch of C++ on a parameter or on what the frame has is no such branch: it makes another
/// shader. tests/shade records every operator with every model and runs what was written down.
///
/// A probe looks up as often as it likes, one pixel (or vector of pixels) at a time; the samplers
/// above know all lookups of a strip beforehand and are faster. tap.nearest(plane, shift) is the
/// texel there. tap.quad(shift) are the four texels that bilinear filtering mixes, k = 0 ... 3:
/// quad.weight(k), tap.read(plane, quad)[k], and tap.place(plane, quad, k), the shift of the centre
/// of the texel that was read (clamped to the plane's window like the read itself).
/// tap.heights(plane, lanes, from, to) is what Pass::heights says of all texels that ways of
/// these lanes from one shift to the other may pass, as one for all of them;
/// tap.range(plane, lanes, from, to) likewise what Pass::mirrored or Pass::lit says of a
/// plane. tap.wet() are the lanes whose pixels are wet: what the others look up is thrown away.
/// tap.lat_long_rgb(texture, at) is bilinear in a map of all directions (optics/surroundings.h): it
/// goes round in x and ends at the poles in y. tap.grid(view, at) is bilinear in a table of numbers
/// that nobody rendered, `at` in texels from the centre of its first one; it ends at its edges.

namespace limpid {

/// What an operator cannot do without, besides camera and water plane, which every chain has.
struct Needs {
  PlaneSet planes;
  bool sun = false;
  bool wave_map = false;
  bool environment = false;
};

/// What a job has, from which more can be made (plan/completers.h).
struct AtHand {
  PlaneSet planes;
  bool environment = false;
  bool waves = false;  ///< the scene's own
};

/// What of a plan its costs depend on.
struct Running {
  StateSet made;               ///< by operators that run
  PlaneSet planes, completed;  ///< that are read, and those that are made
};

/// What is known of a cell of the picture and of all that lookups along refracted rays may reach
/// from it. Depths are eye depths.
struct InReach {
  bool below = false;  ///< they look up the layer that lies below the water
  double nearest = -HUGE_VAL, farthest = HUGE_VAL;  ///< of what they look up
  double surface_far = HUGE_VAL;                    ///< of the water in the cell
  bool all_under = false;                           ///< every texel lies under water, for sure
};

/// How an operator measures the way through the water: what its path means.
struct PathLength {
  bool along_axis = false;  ///< of a view from the air: along the view's axis, else along the ray
  /// Behind this length it is as dense as it gets; nothing where `extinction` alone says so.
  std::optional<double> ends;
  Rgb<double> extinction{0, 0, 0};  ///< what a unit of the way takes from the light; 0: nothing
};

/// Cells in which an operator need not run, for those that have a name.
struct CellKind {
  std::string_view name, about;
};

/// What an operator does to pixels: ops/NAME_kernel.h has that of `Op`, whose parameters the public
/// header limpid/ops/NAME.h declares. It is an Operator, derived from `Op`.
template <class Op>
struct Kernel;

/// What an operator must tell of itself. `bound` is a promise: left out, whichever of the other
/// operators run, it changes no channel of the picture by more than this where `ranges` hold (0:
/// not a bit of it, and what makes nothing but kOutputTerms leaves those as they are). HUGE_VAL
/// where nothing is known. So that bounds add up, an operator passes on of the light before it a
/// share of at most 1, or widens Ranges::color by what more it passes on.
///
/// What it may tell besides, as static members; whoever reads them takes the default where an
/// operator has none:
///
///     // Widens or narrows what later bounds are made of to what holds after it, be it left out or
///     // not. Default: changes nothing.
///     void propagate_ranges(const Params&, const Pass&, Ranges&);
///     // How much more the picture changes than the bound of the operator which makes
///     // StatePart::kPosition says, when that one is left out. Default: HUGE_VAL for one that uses
///     // what comes of the position, else 0.
///     double displaced(const Params&, const Ranges&);
///     // How much the picture changes when the end of every way through the water is taken to be
///     // infinitely far: of an operator that hides it. Default: it hides nothing.
///     double beyond(const Params&, const Pass&, const Ranges&);
///     // Whether nothing that stands before the water changes what it does in such a cell, so that
///     // its test for that may be left out. Default: it has no test.
///     bool foreground_free(const Params&, const InReach&);
///     // Its taps, and those of `reach`, follow mirrored rays or the sun's. Default: false, they
///     // follow refracted ones.
///     constexpr bool kLooksAbove = true;
///     // How many times farther than `reach` says refracted rays go for its doing. Default: 1.
///     double stretch(const Params&, const Pass&);
///     // Cells in which it is skipped have this name. Default: none.
///     constexpr CellKind kSkipped;
///     // Sets parameters to what is better among what is at hand, and says so in a phrase; ""
///     where
///     // it leaves them. Default: leaves them.
///     std::string_view prefer(Params&, const AtHand&);
///     // Why it looks up the surroundings, though it could do without; "" where it does not.
///     std::string_view looks_around(const Params&, const AtHand&);
///     // What is wrong with what is at hand, a sentence; "" for nothing.
///     std::string_view warning(const Params&, const AtHand&);
///     // Planes that are made for it where the plate lacks them (plan/completers.h).
///     PlaneSet wants(const Params&, const AtHand&);
///     // Makes what of its parameters depends on the working space. Default: nothing does.
///     void work_in(const Primaries&, Params&);
///     // Whether its light comes from the sky, too.
///     bool lit_by_sky(const Params&);
///     // The waves that raise the water, if it has any; they live as long as the parameters.
///     Swell swell(const Params&);
///     // The water that what is mirrored in it is seen through, if it is one.
///     std::optional<WaterMedium> medium(const Params&, const Pass&);
///     // How it measures StatePart::kPath, for what is made of the path (job/deep_output.h).
///     PathLength path_length(const Params&);
///     // What it is expected to cost, in ns for each pixel (plan/predict.h). Default: 1.
///     double ns(const Params&, const Running&);
template <class T>
concept Operator = requires(const typename T::Params& params, StateSet made, const Pass& pass,
                            const Ranges& ranges) {
  { T::kName } -> std::convertible_to<std::string_view>;   // its table in look files
  { T::kAbout } -> std::convertible_to<std::string_view>;  // one sentence
  { T::kUses } -> std::convertible_to<StateSet>;           // state it reads
  { T::kMakes } -> std::convertible_to<StateSet>;          // state it writes, each part whole
  { T::fields() } -> std::same_as<std::span<const Field<typename T::Params>>>;
  { T::reads(params) } -> std::same_as<PlaneSet>;  // every plane it may tap
  { T::needs(params) } -> std::same_as<Needs>;     // without these it is dropped
  { T::reach(params) } -> std::same_as<double>;    // how far its taps go, in uv; tilts are below 1
  // The parameters make it the identity on all but kPath, given what the operators before it make.
  { T::neutral(params, made) } -> std::same_as<bool>;
  // At most this much of any channel of the picture is its doing, where `ranges` hold.
  { T::bound(params, pass, ranges) } -> std::same_as<double>;
  // and: template <class Strip> static void apply(const Params&, const Pass&, Strip&);
};

}  // namespace limpid
