#pragma once
#include <array>
#include <optional>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/ops/fresnel_reflection.h"

#include "complete/pull_push.h"
#include "op/pass.h"

namespace limpid {

/// The sky of a frame behind its objects: the color where no surface was hit and alpha is above
/// half, and elsewhere a smooth continuation of this color (pull_push.h). Beside an object, too: a
/// texel there may show a part of the object.
class Sky {
 public:
  /// Reads color and depth. False, without a result, if the frame shows no sky.
  bool make(const Frame& frame, Executor& executor);
  /// A sky of one color, finite and >= 0, for a frame that shows none.
  void make_even(const Frame& frame, const Rgb<double>& color, Executor& executor);

  const Plane& color(int channel) const { return color_[static_cast<std::size_t>(channel)]; }

 private:
  void resize(const Rect& window);

  std::array<Plane, 3> color_;
  PullPush<3> sky_;
};

/// How the sky that a frame shows changes, as multiples of a clear sky's change, by least squares
/// over some hundred rows and columns: with elevation and with the angle to the sun together, if
/// there is a sun and this explains more of the variance than elevation alone. Each is multiplied
/// by the share of the variance that it explains, so that clouds count for little, and at most
/// kMostSkyFall towards the zenith, or kMostSkyGain where the sky brightens there: overcast skies
/// do so all the way, a dusty one over its horizon alone. Around the sun the sky brightens at most
/// as the standard does (kMostSkyGlow), because a few degrees over the horizon tell little of it. A
/// color brightens only as far as all three do: blue that grows over a hazy horizon soon falls
/// again. None if the frame shows no sky but beside objects, or one elevation of it.
SkyChange sky_change(const Frame& frame, const Pass& pass);
constexpr double kMostSkyFall = 1.5, kMostSkyGain = 0.4, kMostSkyGlow = 1;

/// The radiance of an even sky that lights level water as the sky does that the frame shows a part
/// of: the mean over the directions above the horizon, weighted by their cosine with the water's
/// up. The sky beyond that part goes on from the geometric mean of its colors as sky_change() says,
/// as dark as a share of its texels is black. None if the frame shows no sky but beside objects.
std::optional<Rgb<double>> shown_sky_radiance(const Frame& frame, const Pass& pass);

/// Whether the frame shows sky, by color and depth.
bool shows_sky(const Frame& frame);

/// The sky of a frame that shows none: the color of the look, unless it is 0, or the sky of the
/// scene.
inline std::optional<Rgb<double>> known_sky(const FresnelReflection::Params& look,
                                            const Pass& pass) {
  if (look.color != Rgb<double>{0, 0, 0}) return look.color;
  return pass.has_sky ? std::optional(pass.sky) : std::nullopt;
}

/// The radiance of the sky over a frame that shows none, as a guess. At most: a gray of twice the
/// brightness of the frame's surfaces, because clear and overcast skies are 1 to 10 times as bright
/// as the ground under them. With a sun, in each color, at least the larger of the light that a
/// clear sky has of the sun's, and of the light that level ground of albedo .5 needs besides the
/// sun to be as bright; then the guess is the geometric mean of most and least. A sun below the
/// horizon counts as none. 0 if no surface is visible.
Rgb<double> guessed_sky(const Frame& frame, const Pass& pass);

}  // namespace limpid
