#include <cmath>

#include "complete/mirror.h"

// What the picture shows of mirrored rays that leave it, or that pass behind something in it.

namespace limpid {
namespace {

using test::kInf;
using test::kInside;
using test::kSky;
using test::kWall;
using test::Ridge;

/// A wall without a reflection, and a pole before it, mirrored by facets that lean to the side,
/// too.
struct Poles : Ridge {
  glm::dvec3 normal;
  double pole;     ///< distance
  int begin, end;  ///< columns of the pole

  Poles(double top_of_wall, glm::dvec2 slope, double distance, int first, int last)
      : Ridge(top_of_wall, 0),
        normal(glm::normalize(glm::dvec3(slope.x, 1, slope.y))),
        pole(distance),
        begin(first),
        end(last) {
    for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB,
                             PlaneId::kReflectionDepth}) {
      buffers.frame.planes[index_of(id)] = {};
    }
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      return is_pole(x, y) ? static_cast<float>(pole) : depth(x, y);
    });
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        if (is_pole(x, y)) return kInside;
        return depth(x, y) == kInf ? kSky : 2 + far * ray(x, y).y > 0 ? kWall : 1.0f;
      });
      buffers.fill(plane_after(PlaneId::kSurfaceNormalX, c), static_cast<float>(normal[c]));
    }
  }
  /// Planes of the reflection, of a wall that goes on above them.
  void show_reflection() {
    const auto shows_pole = [&](int x, int y) {
      return x >= begin && x < end && 2 + pole * ray(x, y).y < 0;
    };
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kReflectionR, c),
                  [=](int x, int y) { return shows_pole(x, y) ? kInside : kWall; });
    }
    buffers.set(PlaneId::kReflectionDepth, [=, this](int x, int y) {
      return static_cast<float>(shows_pole(x, y) ? pole : far);
    });
  }
  bool is_pole(int x, int y) const { return x >= begin && x < end && 2 + pole * ray(x, y).y > 0; }
  /// Of the picture, at a distance of 1.
  double width() const { return kWide.width * (ray(1, 0) - ray(0, 0)).x; }
  /// Distance of the water that a pixel shows, +inf if none.
  double water(int x, int y) const {
    const double at = ray(x, y).y < 0 ? -2 / ray(x, y).y : HUGE_VAL;
    return at < far - 0.5 && !(is_pole(x, y) && at > pole) ? at : HUGE_VAL;
  }
  /// The place of the mirrored ray of a pixel at a distance from the eye.
  glm::dvec3 mirrored_at(int x, int y, double distance) const {
    const glm::dvec3 view = ray(x, y), up = view - 2 * glm::dot(view, normal) * normal;
    const double from = -2 / view.y;
    return from * view + glm::dvec3(0, 2, 0) + (distance - from) / -up.z * up;
  }
  double column_of(const glm::dvec3& at) const {
    return kWide.width * (0.5 + at.x / -at.z / width());
  }
  /// Calls check(x, y, both pictures' colors) for each pixel of the water.
  template <class Check>
  void each(const Check& check) const {
    const test::Picture exact = test::reference(look, buffers.frame, scene);
    const test::Picture fused = test::fused(look, buffers.frame, scene);
    int differ = 0;
    for (int y = 0; y < kWide.height; ++y) {
      for (int x = 0; x < kWide.width; ++x) {
        if (!(water(x, y) < HUGE_VAL)) continue;
        check(x, y, float(exact.color(x, y).r));
        differ += std::abs(fused.color(x, y).r - exact.color(x, y).r) > 1e-3;
      }
    }
    // Roundings decide what a ray along an edge meets: one of a thousand pixels may.
    EXPECT_LE(differ, kWide.width * kWide.height / 2000);
  }
};

// A wall that the picture's upper edge cuts goes on above it: half of all walls that are known to
// be so high are twice as high, a third three times.
TEST(MirroredPicture, GoesOnBeyondItsEdge) {
  for (const double slope : {0.3, 0.5}) {
    int beyond = 0, partly = 0;
    const Poles wall(1000, {0, slope}, 15, 0, 0);
    const double edge = 2 + wall.far * wall.ray(0, 0).y;
    const double beyond_all = wall.look.of<FresnelReflection>().color.r;  // it shows no sky
    wall.each([&](int x, int y, float color) {
      const double share = std::min(edge / wall.mirrored_at(x, y, wall.far).y, 1.0);
      EXPECT_NEAR(color, beyond_all + share * (kWall - beyond_all), 1e-3) << x << ", " << y;
      beyond += share < 1;
      partly += share < 0.5;
    });
    EXPECT_GT(beyond, 1000);
    EXPECT_GT(partly, 1000);
  }
}

// In a room no ray ends in the sky: not above its walls, and not between two steps of its march.
TEST(MirroredPicture, OfARoomShowsItsCeiling) {
  for (const double slope : {0.1, 0.3, 0.5}) {
    Poles room(1000, {0, slope}, 15, 0, 0);
    room.buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const double rise = room.ray(x, y).y;
      return static_cast<float>(rise > 0 ? std::min(room.far, 2 / rise) : room.depth(x, y));
    });
    int wet = 0;
    room.each([&](int x, int y, float color) {
      EXPECT_NEAR(color, kWall, 1e-3) << x << ", " << y;
      ++wet;
    });
    EXPECT_GT(wet, 1000);
  }
}

// Something narrow goes on only as far as it is wide, like a tree whose top the edge cuts; the more
// sky is beside it within the ray's distance from the edge, the less.
TEST(MirroredPicture, GoesOnAsFarAsItIsWide) {
  Poles tower(-1, {0, 0.2}, 19, 140, 180);  // no wall but that
  tower.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return tower.is_pole(x, y) ? 19.0f : tower.ray(x, y).y < 0 ? tower.depth(x, y) : kInf;
  });
  int whole = 0, partly = 0, skies = 0;
  tower.each([&](int x, int y, float color) {
    if (x != 150 && x != 160) return;
    const double edge = 2 + 19 * tower.ray(x, 0).y, height = tower.mirrored_at(x, y, 19).y;
    const double over = (height - edge) / (19 * (tower.ray(x, 0) - tower.ray(x, 1)).y);
    if (over < 3) return;
    const auto shown = [&](double reach) {
      const double begin = std::max(140.0, x - reach), end = std::min(180.0, x + 1 + reach);
      const double goes = std::max(2 * (end - begin) / (2 * reach + 1) - 1, 0.0);
      return kSky + goes * goes * edge / height * (kInside - kSky);
    };
    const double off = 1.5 + over / 4;  // the table has rows, with means over whole texels
    EXPECT_LE(color, shown(std::max(over - off, 0.0)) + 0.5) << x << ", " << y << ": " << over;
    EXPECT_GE(color, shown(over + off) - 0.5) << x << ", " << y << ": " << over;
    const double goes = (shown(over) - kSky) / (edge / height * (kInside - kSky));
    if (over > 48) {
      EXPECT_EQ(color, kSky) << x << ", " << y;
    }
    (goes <= 0 ? skies : goes > 0.999 ? whole : partly) += 1;
  });
  EXPECT_GT(whole, 4);
  EXPECT_GT(partly, 4);
  EXPECT_GT(skies, 10);
}

// A ray that passes behind a pole has met the wall there, not the sky: also if it comes out on the
// other side, and if it leaves the picture behind the pole.
TEST(MirroredPicture, MeetsTheWallBehindAPole) {
  for (const double top : {3.0, 1000.0}) {
    int behind = 0;
    for (const double aside : {0.02, 0.05, 0.1, 0.2}) {
      const Poles poles(top, {aside, 0.02}, 8, 150, 170);
      poles.each([&](int x, int y, float color) {
        const glm::dvec3 at = poles.mirrored_at(x, y, poles.far);
        const double column = poles.column_of(at);
        const auto near = [&](double edge) { return std::abs(column - edge) < 2; };
        if (poles.water(x, y) < 9 || at.y < 0.3 || std::abs(at.y - top) < 0.3) return;
        // A ray that begins right beside the pole and comes out before the sky is not found.
        if (near(150) || near(170) || (top < 4 && x > 147 && x < 150)) return;
        EXPECT_FLOAT_EQ(color, at.y < top ? kWall : kSky)
            << top << ", " << aside << ", " << x << ", " << y;
        behind += column > 150 && column < 170;
      });
    }
    EXPECT_GT(behind, 20) << top;
  }
}

// The color of a texel beside a lamp is mixed with the lamp's, but its depth is the wall's: it is
// at most twice as bright as the wall farther away.
TEST(MirroredPicture, ATexelBesideALampDoesNotLightTheWallBehind) {
  Poles lamp(1000, {0, 0.02}, 8, 150, 170);
  for (int c = 0; c < 3; ++c) {
    lamp.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      const bool mixed = lamp.is_pole(x - 1, y) || lamp.is_pole(x + 1, y);
      return lamp.is_pole(x, y) || mixed ? kInside : lamp.depth(x, y) == kInf ? kSky : kWall;
    });
  }
  int walls = 0;
  lamp.each([&](int x, int y, float color) {
    const double column = lamp.column_of(lamp.mirrored_at(x, y, lamp.far));
    const bool beside = (column > 147 && column < 150) || (column > 170 && column < 173);
    if (lamp.water(x, y) < 9 || lamp.mirrored_at(x, y, lamp.far).y < 0.3 || !beside) return;
    EXPECT_GE(color, kWall) << x << ", " << y;
    EXPECT_LE(color, 2 * kWall) << x << ", " << y;
    ++walls;
  });
  EXPECT_GT(walls, 20);
}

// Colors outside the gamut may be negative.
TEST(MirroredPicture, KeepsNegativeColors) {
  Poles lamp(1000, {0, 0.02}, 8, 150, 170);
  lamp.buffers.set(PlaneId::kColorR,
                   [&](int x, int y) { return lamp.is_pole(x, y) ? kInside : -0.125f; });
  int walls = 0;
  lamp.each([&](int x, int y, float color) {
    const double column = lamp.column_of(lamp.mirrored_at(x, y, lamp.far));
    if (lamp.mirrored_at(x, y, lamp.far).y < 0.3 || (column > 140 && column < 180)) return;
    EXPECT_FLOAT_EQ(color, -0.125f) << x << ", " << y;
    ++walls;
  });
  EXPECT_GT(walls, 1000);
}

// A deck half a metre over the water, seen from above: mirrored rays meet its underside, which the
// picture does not show.
TEST(MirroredPicture, TheUndersideOfADeckIsDark) {
  Poles deck(1000, {0, 0}, 1, 0, 0);
  const auto distance = [&](int x, int y) { return -1.5 / std::min(deck.ray(x, y).y, -1e-9); };
  const auto on_deck = [&](int x, int y) {
    return x >= 100 && x < 220 && distance(x, y) > 5 && distance(x, y) < 9;
  };
  deck.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return on_deck(x, y) ? static_cast<float>(distance(x, y)) : deck.depth(x, y);
  });
  deck.buffers.set(PlaneId::kColorR, [&](int x, int y) { return on_deck(x, y) ? kInside : kWall; });
  int under = 0, beside = 0;
  deck.each([&](int x, int y, float color) {
    const double sinks = -deck.ray(x, y).y;
    if (on_deck(x, y) || sinks < 0.32 || sinks > 0.44) return;
    if (x > 110 && x < 210) {
      EXPECT_NEAR(color, 0.3f * kInside, 0.05f * kInside) << x << ", " << y;
      ++under;
    } else if (x < 90 || x > 230) {
      EXPECT_FLOAT_EQ(color, kWall) << x << ", " << y;
      ++beside;
    }
  });
  EXPECT_GT(under, 500);
  EXPECT_GT(beside, 500);
}

// A pole is as thick as it is narrow: rays that pass farther behind it do not meet it.
TEST(MirroredPicture, APoleIsAsThickAsItIsNarrow) {
  for (const bool planes : {false, true}) {
    Poles poles(1000, {0.3, 0.02}, 10, 158, 162);
    if (planes) {
      poles.show_reflection();
      poles.look.of<FresnelReflection>().facets = FresnelReflection::Facets::kSpread;
    }
    int candidates = 0, met = 0, passed = 0;
    poles.each([&](int x, int y, float color) {
      if (poles.water(x, y) > 9 || poles.mirrored_at(x, y, poles.far).y < 0.3) return;
      const double pixel = poles.width() * 10 / Poles::kWide.width;
      const auto column = [&](double distance) {
        return poles.column_of(poles.mirrored_at(x, y, distance));
      };
      const double front = column(10), back = column(10 + 6 * pixel);
      if (front > 159 && front < 161) {
        ++candidates;
        met += color == kInside;
      }
      const double before = std::min(front, back), after = std::max(front, back);
      const double wall = column(poles.far);
      if (std::abs(wall - 160) < 3) return;  // texels beside the pole are mixed with it
      if (after < 157 || before > 163) {
        EXPECT_NEAR(color, kWall, 0.5) << x << ", " << y;  // a little of the sky over the edge
        ++passed;
      }
    });
    EXPECT_GT(candidates, 50) << planes;
    // The 16 steps in the planes may lead past the pole.
    EXPECT_GE(met, planes ? candidates / 2 : candidates) << planes;
    EXPECT_GT(passed, 1000) << planes;
  }
}

}  // namespace
}  // namespace limpid
