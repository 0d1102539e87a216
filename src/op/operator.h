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
/// `transmitted` would read state of its neighbours, which a fused pass has not computed yet; it
/// would need a pass of its own.)
///
/// The formula is written once, as a template over the strip to which it is applied: a run of
/// pixels of one row, in `double` for the reference, in SIMD lanes for the fused pass. An operator
/// never fetches a texel itself: it passes a function from the pixel to the shift of a lookup, a
/// sampler of the strip fetches the texels, and the operator continues with the sample:
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
///     strip.probe([&](Pixel<F>& p, const auto& tap) { ... });  // places that depend on samples;
///                                                       // tap.own(plane): at the pixel itself
///
/// with `where(const Pixel<F>&) -> Vec2<F>`, a shift in uv from the pixel's own centre. Taps are
/// clamped to the plane's data window; a plane that is absent reads as its role's `missing` value.
///
/// `width(const Pixel<F>&) -> F` is the width of the pixel in texels of the texture, or of the
/// first level of SlopeLevels; at 1 or less the lookup is the one without `width`. `wanted(const
/// Pixel<F>&)` is a mask: where it does not hold, the lookup may be skipped, or the last function
/// may be called nevertheless, because other pixels of the vector need it; so that function must
/// change state by select().
///
/// Operators run on double and on lanes, and are recorded as a shader, too (src/shade/record.h). So
/// for numbers of the type F
///
///   - no branch of C++ depends on a number: if_any(), repeat() and steps() (core/number.h)
///     are the branches and loops. any() may only skip work without effect;
///   - a body of these functions changes numbers and masks that live outside of it, nothing else,
///     and may run several times;
///   - a mask stays a mask: auto, never bool;
///   - numbers of scene, look, frame and time enter by given(); F() is for constants of a formula.
///
/// Write code that is the same for red, green and blue once, with each(), pick() and only(): a
/// shader then has a loop instead of three copies.
///
/// A branch of C++ on a parameter or on the planes of the frame is allowed: it makes another
/// shader. tests/shade records every operator with every model and runs the recording.
///
/// A probe may make any number of lookups, one pixel (or vector of pixels) at a time; the samplers
/// above know all lookups of a strip beforehand and are faster. tap.nearest(plane, shift) is the
/// texel there. tap.quad(shift) are the four texels that bilinear filtering mixes, k = 0 ... 3:
/// quad.weight(k), tap.read(plane, quad)[k], and tap.place(plane, quad, k), the shift of the centre
/// of the texel that was read (clamped to the plane's window like the read itself).
/// tap.heights(plane, lanes, from, to) is the bound of Pass::heights on all texels that rays of
/// these lanes may pass between the two shifts, one bound for all lanes; tap.range(plane, lanes,
/// from, to) likewise the bound of Pass::mirrored or Pass::lit. tap.wet() are the lanes whose
/// pixels are wet: lookups of the other lanes are discarded. tap.lat_long_rgb(texture, at) is
/// bilinear in a map of all directions (optics/surroundings.h): it wraps around in x and ends at
/// the poles in y. tap.grid(view, at) is bilinear in a table made by a completer, `at` in texels
/// from the centre of its first texel; it ends at its edges.

namespace limpid {

/// Inputs without which an operator cannot run, besides camera and water plane, which every chain
/// has.
struct Needs {
  PlaneSet planes;
  bool sun = false;
  bool wave_map = false;
  bool environment = false;
};

/// Inputs of a job, from which completers can make more (plan/completers.h).
struct AtHand {
  PlaneSet planes;
  bool environment = false;
  bool waves = false;  ///< waves of the scene file
};

/// The parts of a plan on which an operator's cost depends.
struct Running {
  StateSet made;               ///< made by operators that run
  PlaneSet planes, completed;  ///< planes that are read, and planes that are completed
};

/// Properties of a cell of the picture and of all texels that refracted lookups from it may
/// read. Depths are eye depths.
struct InReach {
  bool below = false;                               ///< the lookups read the layer below the water
  double nearest = -HUGE_VAL, farthest = HUGE_VAL;  ///< of the texels that the lookups read
  double surface_far = HUGE_VAL;                    ///< of the water in the cell
  bool all_under = false;                           ///< every texel surely lies under water
};

/// How an operator measures the path through the water.
struct PathMeasure {
  bool along_axis = false;  ///< for a view from the air: along the view's axis, else along the ray
  /// Beyond this length the water gets no denser; empty where `extinction` alone decides.
  std::optional<double> ends;
  Rgb<double> extinction{0, 0, 0};  ///< light lost per unit of the path; 0: none
};

/// The name of cells in which an operator need not run.
struct CellKind {
  std::string_view name, about;
};

/// The kernel of an operator: ops/NAME_kernel.h specialises it for `Op`, whose parameters the
/// public header limpid/ops/NAME.h declares. The kernel is an Operator, derived from `Op`.
template <class Op>
struct Kernel;

/// The required members of an operator. `bound` is a promise: leaving the operator out, for any set
/// of other operators that run, changes no channel of the picture by more than this number where
/// `ranges` hold. 0 means that no bit changes; an operator that makes only kOutputTerms must then
/// leave them unchanged. HUGE_VAL means that no bound is known. So that bounds add up, an operator
/// must transmit at most all of the light before it, or widen Ranges::color by the light that it
/// adds.
///
/// Optional static members; callers take the default where an operator has none:
///
///     // Widens or narrows the ranges from which later bounds are made, so that they hold with
///     // and without this operator. Default: changes nothing.
///     void propagate_ranges(const Params&, const Pass&, Ranges&);
///     // How much more the picture changes than the bound of the operator that makes
///     // StatePart::kPosition, if that operator is left out. Default: HUGE_VAL for an operator
///     // that uses state derived from the position, else 0.
///     double displaced(const Params&, const Ranges&);
///     // How much the picture changes if every path through the water counts as infinitely long,
///     // for an operator that hides distant surfaces. Default: it hides none.
///     double beyond(const Params&, const Pass&, const Ranges&);
///     // Whether no object in front of the water can change the result in the cell, so that
///     // the test for such objects may be left out. Default: it has no test.
///     bool foreground_free(const Params&, const InReach&);
///     // Its taps, and those of `reach`, follow mirrored rays or the sun's. Default: false, they
///     // follow refracted rays.
///     constexpr bool kLooksAbove = true;
///     // How many times farther than `reach` refracted rays go because of it. Default: 1.
///     double stretch(const Params&, const Pass&);
///     // Cells in which it is skipped have this name. Default: none.
///     constexpr CellKind kSkipped;
///     // Replaces parameters by better ones for the given inputs, and returns the reason as a
///     // phrase, or the effect that lacks its input; "" for neither. Default: changes none.
///     std::string_view prefer(Params&, const AtHand&);
///     // Why it looks up the surroundings although its parameters do not require it, as a phrase;
///     // "" if it does not.
///     std::string_view looks_around(const Params&, const AtHand&);
///     // A sentence on a fault of the inputs of the job; "" without one.
///     std::string_view warning(const Params&, const AtHand&);
///     // Planes that completers make for it if the plate lacks them (plan/completers.h).
///     PlaneSet wants(const Params&, const AtHand&);
///     // Computes the parameters that depend on the working space. Default: none depends on it.
///     void work_in(const Primaries&, Params&);
///     // Whether it uses the light of the sky.
///     bool lit_by_sky(const Params&);
///     // The waves that raise the water, if it has any; they live as long as the parameters.
///     Swell swell(const Params&);
///     // The water through which a viewer in it sees mirrored light. Default: none.
///     std::optional<WaterMedium> medium(const Params&, const Pass&);
///     // How it measures StatePart::kPath, for outputs that depend on the path
///     (job/deep_output.h). PathMeasure path_measure(const Params&);
///     // Its expected cost, in ns per pixel (plan/predict.h). Default: 1.
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
  { T::needs(params) } -> std::same_as<Needs>;     // without these it is skipped
  { T::reach(params) } -> std::same_as<double>;    // how far its taps go, in uv; tilts are below 1
  // The parameters make it the identity on all state but kPath, given the state that the operators
  // before it make.
  { T::neutral(params, made) } -> std::same_as<bool>;
  // The largest change that leaving it out can make to any channel, where `ranges` hold.
  { T::bound(params, pass, ranges) } -> std::same_as<double>;
  // and: template <class Strip> static void apply(const Params&, const Pass&, Strip&);
};

}  // namespace limpid
