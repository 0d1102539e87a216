#include "shade/glsl_lookups.h"

namespace limpid {
namespace {

/// `text` with each # replaced by `word`.
std::string with(const std::string& text, const std::string& word, char mark = '#') {
  std::string all;
  for (const char c : text) c == mark ? all += word : all += c;
  return all;
}

/// The same, and @ replaced by the letter of a plane's channel, & by its number.
std::string with_channel(const char* text, PlaneId plane) {
  const char letter = channel_letter(plane);
  const std::string number = std::to_string(std::string("rgba").find(letter));
  return with(with(with(text, role_word(plane)), {letter}, '@'), number, '&');
}

/// One step of Newton's method with the exact remainder: devices compute roots with an error of
/// several units in the last place, which normals and rays magnify. (NVIDIA H100: over a landscape
/// the error of `physical` is 1.0 times the fused runner's, and 2.0 times without; it takes 1.06 of
/// the time. A quotient by such a root stays one: the same step for the inverse root leaves 1.7
/// times.) 0 and infinity are their own roots.
constexpr const char* kSqrt = R"(
float limpid_sqrt(float x) {
  float inverse = inversesqrt(x), root = x * inverse;
  float nearer = fma(fma(-root, root, x), 0.5 * inverse, root);
  return nearer == nearer ? nearer : x;
}
)";

constexpr const char* kPlaces = R"(
ivec2 limpid_pixel;

float limpid_column() { return float(limpid_pixel.x - limpid.display.x) + 0.5; }
vec2 limpid_size() { return vec2(limpid.display.zw); }
vec2 limpid_pixel_size() { return 1.0 / limpid_size(); }
ivec2 limpid_at(vec2 texels) {
  return limpid_pixel + ivec2(clamp(texels, vec2(-4e6), vec2(4e6)));
}
)";

constexpr const char* kQuad = R"(vec4 limpid_quad(vec2 shift) {
  vec2 place = shift * limpid_size();
  vec2 corner = floor(place);
  return vec4(corner, place - corner);
}
)";
/// The same up to 2^22 texels from the pixel, by sums whose last bit is a whole number.
constexpr const char* kSummedQuad = R"(float limpid_floor(float x) {
  precise float sum = x + 12582912.0, nearest = sum - 12582912.0;
  return nearest > x ? nearest - 1.0 : nearest;
}
vec4 limpid_quad(vec2 shift) {
  vec2 place = shift * limpid_size();
  vec2 corner = vec2(limpid_floor(place.x), limpid_floor(place.y));
  return vec4(corner, place - corner);
}
)";

constexpr const char* kRow = R"(
float limpid_row(int k) {
  return texelFetch(limpid_rows, ivec2(k, limpid_pixel.y - limpid.work.y), 0).r;
}
)";

/// Four to a texel.
constexpr const char* kPackedRow = R"(
float limpid_row(int k) {
  return texelFetch(limpid_rows, ivec2(k >> 2, limpid_pixel.y - limpid.work.y), 0)[k & 3];
}
)";

constexpr const char* kPlane = R"(
vec4 limpid_texel_#(ivec2 place) {
  ivec4 window = limpid.window_#;
  return texelFetch(limpid_#, clamp(place, window.xy, window.zw - 1) - window.xy, 0);
}
)";
constexpr const char* kNearest = R"(vec4 limpid_nearest_#(vec2 shift) {
  return limpid_texel_#(limpid_at(floor(shift * limpid_size() + 0.5)));
}
)";
constexpr const char* kBilinear = R"(vec4 limpid_bilinear_#(vec2 shift) {
  vec4 quad = limpid_quad(shift);
  ivec2 corner = limpid_at(quad.xy);
  vec4 a = limpid_texel_#(corner), b = limpid_texel_#(corner + ivec2(1, 0));
  vec4 c = limpid_texel_#(corner + ivec2(0, 1)), d = limpid_texel_#(corner + ivec2(1, 1));
  vec4 upper = a + quad.z * (b - a), lower = c + quad.z * (d - c);
  return upper + quad.w * (lower - upper);
}
)";
/// For one channel: # the role and @ the channel.
constexpr const char* kBilinearOne = R"(float limpid_bilinear_#_@(vec2 shift) {
  return limpid_bilinear_#(shift).@;
}
)";
/// In float, which holds all of these whole numbers: integers would be made of them and back.
constexpr const char* kPlace = R"(vec2 limpid_place_#(vec4 quad, vec2 k) {
  vec2 begin = vec2(limpid.window_#.xy - limpid_pixel);
  vec2 last = vec2(limpid.window_#.zw - 1 - limpid_pixel);
  return clamp(quad.xy + k, begin, last) * limpid_pixel_size();
}
)";

/// The nearest of the four texels of a quad.
constexpr const char* kNearestOf = R"(float limpid_nearest_of(vec4 four, vec4 quad) {
  vec2 row = quad.w < 0.5 ? four.xy : four.zw;
  return quad.z < 0.5 ? row.x : row.y;
}
)";
constexpr const char* kRead = R"(vec4 limpid_read_#_@(vec4 quad) {
  ivec2 corner = limpid_at(quad.xy);
  return vec4(limpid_texel_#(corner).@, limpid_texel_#(corner + ivec2(1, 0)).@,
              limpid_texel_#(corner + ivec2(0, 1)).@, limpid_texel_#(corner + ivec2(1, 1)).@);
}
)";

/// textureGather() gives the lower left, lower right, upper right and upper left texel of four.
constexpr const char* kMixed = R"(
float limpid_mixed(vec4 four, vec2 w) {
  float upper = four.w + w.x * (four.z - four.w), lower = four.x + w.x * (four.y - four.x);
  return upper + w.y * (lower - upper);
}
)";
/// Where four texels of a plane meet, so many texels from the pixel; & is the number of a channel.
/// At the edge the sampler takes the last ones, and devices clamp to 0 ... 1 for nothing.
constexpr const char* kMeet = R"(
vec2 limpid_meet_#(vec2 texels) {
  vec4 texel = limpid.texel_#;
  vec2 own = (vec2(limpid_pixel) + texel.zw) * texel.xy;
  return clamp(texels * texel.xy + own, 0.0, 1.0);
}
)";
/// Half a texel before that is the middle of one: the sampler takes the nearest.
constexpr const char* kSampledNearest = R"(vec4 limpid_nearest_#(vec2 shift) {
  return textureLod(limpid_#, limpid_meet_#(floor(shift * limpid_size() + 0.5) - 0.5), 0.0);
}
)";
constexpr const char* kGatheredOne = R"(float limpid_bilinear_#_@(vec2 shift) {
  vec4 quad = limpid_quad(shift);
  return limpid_mixed(textureGather(limpid_#, limpid_meet_#(quad.xy), &), quad.zw);
}
)";
constexpr const char* kGatheredThree = R"(vec4 limpid_bilinear_#(vec2 shift) {
  vec4 quad = limpid_quad(shift);
  vec2 meet = limpid_meet_#(quad.xy);
  return vec4(limpid_mixed(textureGather(limpid_#, meet, 0), quad.zw),
              limpid_mixed(textureGather(limpid_#, meet, 1), quad.zw),
              limpid_mixed(textureGather(limpid_#, meet, 2), quad.zw), 1.0);
}
)";
constexpr const char* kGatheredRead = R"(vec4 limpid_read_#_@(vec4 quad) {
  return textureGather(limpid_#, limpid_meet_#(quad.xy), &).wzxy;
}
)";

/// Where four texels of a picture that repeats meet, of a level of x by y texels, whose first texel
/// ends at z and w of the texture; around the level lie the texels of its other side.
constexpr const char* kMeetTiled = R"(
vec2 limpid_meet_tiled(vec4 level, vec2 texel, vec2 periods, out vec2 w) {
  vec2 texels = max(periods - floor(periods), 0.0) * level.xy - 0.5;
  vec2 corner = floor(texels);
  w = texels - corner;
  return corner * texel + level.zw;
}
)";
/// Colors in 32 bits, in units of the lowest bit of each mask. The exponent of 2^23 in front of the
/// integers makes floats of them, without a slow conversion.
constexpr const char* kMixedBits = R"(
float limpid_mixed_bits(uvec4 bits, vec2 w) {
  const float much = 8388608.0;
  vec4 four = uintBitsToFloat(bits | 0x4b000000u);
  float upper = (four.w - much) + w.x * (four.z - four.w);
  float lower = (four.x - much) + w.x * (four.y - four.x);
  return upper + w.y * (lower - upper);
}
)";
constexpr const char* kPackedTiled = R"(
vec3 limpid_tiled(vec2 periods) {
  vec2 w, meet = limpid_meet_tiled(limpid.level_wave_map, limpid.texel_wave_map.xy, periods, w);
  uvec4 four = textureGather(limpid_wave_map, meet);
  return vec3(limpid_mixed_bits(four & 0xffu, w), limpid_mixed_bits(four & 0xff00u, w),
              limpid_mixed_bits(four >> 16, w)) *
         vec3(1.0 / 255.0, 1.0 / 65280.0, 1.0 / 255.0);
}
)";
/// See TextureLevels.
constexpr const char* kPackedLevel = R"(
vec3 limpid_level_wave_levels(vec4 level, vec2 periods) {
  vec2 w, meet = limpid_meet_tiled(level, limpid.texel_wave_levels.xy, periods, w);
  uvec4 four = textureGather(limpid_wave_levels, meet);
  return vec3(limpid_mixed_bits(four & 0x7ffu, w), limpid_mixed_bits(four & 0x3ff800u, w),
              limpid_mixed_bits(four >> 22, w)) *
         vec3(1.0, 1.0 / 2048.0, 1.0);
}
)";
/// Planes lie one below the other: see SlopeLevels.
constexpr const char* kSlopeLevels = R"(
float limpid_slope(vec2 meet, float plane, vec2 w) {
  meet.y += plane * limpid.texel_slopes.z;
  return limpid_mixed(textureGather(limpid_slopes, meet), w);
}
vec3 limpid_level_slope_means(vec4 level, vec2 periods) {
  vec2 w, meet = limpid_meet_tiled(level, limpid.texel_slopes.xy, periods, w);
  return vec3(limpid_slope(meet, 0.0, w), limpid_slope(meet, 1.0, w), 0.0);
}
vec3 limpid_level_slope_squares(vec4 level, vec2 periods) {
  vec2 w, meet = limpid_meet_tiled(level, limpid.texel_slopes.xy, periods, w);
  return vec3(limpid_slope(meet, 2.0, w), limpid_slope(meet, 3.0, w), limpid_slope(meet, 4.0, w));
}
)";

/// A picture that repeats in x alone, with a texel of its other side at both ends of a row; # is
/// the lookup's number, $ its sampler.
constexpr const char* kGatheredLatLong = R"(vec3 limpid_lat_long_#(vec2 place) {
  vec4 level = limpid.level_lat_long_#;
  vec2 texels = vec2(max(place.x - floor(place.x), 0.0), place.y) * level.xy - 0.5;
  vec2 corner = floor(texels), w = texels - corner;
  vec2 meet = corner * limpid.texel_lat_long_#.xy + level.zw;
  return vec3(limpid_mixed(textureGather($, meet, 0), w),
              limpid_mixed(textureGather($, meet, 1), w),
              limpid_mixed(textureGather($, meet, 2), w));
}
)";

/// Four texels of a picture of `size` texels that repeats in x and, with `both`, in y, from row
/// `top` of the texture on.
constexpr const char* kWrapped = R"(
vec3 limpid_wrapped(sampler2D map, ivec2 size, int top, vec2 place, bool both) {
  vec2 fraction = max(place - floor(place), 0.0);
  if (!both) fraction.y = place.y;
  vec2 texels = fraction * vec2(size) - 0.5;
  vec2 corner = floor(texels), w = texels - corner;
  ivec2 a = ivec2(corner), b = a + 1;
  a = ivec2(a.x < 0 ? size.x - 1 : a.x, both && a.y < 0 ? size.y - 1 : clamp(a.y, 0, size.y - 1));
  b = ivec2(b.x >= size.x ? 0 : b.x, both && b.y >= size.y ? 0 : clamp(b.y, 0, size.y - 1));
  vec3 upper_left = texelFetch(map, ivec2(a.x, top + a.y), 0).rgb;
  vec3 upper_right = texelFetch(map, ivec2(b.x, top + a.y), 0).rgb;
  vec3 lower_left = texelFetch(map, ivec2(a.x, top + b.y), 0).rgb;
  vec3 lower_right = texelFetch(map, ivec2(b.x, top + b.y), 0).rgb;
  vec3 upper = upper_left + w.x * (upper_right - upper_left);
  vec3 lower = lower_left + w.x * (lower_right - lower_left);
  return upper + w.y * (lower - upper);
}
)";

/// Which of two levels a width has, and how much of the next: see between_levels() in
/// op/plain_texture.h.
constexpr const char* kLevelOf = R"(
int limpid_level_of(float width, int last, out float rest) {
  int level = min(int(floor(log2(width))), last);
  float between = width / exp2(float(level)) - 1.0;
  rest = level == last ? 0.0 : clamp(4.0 * between - 1.5, 0.0, 1.0);
  return level;
}
)";
/// Blends two levels, stored one below the other. A level is width, height and top. # is the
/// lookup, & its levels, @ their number.
constexpr const char* kBetween = R"(vec3 limpid_between_#(float width, vec2 periods) {
  float rest;
  int last = limpid.counts.@ - 1, level = limpid_level_of(width, last, rest);
  vec3 near = limpid_level_#(limpid.levels_&[level], periods);
  if (rest <= 0.0) return near;
  vec3 far = limpid_level_#(limpid.levels_&[min(level + 1, last)], periods);
  return near + rest * (far - near);
}
)";
constexpr const char* kLevel = R"(vec3 limpid_level_#(ivec4 level, vec2 periods) {
  return limpid_wrapped(limpid_#, level.xy, level.z, periods, true);
}
)";
constexpr const char* kTiled = R"(vec3 limpid_tiled(vec2 periods) {
  return limpid_wrapped(limpid_wave_map, textureSize(limpid_wave_map, 0), 0, periods, true);
}
)";
/// Levels of the map are integers in this unit (TextureLevels), which halves hold exactly.
constexpr const char* kTiledWide = R"(const vec3 limpid_level_unit =
    vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 511.0);
// Up to here limpid_share() is 0. Said once, a driver would join the two and need more registers.
bool limpid_is_fine(float width) { return width <= 1.375; }
float limpid_share(float width) { return clamp(4.0 * width - 5.5, 0.0, 1.0); }
vec3 limpid_tiled_wide(vec2 periods, float width) {
  float share = limpid_share(width);
  if (share <= 0.0) return limpid_tiled(periods);
  vec3 far = limpid_between_wave_levels(max(0.5 * width, 1.0), periods) * limpid_level_unit;
  if (share >= 1.0) return far;
  vec3 near = limpid_tiled(periods);
  return near + share * (far - near);
}
)";
constexpr const char* kSlopeMean = R"(vec2 limpid_slope_mean(vec2 periods, float width) {
  return limpid_between_slope_means(max(width, 1.0), periods).rg;
}
)";
constexpr const char* kSlopeSquare = R"(vec3 limpid_slope_square(vec2 periods, float width) {
  return limpid_between_slope_squares(max(width, 1.0), periods);
}
)";

/// Both of one place: & and $ are their levels.
constexpr const char* kSlopeMoments = R"(
void limpid_slope_moments(vec2 periods, float width, out vec2 mean, out vec3 square) {
  float rest;
  int last = limpid.counts.y - 1, level = limpid_level_of(max(width, 1.0), last, rest);
  mean = limpid_level_slope_means(limpid.levels_&[level], periods).rg;
  square = limpid_level_slope_squares(limpid.levels_$[level], periods);
  if (rest <= 0.0) return;
  level = min(level + 1, last);
  mean += rest * (limpid_level_slope_means(limpid.levels_&[level], periods).rg - mean);
  square += rest * (limpid_level_slope_squares(limpid.levels_$[level], periods) - square);
}
)";

/// A table that ends at its edges; all levels lie in one texture, one below the other.
constexpr const char* kGrid = R"(
float limpid_grid(ivec4 level, vec2 texels) {
  vec2 place = clamp(texels, vec2(0.0), vec2(level.xy - 1));
  ivec2 a = min(ivec2(place), max(level.xy - 2, 0)), b = min(a + 1, level.xy - 1);
  vec2 w = place - vec2(a);
  ivec2 first = ivec2(0, level.z);
  float upper_left = texelFetch(limpid_caustics, first + a, 0).r;
  float upper_right = texelFetch(limpid_caustics, first + ivec2(b.x, a.y), 0).r;
  float lower_left = texelFetch(limpid_caustics, first + ivec2(a.x, b.y), 0).r;
  float lower_right = texelFetch(limpid_caustics, first + b, 0).r;
  float upper = upper_left + w.x * (upper_right - upper_left);
  float lower = lower_left + w.x * (lower_right - lower_left);
  return upper + w.y * (lower - upper);
}
)";

constexpr const char* kGatheredGrid = R"(
float limpid_grid(ivec4 level, vec2 texels) {
  vec2 place = clamp(texels, vec2(0.0), vec2(level.xy - 1));
  ivec2 a = min(ivec2(place), max(level.xy - 2, 0));
  vec2 meet = vec2(a + ivec2(1, 1 + level.z)) * limpid.texel_caustics.xy;
  return limpid_mixed(textureGather(limpid_caustics, meet), place - vec2(a));
}
)";

/// Abramowitz & Stegun 1964, "Handbook of Mathematical Functions", 4.4.49: within 2e-8 of the
/// arctangent of 0 ... 1, extended to the circle like the function for lanes. GLSL's own is inexact
/// on some devices.
constexpr const char* kAtan2 = R"(float limpid_atan2(float y, float x) {
  float across = abs(x), up = abs(y);
  float t = min(across, up) / max(max(across, up), 1e-37), s = t * t;
  float sum = 0.0028662257 * s - 0.0161657367;
  sum = 0.0429096138 + s * sum;
  sum = -0.0752896400 + s * sum;
  sum = 0.1065626393 + s * sum;
  sum = -0.1420889944 + s * sum;
  sum = 0.1999355085 + s * sum;
  sum = -0.3333314528 + s * sum;
  float octant = t + t * s * sum;
  float quarter = up > across ? 1.57079633 - octant : octant;
  float turned = x < 0.0 ? 3.14159265 - quarter : quarter;
  return y < 0.0 ? -turned : turned;
}
)";

std::string power_text(int whole) {
  const std::string name = "limpid_power_" + std::to_string(whole);
  std::string text = "float " + name + "(float x) {\n  float power = x, result = 1.0;\n";
  for (int left = whole;;) {
    if (left & 1) text += "  result *= power;\n";
    left >>= 1;
    if (left == 0) break;
    text += "  power *= power;\n";
  }
  return text + "  return result;\n}\n";
}

}  // namespace

std::string plane_sampler(PlaneId plane) { return "limpid_" + role_word(plane); }

std::string texture_sampler(int texture) {
  switch (static_cast<TextureId>(texture)) {
    case TextureId::kWaveMap:
      return "limpid_wave_map";
    case TextureId::kWaveSlopes:
      return "limpid_slope_means";
    case TextureId::kEnvironment:
      return "limpid_environment";
    case TextureId::kEdgeColors:
      return "limpid_edge_colors";
    case TextureId::kEdgeShape:
      return "limpid_edge_shape";
    case TextureId::kContinuation:
      return "limpid_continuation";
    case TextureId::kBottomColors:
      return "limpid_bottom_colors";
    case TextureId::kBottomShape:
      return "limpid_bottom_shape";
    default:
      return "limpid_caustics";
  }
}

std::string glsl_lookups(const GlslNeeds& needs, Gathered gathered, bool packed_map,
                         bool summed_quads) {
  const bool planes = gathered == Gathered::kAll, made = gathered != Gathered::kNothing;
  std::string text;
  const auto op = [&](NodeOp which) { return needs.ops.count(which) > 0; };
  if (needs.infinity) text += "#define limpid_infinity uintBitsToFloat(0x7f800000u)\n";
  text += kPlaces;
  text += summed_quads ? kSummedQuad : kQuad;
  if (made && op(NodeOp::kSqrt)) text += kSqrt;
  if (op(NodeOp::kRow)) text += made ? kPackedRow : kRow;
  std::set<std::string> done;
  const auto once = [&](const std::string& words) {
    if (done.insert(words).second) text += words;
  };
  if (made) once(kMixed);
  for (const auto& [verb, what] : needs.lookups) {
    if (verb < NodeOp::kOwn || verb > NodeOp::kPlace) continue;
    const std::string role = role_word(static_cast<PlaneId>(what));
    once(with(kPlane, role));
    const bool sampled = verb == NodeOp::kNearest || verb == NodeOp::kBilinear ||
                         verb == NodeOp::kBilinear3 || verb == NodeOp::kRead;
    if (planes && sampled) once(with(kMeet, role));
  }
  const auto tiled = [&] {
    if (made && packed_map) {
      once(kMeetTiled);
      once(kMixedBits);
      once(kPackedTiled);
    } else {
      once(kWrapped);
      once(kTiled);
    }
  };
  const auto between = [&](const std::string& name, const std::string& levels, char count) {
    once(kLevelOf);
    once(with(with(with(kBetween, name), levels, '&'), {count}, '@'));
  };
  const auto slopes = [&](const std::string& name) {
    once(made ? kMeetTiled : kWrapped);
    once(made ? kSlopeLevels : with(kLevel, name));
    between(name, made ? "slopes" : name, 'y');
  };
  for (const auto& [verb, what] : needs.lookups) {
    const auto plane = static_cast<PlaneId>(what);
    switch (verb) {
      case NodeOp::kNearest:
        once(with(planes ? kSampledNearest : kNearest, role_word(plane)));
        break;
      case NodeOp::kBilinear:
        if (!planes) once(with(kBilinear, role_word(plane)));
        once(with_channel(planes ? kGatheredOne : kBilinearOne, plane));
        break;
      case NodeOp::kBilinear3:
        once(with(planes ? kGatheredThree : kBilinear, role_word(plane)));
        break;
      case NodeOp::kPlace:
        once(with(kPlace, role_word(plane)));
        break;
      case NodeOp::kRead:
        once(with_channel(planes ? kGatheredRead : kRead, plane));
        break;
      case NodeOp::kTiled:
        tiled();
        break;
      case NodeOp::kTiledWide:
        tiled();
        if (made) {
          once(kMeetTiled);
          once(kMixedBits);
          once(kPackedLevel);
        } else {
          once(with(kLevel, "wave_levels"));
        }
        between("wave_levels", "wave_levels", 'x');
        once(kTiledWide);
        break;
      case NodeOp::kSlopeMean:
        slopes("slope_means");
        once(kSlopeMean);
        break;
      case NodeOp::kSlopeSquare:
        slopes("slope_squares");
        once(kSlopeSquare);
        break;
      case NodeOp::kLatLong:
        if (made) {
          once(with(with(kGatheredLatLong, std::to_string(what)), texture_sampler(what), '$'));
          break;
        }
        once(kWrapped);
        once(with("vec3 limpid_lat_long_" + std::to_string(what) + "(vec2 place) {\n" +
                      "  return limpid_wrapped(#, textureSize(#, 0), 0, place, false);\n}\n",
                  texture_sampler(what)));
        break;
      case NodeOp::kGrid:
        once(made ? kGatheredGrid : kGrid);
        once("float limpid_grid_" + std::to_string(what) + "(vec2 texels) {\n" +
             "  return limpid_grid(limpid.levels_caustics[" +
             std::to_string(what - static_cast<int>(TextureId::kCaustics)) + "], texels);\n}\n");
        break;
      default:
        break;
    }
  }
  if (needs.nearest_of) text += kNearestOf;
  if (needs.slope_moments) {
    once(kLevelOf);
    once(with(with(kSlopeMoments, made ? "slopes" : "slope_means", '&'),
              made ? "slopes" : "slope_squares", '$'));
  }
  if (op(NodeOp::kAtan2)) text += kAtan2;
  for (const int whole : needs.powers) text += power_text(whole);
  if (needs.power) {
    text +=
        "float limpid_power(float x, float p) {\n  if (p <= 0.0) return 1.0;\n"
        "  return x > 1e-37 ? exp2(p * log2(x)) : 0.0;\n}\n";
  }
  return text;
}

}  // namespace limpid
