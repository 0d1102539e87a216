#pragma once

namespace limpid::bench {

/// The look `realistic` in GLSL, as a real-time programmer writes it: one fragment per pixel,
/// bilinear float textures, row 0 of the picture at the bottom of the target.
inline constexpr const char* kRealisticVertex = R"(#version 330 core
void main() {  // one triangle over the whole picture
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})";

inline constexpr const char* kRealisticFragment = R"(#version 330 core
uniform sampler2D color_texture, reflection_texture, map_texture;    // r g b
uniform sampler2D depth_texture, surface_texture, shadow_texture;    // r alone; depth is not filtered
uniform vec3 ray, ray_dx, ray_dy, map_u, map_v, blend_begin, tilt_x, tilt_y;
uniform vec3 fog_color, sun_direction, sun_color;
uniform vec2 map_begin[4];
uniform mat3 blend;
uniform vec2 texel, refract_shift, prism_shift, mirror_shift;        // shifts in uv per unit tilt
uniform float fog_density, fog_offset, fog_alpha, shadow_strength, rim_power, sun_power;
out vec4 result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 own = gl_FragCoord.xy * texel;
  float water = texelFetch(surface_texture, pixel, 0).r, dry = texelFetch(depth_texture, pixel, 0).r;
  if (!(water < dry)) {
    result = vec4(texelFetch(color_texture, pixel, 0).rgb, 1.0);
    return;
  }
  vec3 along = ray + float(pixel.x) * ray_dx + float(pixel.y) * ray_dy;
  vec3 view = -normalize(along), at = water * along;
  vec2 place = vec2(dot(at, map_u), dot(at, map_v));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) sum += texture(map_texture, place + map_begin[i]).rgb;
  vec3 normal = normalize(blend * sum + blend_begin);
  vec2 tilt = vec2(dot(normal, tilt_x), dot(normal, tilt_y));

  vec2 seen = own + refract_shift * tilt, prism = prism_shift * tilt;
  float hit = texture(depth_texture, seen).r;
  if (hit < water) {
    seen = own;
    prism = vec2(0.0);
    hit = dry;
  }
  vec3 under = vec3(texture(color_texture, seen + vec2(prism.x, 0.0)).r,
                    texture(color_texture, seen + 0.5 * prism).g,
                    texture(color_texture, seen + vec2(0.0, prism.y)).b);
  float veil = fog_alpha * clamp(fog_density * max(hit - water, 0.0) - fog_offset, 0.0, 1.0);
  under = mix(under, fog_color, veil);
  under *= 1.0 - shadow_strength * (1.0 - texture(shadow_texture, seen).r);

  vec3 above = texture(reflection_texture, own + mirror_shift * tilt).rgb;
  under = mix(under, above, pow(max(1.0 - abs(dot(view, normal)), 0.0), rim_power));
  float lobe = pow(clamp(dot(normal, normalize(view + sun_direction)), 0.0, 1.0), sun_power);
  result = vec4(under + lobe * texelFetch(shadow_texture, pixel, 0).r * sun_color, 1.0);
})";

}  // namespace limpid::bench
