#include "complete/mirror.h"

#include <gtest/gtest.h>

#include "complete/sky.h"

// The picture of a mirror from plates that lack buffers.

namespace limpid {
namespace {

using test::kInf;
using test::kInside;
using test::kSky;
using test::kWall;
using test::Mirror;
using test::Ridge;
using test::Shore;

TEST(AutoMirror, ShowsThePictureItselfWithoutAReflection) {
  Mirror mirror;
  EXPECT_GT(mirror.check(mirror.pictures()), 100);
}

// A transparent film shows no sky.
TEST(AutoMirror, ShowsTheColorOfTheLookWhereThereIsNoSky) {
  Mirror mirror;
  mirror.buffers.fill(PlaneId::kColorA, 0);
  EXPECT_GT(mirror.check(mirror.pictures(), 0.25f), 100);
}

TEST(AutoMirror, ShowsTheSkyOfTheSceneOrAGuessWhereThereIsNoSky) {
  Mirror mirror;
  mirror.buffers.fill(PlaneId::kColorA, 0);
  mirror.look.of<FresnelReflection>().color = {0, 0, 0};
  const Rgb<double> guess = guessed_sky(
      mirror.buffers.frame, Pass(mirror.scene, mirror.buffers.frame, 1.333, kWholeState));
  EXPECT_GT(guess.r, 1);
  EXPECT_GT(mirror.check(mirror.pictures(), static_cast<float>(guess.r)), 100);
  mirror.scene.sky = SkyLight{.radiance = {0.75, 0.75, 0.75}};
  EXPECT_GT(mirror.check(mirror.pictures(), 0.75f), 100);
}

TEST(AutoMirror, ShowsTheReflectionAndNeverItsInsides) {
  Mirror mirror;
  mirror.give_reflection();
  EXPECT_GT(mirror.check(mirror.pictures()), 100);
  // Waves that lean away and back look where the reflection has insides, and do not show them.
  mirror.buffers.set(PlaneId::kSurfaceNormalX, [](int, int) { return 0.0f; });
  mirror.buffers.set(PlaneId::kSurfaceNormalY, [](int, int) { return 1.0f; });
  mirror.buffers.set(PlaneId::kSurfaceNormalZ,
                     [](int x, int y) { return 0.2f * (test::noise(x, y, 3) - 0.5f); });
  const test::Picture wavy = test::fused(mirror.look, mirror.buffers.frame, mirror.scene);
  int changed = 0;
  for (int y = 0; y < Shore::kSize.height; ++y) {
    for (int x = 0; x < Shore::kSize.width; ++x) {
      if (!mirror.wet(x, y)) continue;
      EXPECT_LE(wavy.color(x, y).r, kSky + 1e-3f) << x << ", " << y;
      changed += std::abs(wavy.color(x, y).r - mirror.expected(x, y)) > 1e-3;
    }
  }
  EXPECT_GT(changed, 50);
  // Without the completed planes the picture shows insides.
  mirror.look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
  const test::Picture planar = test::fused(mirror.look, mirror.buffers.frame, mirror.scene);
  float most = 0;
  for (int y = 0; y < Shore::kSize.height; ++y) {
    for (int x = 0; x < Shore::kSize.width; ++x) {
      if (mirror.wet(x, y)) most = std::max(most, float(planar.color(x, y).r));
    }
  }
  EXPECT_GT(most, 2 * kSky);
}

// A low, flat bank: the mirror saw the sky over it, and its inside. Facets that mirror along the
// water show the bank.
TEST(AutoMirror, ShowsTheOutsideOfABankThatTheMirrorSawFromWithin) {
  Ridge ridge(0.5, -0.3);
  for (int c = 0; c < 3; ++c) {
    ridge.buffers.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      const double height = 2 + ridge.far * ridge.ray(x, y).y;
      return height > 0 && height < ridge.top ? kInside : kSky;
    });
  }
  ridge.buffers.frame.planes[index_of(PlaneId::kReflectionDepth)] = {};
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  int wet = 0;
  for (int y = 150; y < Ridge::kWide.height; ++y) {
    for (int x = 20; x < Ridge::kWide.width - 20; ++x, ++wet) {
      EXPECT_EQ(picture.color(x, y).r, kWall) << x << ", " << y;
    }
  }
  EXPECT_GT(wet, 1000);
}

// No texel of the reflection shows the wall from outside; the picture does. Under water the wall
// stands back, so that the depths of both differ.
TEST(AutoMirror, ShowsInThePictureWhatTheReflectionLacks) {
  Ridge ridge(3, 0.05);
  ridge.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const float depth = ridge.depth(x, y);
    return depth == kInf || 2 + ridge.far * ridge.ray(x, y).y > 0 ? depth : depth + 1;
  });
  ridge.buffers.set(PlaneId::kReflectionValid,
                    [&](int x, int y) { return ridge.image_depth(x, y) == kInf ? 1.0f : 0.0f; });
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  int met = 0;
  for (int y = 150; y < Ridge::kWide.height; ++y) {
    for (int x = 20; x < Ridge::kWide.width - 20; ++x) {
      const double at = ridge.passes_at(x, y);
      if (!(at > 0.3 && at < 2.7)) continue;
      ++met;
      EXPECT_EQ(picture.color(x, y).r, kWall) << x << ", " << y;
    }
  }
  EXPECT_GT(met, 1000);
}

/// The crown of a tree over the water, or a ridge: a wall from a height on, in front of the sky.
/// Waves are far shorter than a pixel.
struct Crown : Mirror {
  explicit Crown(double above, double top_of_wall = 6, double distance = 20) {
    top = top_of_wall, far = distance;
    const auto depth = [=, this](int x, int y) {
      const double sinks = ray(x, y).y;
      if (2 + far * sinks > above) return 2 + far * sinks > top ? kInf : static_cast<float>(far);
      return sinks < 0 ? static_cast<float>(-(2 + deep) / sinks) : kInf;
    };
    buffers.set(PlaneId::kDepth, depth);
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        return depth(x, y) == kInf ? kSky : depth(x, y) == static_cast<float>(far) ? kWall : 1.0f;
      });
    }
    WaveNormals::Params& waves = look.of<WaveNormals>();
    waves.model = WaveNormals::Model::kSines;
    waves.filter = WaveNormals::Filter::kVariance;
    waves.strength = 1;
    scene.water->waves = {{0.0014, 0, 100, 0, 1}};  // slopes of .1
    look.of<FresnelReflection>().facets = FresnelReflection::Facets::kSpread;
  }
  /// The mean of the mirrored light in the row of water at a distance.
  double light_at(double distance) {
    const test::Picture picture = test::reference(look, buffers.frame, scene);
    double sum = 0;
    int row = kSize.height / 2;
    while (2 / -ray(0, row).y > distance) ++row;
    for (int x = 16; x < 48; ++x) sum += picture.color(x, row).r / 32;
    return sum;
  }
};

// A ray below the skyline that passes a little behind the crown is not one of the sky.
TEST(AutoMirror, MirrorsACrownThatItsRaysPassCloseBehind) {
  EXPECT_LT(Crown(2).light_at(17), kWall);
  // Rays far below a bridge end in the sky behind it.
  EXPECT_GT(Crown(4).light_at(17), 6);
}

/// A black wall before a black sky, over a white bottom in clear water: waves that mirror all light
/// show the bottom only where their rays meet other waves, which let some of it through.
TEST(AutoMirror, LevelRaysMeetTheNextWaveUnlessSomethingStandsBeforeIt) {
  const auto shown = [](double amplitude, double k, bool reflection) {
    Mirror mirror;
    for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      mirror.buffers.set(id, [&](int x, int y) { return mirror.wet(x, y) ? 1.0f : 0; });
    }
    if (reflection) {
      for (int c = 0; c < 3; ++c) mirror.buffers.fill(plane_after(PlaneId::kReflectionR, c), 0);
      mirror.buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) {
        return static_cast<float>(mirror.mirrored_depth(x, y));
      });
    }
    mirror.look.of<FresnelReflection>().facets = FresnelReflection::Facets::kSpread;
    WaveNormals::Params& waves = mirror.look.of<WaveNormals>();
    waves.model = WaveNormals::Model::kSines;
    waves.filter = WaveNormals::Filter::kVariance;
    waves.strength = 1;
    mirror.scene.water->waves = {{amplitude, 0, k, 0, 1}};
    const test::Picture picture = mirror.pictures();
    double most = 0;
    constexpr int kFoot = 29;  // in the row above, lookups mix the wall and the bottom
    for (int y = kFoot; y < Shore::kSize.height; ++y) {
      for (int x = 0; x < Shore::kSize.width; ++x) {
        if (mirror.wet(x, y)) most = std::max<double>(most, picture.color(x, y).r);
      }
    }
    return most;
  };
  for (const bool reflection : {false, true}) {
    EXPECT_GT(shown(0.03, 4, reflection), 0.05);
    EXPECT_LT(shown(0.03, 4, reflection), 1);
    EXPECT_LT(shown(1e-3, 4, reflection), 0.01);  // hardly any ray is so level
    // Waves twice as long as the water: the wall comes before the next wave.
    EXPECT_LT(shown(0.8, 0.15, reflection), 0.05);
  }
}

// A far ridge that the facets of a pixel mirror in part: with the planes of a reflection the other
// part mirrors the sky over it, as without them.
TEST(AutoMirror, MirrorsTheSkyOverARidgeInTheReflectionAsInThePicture) {
  Crown ridge(0, 100, 2000), reflected(0, 100, 2000);
  reflected.buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) {
    return static_cast<float>(reflected.mirrored_depth(x, y));
  });
  for (int c = 0; c < 3; ++c) {
    reflected.buffers.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      return reflected.mirrored_depth(x, y) == reflected.far ? kWall : kSky;
    });
  }
  for (const double distance : {10.0, 12.0, 14.0, 16.0}) {
    EXPECT_NEAR(reflected.light_at(distance), ridge.light_at(distance), 0.1) << distance;
  }
}

// A wave that mirrors higher than the reflection reaches: the picture of the surroundings is there,
// but a wall that leaves the reflection at its edge goes on.
TEST(AutoMirror, ShowsTheSurroundingsBeyondTheEdgeOfTheReflection) {
  constexpr float kSurroundings = 0.5f;
  Plane around(rect_of({8, 4}));
  for (int y = 0; y < 4; ++y) std::fill_n(&around.view().at(0, y), 8, kSurroundings);
  for (const double top : {1.0, 1000.0}) {
    Ridge ridge(top, 0.3);
    for (View<const float>& view : ridge.buffers.frame.environment.channels) view = around.view();
    const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
    const test::Picture fused = test::fused(ridge.look, ridge.buffers.frame, ridge.scene);
    int wet = 0;
    for (int y = 150; y < Ridge::kWide.height; ++y) {
      for (int x = 20; x < Ridge::kWide.width - 20; ++x, ++wet) {
        EXPECT_NEAR(picture.color(x, y).r, top > 1 ? kWall : kSurroundings, 1e-5) << x << ", " << y;
        EXPECT_NEAR(fused.color(x, y).r, picture.color(x, y).r, 1e-4) << x << ", " << y;
        EXPECT_EQ(picture.aov(Aov::kMirrorSources, x, y, 2), top > 1 ? 0 : 1);
      }
    }
    EXPECT_GT(wet, 1000);
  }
  // A depth that is computed from the dry picture does not know what that picture does not show.
  Ridge ridge(1000, 0.3);
  ridge.buffers.frame.planes[index_of(PlaneId::kReflectionDepth)] = {};
  ridge.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return 2 + ridge.far * ridge.ray(x, y).y > 5 ? kInf : ridge.depth(x, y);
  });
  for (View<const float>& view : ridge.buffers.frame.environment.channels) view = around.view();
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  EXPECT_EQ(picture.color(160, 200).r, kWall);
}

// The mirror's camera sees a post before the wall. A ray that a wave behind that post mirrors
// does not meet it, but the wall, which the picture shows.
TEST(AutoMirror, LooksUpInThePictureWhatTheReflectionHides) {
  constexpr double kPost = 8;
  Ridge ridge(3, 0.05);
  const auto is_post = [](int x) { return x > 140 && x < 180; };
  for (int c = 0; c < 3; ++c) {
    ridge.buffers.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      return is_post(x) ? kInside : ridge.image_depth(x, y) == kInf ? kSky : kWall;
    });
  }
  ridge.buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) {
    return is_post(x) ? float{kPost} : ridge.image_depth(x, y);
  });
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  const test::Picture fused = test::fused(ridge.look, ridge.buffers.frame, ridge.scene);
  int walls = 0;
  for (int y = 0; y < Ridge::kWide.height; ++y) {
    for (int x = 145; x < 175; ++x) {
      const double water = ridge.ray(x, y).y < 0 ? -2 / ridge.ray(x, y).y : HUGE_VAL;
      const double passes = ridge.passes_at(x, y);
      if (water < 1.5 * kPost || water > ridge.far - 1 || passes < 0.2 || passes > 2.5) continue;
      EXPECT_EQ(picture.color(x, y).r, kWall) << x << ", " << y;
      EXPECT_NEAR(fused.color(x, y).r, kWall, 1e-5) << x << ", " << y;
      EXPECT_EQ(picture.aov(Aov::kMirrorSources, x, y, 1), 1) << x << ", " << y;
      ++walls;
    }
  }
  EXPECT_GT(walls, 100);
}

// Where the reflection has no data, as at an object's foot, the picture comes before the
// surroundings.
TEST(AutoMirror, LooksUpInThePictureWhatTheReflectionLacks) {
  constexpr float kSurroundings = 0.5f;
  Plane around(rect_of({8, 4}));
  for (int y = 0; y < 4; ++y) std::fill_n(&around.view().at(0, y), 8, kSurroundings);
  Ridge ridge(3, 0.05);
  ridge.deep = 0.05;  // the wall does not go on below the water
  ridge.buffers.set(PlaneId::kDepth, [&](int x, int y) { return ridge.depth(x, y); });
  for (View<const float>& view : ridge.buffers.frame.environment.channels) view = around.view();
  ridge.buffers.fill(PlaneId::kReflectionValid, 0);
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  int walls = 0, skies = 0;
  for (int y = 0; y < Ridge::kWide.height; ++y) {
    const int x = Ridge::kWide.width / 2;
    const double water = ridge.ray(x, y).y < 0 ? -2 / ridge.ray(x, y).y : HUGE_VAL;
    const double passes = ridge.passes_at(x, y);
    if (water > ridge.far - 1 || passes < 0.2 || std::abs(passes - 3) < 0.5) continue;
    EXPECT_EQ(picture.color(x, y).r, passes < 3 ? kWall : kSurroundings) << y;
    (passes < 3 ? walls : skies) += 1;
  }
  EXPECT_GT(walls, 10);
  EXPECT_GT(skies, 10);
}

// A rock just before the water hides nothing from a ray that goes away from it.
TEST(AutoMirror, MeetsNothingNearerThanTheWater) {
  Ridge ridge(3, 0.05);
  const auto water = [&](int x, int y) { return -2 / std::min(ridge.ray(x, y).y, -1e-6); };
  const auto is_rock = [&](int x, int y) { return y > 150 && y < 200 && x > 140 && x < 180; };
  for (int c = 0; c < 3; ++c) {
    ridge.buffers.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      return is_rock(x, y) ? kInside : ridge.image_depth(x, y) == kInf ? kSky : kWall;
    });
  }
  ridge.buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) {
    return is_rock(x, y) ? static_cast<float>(0.97 * water(x, y)) : ridge.image_depth(x, y);
  });
  const test::Picture picture = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
  for (int y = 170; y < 200; ++y) {
    for (int x = 145; x < 175; ++x) EXPECT_LE(picture.color(x, y).r, kSky) << x << ", " << y;
  }
}

TEST(AutoMirror, MeetsARidgeOnlyWhereItsRaysPassBelowIt) {
  for (const double top : {1.0, 1.5, 3.0}) {
    int walls = 0;
    for (const double lean : {-0.02, 0.0, 0.03, 0.06, 0.1, 0.2}) {
      Ridge ridge(top, lean);
      const double pixel = -2 * ridge.far * ridge.ray(0, Ridge::kWide.height / 2).y;
      const test::Picture exact = test::reference(ridge.look, ridge.buffers.frame, ridge.scene);
      for (int y = 0; y < Ridge::kWide.height; ++y) {
        const int x = Ridge::kWide.width / 2;
        const double passes = ridge.passes_at(x, y);
        const bool wet = ridge.ray(x, y).y < 0 && 2 / -ridge.ray(x, y).y < ridge.far - 0.1;
        if (!wet || passes < 0 || std::abs(passes - top) < 4 * pixel) continue;
        // Places up to four pixels off count as right, and texels beside the edge are mixed.
        EXPECT_EQ(exact.color(x, y).r < 0.5 * (kWall + kSky), passes < top)
            << top << ", " << lean << ", row " << y;
        walls += passes < top;
      }
    }
    EXPECT_GT(walls, 10) << top;
  }
}

// A ray that passes behind an object shows the sky beside it, but not close beside it, where the
// object's colors may end elsewhere than its depth.
TEST(AutoMirror, ARayBehindAnObjectLandsApartFromItsOutline) {
  constexpr int kFirst = 40, kShown = 37;
  Mirror shore;
  for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
    shore.buffers.set(id, [](int x, int y) { return y < kShown ? 1 + 0.1f * float(x) : kInside; });
  }
  shore.buffers.set(PlaneId::kReflectionDepth, [](int, int y) { return y < kFirst ? kInf : 1.0f; });
  shore.buffers.fill(PlaneId::kReflectionValid, 1).fill(PlaneId::kDepth, kInf);
  shore.buffers.normal({0, std::cos(0.15), std::sin(0.15)});
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    shore.buffers.fill(id, kInside);
  }
  const test::Picture picture = shore.pictures();
  for (int y = 30; y < kShown - 4; ++y) {
    for (int x = 20; x < 44; ++x) {
      ASSERT_TRUE(shore.wet(x, y)) << x << ", " << y;
      EXPECT_NEAR(picture.color(x, y).r, 1.0 + 0.1 * x, 0.15) << x << ", " << y;
    }
  }
}

// A jetty right before the viewer hides the whole mirrored scene: what is seen past it is in the
// picture, but not the jetty there, which is nearer than the water.
TEST(AutoMirror, ShowsThePictureInTheDirectionOfWhatTheReflectionHides) {
  Mirror shore;
  for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
    shore.buffers.fill(id, 50);
  }
  shore.buffers.fill(PlaneId::kReflectionDepth, 1).fill(PlaneId::kReflectionValid, 1);
  shore.buffers.normal({0, std::cos(0.1), std::sin(0.1)});  // a level mirror shows its own texel
  const test::Picture picture = shore.pictures();
  const Rect jetty{20, 0, 30, 20};
  const auto on_jetty = [=](int x, int y) { return jetty.contains({x, y, x + 1, y + 1}); };
  shore.buffers.set(PlaneId::kDepth,
                    [&](int x, int y) { return on_jetty(x, y) ? 1 : shore.dry_depth(x, y); });
  shore.buffers.set(PlaneId::kColorR, [&](int x, int y) {
    return on_jetty(x, y) ? kInside : shore.dry_depth(x, y) == kInf ? kSky : kWall;
  });
  const test::Picture past = shore.pictures();
  int skies = 0, walls = 0;
  // Beside the edge a ray's place is too near to the pixel to tell.
  for (int y = 0; y < Shore::kSize.height - 4; ++y) {
    for (int x = 4; x < Shore::kSize.width - 4; ++x) {
      if (!shore.wet(x, y)) continue;
      const double color = picture.color(x, y).r;
      EXPECT_GE(color, kWall) << x << ", " << y;
      EXPECT_LE(color, kSky) << x << ", " << y;
      skies += color == kSky;
      walls += color == kWall;
      EXPECT_NE(past.color(x, y).r, kInside) << x << ", " << y;
    }
  }
  EXPECT_GT(skies, 50);
  EXPECT_GT(walls, 50);
  // Of directions far beyond its edge the picture tells nothing.
  shore.buffers.normal({0, std::cos(0.5), std::sin(0.5)});
  const test::Picture high = shore.pictures();
  for (int x = 4; x < Shore::kSize.width - 4; ++x) EXPECT_EQ(high.color(x, 36).r, 50) << x;
}

}  // namespace
}  // namespace limpid
