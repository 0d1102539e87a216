#include <cmath>

#include "limpid/enter/sanitise.h"

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

using Real = long double;

/// A depth buffer: its format and its planes.
struct DepthBuffer {
  ClipSpace clip;
  int bits;  ///< of an integer; 32 is a float
  double near, far;

  Camera camera() const {
    return {
        .view = glm::dmat4(1.0), .projection = perspective(1, 1, near, far, clip), .clip = clip};
  }
  /// 1 / z = 1 / near - slope w, with w = 0 at the near plane and 1 at the far plane.
  Real slope() const { return 1 / Real(near) - 1 / Real(far); }

  /// The buffer's 0 ... 1 for an eye depth.
  Real exact(Real z) const {
    const Real w = (1 / Real(near) - 1 / z) / slope();
    return clip == ClipSpace::kReversed ? (1 / z - 1 / Real(far)) / slope() : w;
  }
  Real steps() const { return std::exp2(Real(bits)) - 1; }
  Real stored(Real z) const {
    const Real w = exact(z);
    return bits == 32 ? Real(static_cast<float>(w)) : std::round(w * steps()) / steps();
  }
  bool at_far(Real z) const { return stored(z) == (clip == ClipSpace::kReversed ? 0 : 1); }
  /// The number stored in a plane.
  float device(Real z) const {
    const Real w = stored(z);
    return static_cast<float>(clip == ClipSpace::kGl ? 2 * w - 1 : w);
  }
  /// Bound on the error of 1 / z: half a step of the buffer and the rounding of the plane, times
  /// the slope; the rounding of the eye depth itself; the far plane, which means infinitely far.
  Real inverse_bound(Real z) const {
    const Real w = stored(z);
    const Real step = bits == 32 ? kRounding * w : Real(0.5) / steps();
    const Real plane = kRounding * (clip == ClipSpace::kGl ? std::abs(2 * w - 1) / 2
                                    : bits == 32           ? 0  // stored unchanged
                                                           : w);
    const Real arithmetic = 0x1p-50;
    return slope() * (step + plane + arithmetic) + kRounding / z + (at_far(z) ? 1 / Real(far) : 0);
  }
  /// Bound on the error of z, if that of 1 / z is below 1 / z.
  Real depth_bound(Real z) const { return z * z * inverse_bound(z) / (1 - z * inverse_bound(z)); }
};

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr struct { double near, far; } kPlanes[] = {{0.1, 1e3}, {0.1, 1e9}, {1e-3, kInf}};

/// The eye depth after entry.
Real entered(const DepthBuffer& buffer, Real z) {
  const Camera camera = buffer.camera();
  float value = buffer.device(z);
  make_eye_depth({&value, 1, 1, {0, 0, 1, 1}}, {.kind = DepthKind::kDevice, .camera = &camera});
  return value;
}

std::string text_of(const DepthBuffer& buffer, Real z) {
  char text[96];
  std::snprintf(text, sizeof text, "near %g, far %g, depth %.3Lg", buffer.near, buffer.far, z);
  return text;
}

template <class Fn>
void for_each_depth(ClipSpace clip, int bits, Fn&& fn) {
  for (const auto& planes : kPlanes) {
    const DepthBuffer buffer{clip, bits, planes.near, planes.far};
    const double last = std::min(0.999 * planes.far, 1e9);
    constexpr int kSteps = 400;
    for (int i = 0; i <= kSteps; ++i) {
      const Real z = planes.near * std::pow(Real(last / planes.near), Real(i) / kSteps);
      fn(buffer, z);
    }
  }
}

Worst eye_depth(ClipSpace clip, int bits) {
  Worst worst;
  for_each_depth(clip, bits, [&](const DepthBuffer& buffer, Real z) {
    const Real off = std::abs(1 / entered(buffer, z) - 1 / z);
    worst.add(double(off / buffer.inverse_bound(z)), [&] { return text_of(buffer, z); });
  });
  return worst;
}

/// For a bottom a third farther away than the surface, wherever the buffer resolves depth at all.
Worst water_depth(ClipSpace clip, int bits) {
  Worst worst;
  for_each_depth(clip, bits, [&](const DepthBuffer& buffer, Real z) {
    const Real bottom = z * 4 / 3;
    if (bottom >= buffer.far || bottom * buffer.inverse_bound(bottom) > Real(0.5)) return;
    const Real found = entered(buffer, bottom) - entered(buffer, z);
    const Real bound = buffer.depth_bound(z) + buffer.depth_bound(bottom);
    worst.add(double(std::abs(found - (bottom - z)) / bound), [&] { return text_of(buffer, z); });
  });
  return worst;
}

Worst far_plane(const HardWorld&) {
  Worst worst;
  for (const ClipSpace clip : {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed}) {
    for (const auto& planes : kPlanes) {
      const DepthBuffer buffer{clip, 32, planes.near, planes.far};
      const Camera camera = buffer.camera();
      float value = static_cast<float>(camera.far_device_depth());
      make_eye_depth({&value, 1, 1, {0, 0, 1, 1}}, {.kind = DepthKind::kDevice, .camera = &camera});
      worst.expect(value == kInf, [&] { return text_of(buffer, planes.far); });
    }
  }
  return worst;
}

Worst other_kinds(const HardWorld&) {
  Worst worst;
  Sea sea{.near = 0.1, .far = 9e8};
  const Camera camera = *sea.scene().camera;
  const Rect one{5, 3, 6, 4};
  const Real length = sea.at(5, 3).length;
  const auto enter = [&](Real stored, DepthKind kind) -> Real {
    float value = static_cast<float>(stored);
    make_eye_depth({&value, 1, 1, one}, {.kind = kind,
                                         .near = sea.near,
                                         .far = sea.far,
                                         .camera = &camera,
                                         .display = rect_of(sea.size)});
    return value;
  };
  for (int i = 0; i <= 300; ++i) {
    const Real z = 0.1L * std::pow(7e9L, Real(i) / 300);
    const auto judge = [&](Real found, const char* kind) {
      worst.add(double(std::abs(found - z) / z), [&] { return std::string(kind); });
    };
    judge(enter(z * length, DepthKind::kRay), "ray");
    judge(enter(1 / z, DepthKind::kInverse), "inverse");
    judge(enter((z - sea.near) / (Real(sea.far) - sea.near), DepthKind::kNormalised), "normalised");
  }
  return worst;
}

/// The length of the path through the water, from planes with device depth.
Worst chain_path(const HardWorld& world) {
  Worst worst;
  Look look = calm_look(world);
  look.of<Refraction>() = {.model = Refraction::Model::kNormalOffset,
                           .rejection = Refraction::Rejection::kNone};
  look.of<DepthFog>().distance = DepthFog::Distance::kEye;
  for (const ClipSpace clip : {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed}) {
    const Sea sea{.far = 1e3, .clip = clip};
    const DepthBuffer buffer{clip, 24, sea.near, sea.far};
    HardFrame frame = sea.frame();
    for (const PlaneId id : {PlaneId::kDepth, PlaneId::kSurfaceDepth}) {
      frame.set(id, [&](int x, int y) {
        const Sea::Pixel p = sea.at(x, y);
        return entered(buffer, id == PlaneId::kDepth ? p.bottom : p.surface);
      });
    }
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int y = 0; y < sea.size.height; ++y) {
        const Sea::Pixel p = sea.at(0, y);
        const Real off = std::abs(picture.aov(Aov::kPath, 0, y) - (p.bottom - p.surface));
        const Real bound = buffer.depth_bound(p.bottom) + buffer.depth_bound(p.surface) +
                           kRounding * (p.bottom - p.surface);
        worst.add(double(off / bound), [&] { return place_text(runner, look.name, 0, y); });
      }
    }
  }
  return worst;
}

/// The shift of dudv_offset, 0.001 over the device depth of the surface, with near 1e-3 and far
/// 1e9.
Worst device_in_the_chain(const HardWorld& world) {
  Worst worst;
  Look look = calm_look(world);
  look.of<Refraction>() = {.model = Refraction::Model::kDudvOffset,
                           .strength = 0,
                           .rejection = Refraction::Rejection::kNone,
                           .off_frame = Refraction::OffFrame::kClamp};
  for (const ClipSpace clip : {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed}) {
    const Sea sea{.near = 1e-3, .far = 1e9, .clip = clip};
    const DepthBuffer buffer{ClipSpace::kD3d, 32, sea.near, sea.far};
    const HardFrame frame = sea.frame();
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int y = 0; y < sea.size.height; ++y) {
        const Real shift = Real(-0.001) / buffer.exact(sea.at(9, y).surface);
        const Real expected = (9 + Real(0.5)) / sea.size.width + shift;
        worst.add(double(std::abs(picture.aov(Aov::kStmapG, 9, y) - expected)),
                  [&] { return place_text(runner, look.name, 9, y); });
      }
    }
  }
  return worst;
}

}  // namespace

void add_depth_cases(HardCases& cases) {
  constexpr struct {
    ClipSpace clip;
    const char* name;
  } kClips[] = {
      {ClipSpace::kGl, "gl"}, {ClipSpace::kD3d, "d3d"}, {ClipSpace::kReversed, "reversed"}};
  for (const auto& clip : kClips) {
    for (const int bits : {16, 24, 32}) {
      const std::string kind =
          std::to_string(bits) + " bit " + (bits == 32 ? "float " : "") + clip.name;
      cases.push_back({"depth", kind + ", eye depth", "|1/z' - 1/z| over its bound",
                       "half a step of the buffer times 1/near - 1/far, near/far up to 1e9 and "
                       "infinite",
                       1, [=](const HardWorld&) { return eye_depth(clip.clip, bits); }});
      cases.push_back({"depth", kind + ", water depth", "error of the difference over its bound",
                       "z^2 (1/near - 1/far) times half a step, of surface and bottom", 1,
                       [=](const HardWorld&) { return water_depth(clip.clip, bits); }});
    }
  }
  cases.push_back({"depth", "far plane", "far planes that are not infinitely far",
                   "no surface was hit there", 0, far_plane});
  cases.push_back({"depth", "ray, inverse, normalised", "relative error of eye depth",
                   "two roundings: of the stored number and of the result", 2.001 * kRounding,
                   other_kinds});
  cases.push_back({"depth", "24 bit through the chain", "error of the path over its bound",
                   "the bounds of surface and bottom, and one rounding", 1, chain_path});
  cases.push_back({"depth", "device depth in the chain, near 1e-3, far 1e9",
                   "error of a position (picture = 1)", "four roundings of a position below 1/4",
                   kRounding, device_in_the_chain});
}

}  // namespace limpid
