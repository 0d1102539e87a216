#include "complete/bottom_layer.h"

#include <functional>

#include <gtest/gtest.h>

#include "complete/pool.h"

// The bottom behind objects before it.

namespace limpid {
namespace {

using test::Pool;
using test::PoolOf;

constexpr double kThing = 40;  ///< color of the object; the bottom's colors are below 1

double floor_color(double x, double z) { return 0.5 + 0.2 * std::sin(x) + 0.1 * std::sin(z); }

/// A pool with an object before the pixels of a rectangle, at a share of the bottom's depth.
struct Hidden {
  Pool pool;
  Rect thing;

  explicit Hidden(const Rect& at, double share = 0.5) : thing(at) {
    pool.draw(floor_color);
    for (int c = 0; c < 3; ++c) {
      pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        const glm::dvec3 place = pool.dry_depth(x, y) * pool.ray(x, y);
        return static_cast<float>(hides(x, y) ? kThing : floor_color(place.x, place.z));
      });
    }
    pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
      return static_cast<float>((hides(x, y) ? share : 1) * pool.dry_depth(x, y));
    });
  }
  bool hides(int x, int y) const { return thing.contains({x, y, x + 1, y + 1}); }
  double drop(int x, int y) const {
    const glm::dvec3 place = pool.dry_depth(x, y) * pool.ray(x, y);
    return -2 - place.y;
  }
  const BottomLayer* made(BottomLayerMaker& maker, int threads = 1,
                          const std::array<double, 3>& sun_over_rest = {}) const {
    const auto executor = make_executor(threads);
    return maker.make(pool.buffers.frame, pool.pass(), sun_over_rest, *executor);
  }
};

/// The value at the middle of a pixel, bilinear.
double at_pixel(const BottomLayer& layer, const View<const float>& view, int x, int y) {
  const double u = (x + 0.5) / Pool::kSize.width, v = (y + 0.5) / Pool::kSize.height;
  const double px = (layer.scale.x * u + layer.offset.x) * view.window.width() - 0.5;
  const double py = (layer.scale.y * v + layer.offset.y) * view.window.height() - 0.5;
  const int x0 = static_cast<int>(std::floor(px)), y0 = static_cast<int>(std::floor(py));
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int column = x0 + (k & 1), row = y0 + (k >> 1);
    const double weight = (k & 1 ? px - x0 : 1 - px + x0) * (k >> 1 ? py - y0 : 1 - py + y0);
    sum += weight * view.at(std::clamp(column, 0, view.window.width() - 1),
                            std::clamp(row, 0, view.window.height() - 1));
  }
  return sum;
}

TEST(BottomLayer, IsNotMadeWhereNothingStandsBeforeTheBottom) {
  BottomLayerMaker maker;
  EXPECT_FALSE(Hidden({0, 0, 0, 0}).made(maker));
  // No layer is made where the bottom rises out of the water, either.
  Hidden beach({0, 0, 0, 0});
  beach.pool.rise = -0.3;
  beach.pool.draw(floor_color);
  EXPECT_FALSE(beach.made(maker));
}

TEST(BottomLayer, GoesOnBehindWhatStandsInTheWaterOrAboveIt) {
  for (const double share : {0.3, 0.45, 0.7}) {  // the surface is at about half of the depth
    const Hidden hidden({40, 44, 52, 56}, share);
    BottomLayerMaker maker;
    const BottomLayer* layer = hidden.made(maker);
    ASSERT_TRUE(layer) << share;
    for (int y = 36; y < 64; ++y) {
      for (int x = 32; x < 60; ++x) {
        EXPECT_NEAR(at_pixel(*layer, layer->shape.channels[0], x, y), hidden.drop(x, y), 0.1)
            << share << ": " << x << ", " << y;
        // Colors come little from the edges, and only where no other pixel is known.
        EXPECT_LT(at_pixel(*layer, layer->colors.channels[0], x, y), 0.85);
        EXPECT_GT(at_pixel(*layer, layer->colors.channels[0], x, y), 0.15);
      }
    }
  }
}

TEST(BottomLayer, IsWhatThePictureShowsElsewhere) {
  const Hidden hidden({40, 44, 52, 56});
  BottomLayerMaker maker;
  const BottomLayer* layer = hidden.made(maker);
  ASSERT_TRUE(layer);
  for (int y = 40; y < 70; ++y) {
    for (int x = 2; x < 30; ++x) {
      const glm::dvec3 place = hidden.pool.dry_depth(x, y) * hidden.pool.ray(x, y);
      EXPECT_NEAR(at_pixel(*layer, layer->colors.channels[1], x, y), floor_color(place.x, place.z),
                  0.06);
      EXPECT_NEAR(at_pixel(*layer, layer->shape.channels[0], x, y), hidden.drop(x, y), 0.05);
      EXPECT_EQ(at_pixel(*layer, layer->shape.channels[2], x, y), 0);
    }
  }
}

TEST(BottomLayer, ThingsAreThickAsTheyAreWide) {
  double last = 0;
  for (const int width : {2, 6, 14}) {
    const Hidden hidden({40, 30, 40 + width, 68}, 0.7);
    BottomLayerMaker maker;
    const BottomLayer* layer = hidden.made(maker);
    ASSERT_TRUE(layer) << width;
    const double depth = 0.7 * hidden.pool.dry_depth(40, 50);
    const double pixel = 2 * std::tan(0.45) / Pool::kSize.height * depth;
    const double thickness = 1 / at_pixel(*layer, layer->shape.channels[2], 40 + width / 2, 50);
    // The layer takes objects for a third as thick as wide, in cells of four pixels, by windows
    // each twice as wide as the last.
    EXPECT_GT(thickness, 0.2 * width * pixel) << width;
    EXPECT_LT(thickness, 0.33 * (2 * width + 8) * pixel) << width;
    EXPECT_GE(thickness, last);
    last = thickness;
  }
}

// Also if only the shadow tells of the sun's light.
TEST(BottomLayer, OfAKnownSunIsThatOfASunlitBottom) {
  constexpr std::array kOverRest{4.0, 2.0, 1.0};
  Hidden hidden({40, 44, 52, 56});
  const auto lit = [](int x) { return x < 46 ? 0.25 : 1; };
  for (int c = 0; c < 3; ++c) {
    const double sun = kOverRest[static_cast<std::size_t>(c)];
    hidden.pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      const double light = (1 + sun * lit(x)) / (1 + sun);
      return static_cast<float>(hidden.hides(x, y) ? kThing : 0.5 * light);
    });
  }
  for (int c = 0; c < 3; ++c) {
    const double sun = kOverRest[static_cast<std::size_t>(c)];
    hidden.pool.buffers.set(plane_after(PlaneId::kSunColorR, c), [&](int x, int) {
      return static_cast<float>(0.5 * sun * lit(x) / (1 + sun));
    });
  }
  BottomLayerMaker maker;
  EXPECT_FALSE(hidden.made(maker, 1, kOverRest)->lit);  // without a shadow
  hidden.pool.buffers.set(PlaneId::kShadow, [&](int x, int) { return static_cast<float>(lit(x)); });
  EXPECT_FALSE(hidden.made(maker)->lit);
  const BottomLayer* shaded = hidden.made(maker);
  EXPECT_LT(at_pixel(*shaded, shaded->colors.channels[0], 20, 50), 0.25);
  for (const bool known : {true, false}) {
    for (int c = 0; !known && c < 3; ++c) {
      hidden.pool.buffers.frame.planes[index_of(plane_after(PlaneId::kSunColorR, c))] = {};
    }
    const BottomLayer* layer = hidden.made(maker, 1, kOverRest);
    EXPECT_TRUE(layer->lit);
    for (int x = 4; x < 80; x += 3) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(at_pixel(*layer, layer->colors.channels[c], x, 50), 0.5, 0.02)
            << x << " " << c << " " << known;
      }
    }
  }
  hidden.pool.buffers.set(
      PlaneId::kShadow, [&](int x, int) { return static_cast<float>(lit(x)); },
      Rect{0, 0, Pool::kSize.width, Pool::kSize.height - 1});
  EXPECT_FALSE(hidden.made(maker, 1, kOverRest)->lit);  // not of all texels
}

// Under the strip of floor that the picture shows, a rim hides the floor; above it is a wall, and a
// post.
TEST(BottomLayer, WallsDoNotGoOn) {
  Hidden hidden({0, 64, 96, 72}, 0.3);
  const Rect post{80, 40, 84, 50};
  constexpr double kWall = 8;  // distance ahead
  hidden.pool.rise = 0;
  const auto dry = [&](int x, int y) {
    const double depth = hidden.pool.dry_depth(x, y);
    const bool hides = hidden.hides(x, y) || post.contains({x, y, x + 1, y + 1});
    return static_cast<float>(hides ? 0.3 * depth : std::min(depth, kWall));
  };
  hidden.pool.buffers.set(PlaneId::kDepth, dry).fill(PlaneId::kShadow, 1);
  for (int c = 0; c < 3; ++c) hidden.pool.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0);
  BottomLayerMaker maker;
  const BottomLayer* layer = hidden.made(maker, 1, {1, 1, 1});
  ASSERT_TRUE(layer);
  for (int x = 8; x < 90; x += 10) {
    EXPECT_GT(at_pixel(*layer, layer->shape.channels[0], x, 69), 1.9) << x;
  }
}

TEST(BottomLayer, ThreadsDoNotMatter) {
  const Hidden hidden({33, 41, 50, 57});
  BottomLayerMaker alone, crowd;
  const BottomLayer *one = hidden.made(alone), *four = hidden.made(crowd, 4);
  ASSERT_TRUE(one && four);
  for (const auto part : {&BottomLayer::colors, &BottomLayer::shape}) {
    for (std::size_t c = 0; c < 3; ++c) {
      const View<const float>&a = (one->*part).channels[c], &b = (four->*part).channels[c];
      for (int y = 0; y < a.window.height(); ++y) {
        for (int x = 0; x < a.window.width(); ++x) ASSERT_EQ(a.at(x, y), b.at(x, y));
      }
    }
  }
}

// --- rays that end behind an object ------------------------------------------------------------

constexpr float kPlain = 0.5f;

float checks(int x, int y) { return (x / 5 + y / 5) % 2 == 0 ? 5.0f : 50.0f; }

/// Marched rays, which pass behind objects of that thickness.
Look rays(double thickness = 0) {
  Look look = test::still_look();
  look.of<Refraction>() = {};
  look.of<Refraction>().off_frame = Refraction::OffFrame::kShorten;
  look.of<Refraction>().thickness = thickness;
  return look;
}

/// A plain bottom, before which a checked board stands: its shape and place.
struct Checked {
  PoolOf<288, 216> pool;
  std::function<double(const glm::dvec3& from, const glm::dvec3& along)> meets;  ///< +inf: never

  explicit Checked(decltype(meets) board) : meets(std::move(board)) {
    pool.rise = 0;
    pool.draw([](double, double) { return double{kPlain}; });
    const auto depth = [&](int x, int y) {
      return std::min(pool.dry_depth(x, y), meets({0, 0, 0}, pool.ray(x, y)));
    };
    for (int c = 0; c < 3; ++c) {
      pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        return depth(x, y) < pool.dry_depth(x, y) ? checks(x, y) : kPlain;
      });
    }
    pool.buffers.set(PlaneId::kDepth,
                     [&](int x, int y) { return static_cast<float>(depth(x, y)); });
    for (int axis = 0; axis < 3; ++axis) {
      pool.buffers.set(plane_after(PlaneId::kSurfaceNormalX, axis),
                       [&](int x, int y) { return static_cast<float>(wave(x, y)[axis]); });
    }
  }
  /// The normal of the water at a pixel.
  glm::dvec3 wave(int x, int y) const {
    const glm::dvec3 at = (-2 / pool.ray(x, y).y) * pool.ray(x, y);
    return glm::normalize(
        glm::dvec3(0.06 * std::sin(3 * at.x + at.z), 1, 0.06 * std::sin(2 * at.z)));
  }
  /// Whether the pixel's water shows the board.
  bool shows_board(int x, int y) const {
    const glm::dvec3 r = pool.ray(x, y), n = wave(x, y), v = glm::normalize(r);
    if (meets({0, 0, 0}, r) < -2 / r.y) return true;  // the board stands before the water
    return meets((-2 / r.y) * r, glm::refract(v, n, 1 / 1.333)) < HUGE_VAL;
  }
  /// The number of pixels that show the board through the water, away from its outline.
  int streaks(const Look& look) const {
    const test::Picture wet = test::reference(look, pool.buffers.frame, pool.scene);
    int count = 0;
    for (int y = 0; y < pool.kSize.height; ++y) {
      for (int x = 0; x < pool.kSize.width; ++x) {
        if (!(pool.ray(x, y).y < -0.12)) continue;
        bool near = false;
        for (int k = 0; k < 9; ++k) near = near || shows_board(x + k % 3 - 1, y + k / 3 - 1);
        if (!near && wet.aov(Aov::kTransmitted, x, y) > 1.1 * kPlain) ++count;
      }
    }
    return count;
  }
};

/// A box with that middle and half size (Kay & Kajiya 1986, "Ray tracing complex scenes").
auto box(glm::dvec3 middle, glm::dvec3 half) {
  return [=](const glm::dvec3& from, const glm::dvec3& along) {
    double enters = 0, leaves = HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
      const double a = (middle[i] - half[i] - from[i]) / along[i];
      const double b = (middle[i] + half[i] - from[i]) / along[i];
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    return enters < leaves ? enters : HUGE_VAL;
  };
}

// Where the pixel itself shows the bottom, the end of its ray is looked up in the layer, not before
// the object that hides the end; also where a layer below shows the object without the parts above
// the water.
TEST(BottomLayer, ARayFromBottomToBottomEndsBehindWhatStandsInTheWater) {
  Hidden hidden({36, 40, 56, 60}, 0.7);
  const auto layer_below = [&] {
    for (int c = 0; c < 3; ++c) {
      hidden.pool.buffers.set(plane_after(PlaneId::kBelowR, c), [&](int x, int y) {
        return hidden.pool.buffers.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
      });
    }
    hidden.pool.buffers.set(PlaneId::kBelowDepth, [&](int x, int y) {
      return hidden.pool.buffers.frame.plane(PlaneId::kDepth).at(x, y);
    });
  };
  for (const bool below : {false, true}) {
    if (below) layer_below();
    SCOPED_TRACE(below ? "with a layer below" : "color and depth");
    const test::Picture wet = test::reference(rays(), hidden.pool.buffers.frame, hidden.pool.scene);
    int behind = 0;
    for (int y = 20; y < Pool::kSize.height; ++y) {
      for (int x = 30; x < 62; ++x) {
        const auto end = hidden.pool.end(x, y);
        const bool inside = end.x > 37 && end.x < 54 && end.y > 41 && end.y < 58;
        if (hidden.hides(x, y) || !inside || wet.aov(Aov::kConfidence, x, y) > 0) continue;
        ++behind;
        EXPECT_LT(wet.aov(Aov::kTransmitted, x, y), 1);
        EXPECT_NEAR(wet.aov(Aov::kStmapG, x, y, 0) * Pool::kSize.width - 0.5, end.x, 1);
        EXPECT_NEAR((1 - wet.aov(Aov::kStmapG, x, y, 1)) * Pool::kSize.height - 0.5, end.y, 1);
      }
    }
    EXPECT_GT(behind, 10);
  }
}

// The pixel shows an object far behind the object that hides the end of its ray; bottom lies
// between the two objects.
TEST(BottomLayer, ARayFromAFarObjectEndsBehindANearOne) {
  const Rect far{38, 26, 54, 46};
  Hidden hidden({43, 44, 49, 64}, 0.7);
  const auto is_far = [&](int x, int y) {
    return !hidden.hides(x, y) && far.contains({x, y, x + 1, y + 1});
  };
  for (int c = 0; c < 3; ++c) {
    hidden.pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      const glm::dvec3 place = hidden.pool.dry_depth(x, y) * hidden.pool.ray(x, y);
      const bool thing = hidden.hides(x, y) || is_far(x, y);
      return static_cast<float>(thing ? kThing : floor_color(place.x, place.z));
    });
  }
  hidden.pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const double share = hidden.hides(x, y) ? 0.7 : is_far(x, y) ? 0.85 : 1;
    return static_cast<float>(share * hidden.pool.dry_depth(x, y));
  });
  const test::Picture wet = test::reference(rays(), hidden.pool.buffers.frame, hidden.pool.scene);
  int behind = 0;
  for (int y = far.y0; y < far.y1; ++y) {
    for (int x = far.x0; x < far.x1; ++x) {
      const auto end = hidden.pool.end(x, y);
      const bool inside = end.x > 44 && end.x < 47 && end.y > 46 && end.y < 62;
      if (!is_far(x, y) || !inside || wet.aov(Aov::kConfidence, x, y) > 0) continue;
      ++behind;
      EXPECT_LT(wet.aov(Aov::kTransmitted, x, y), 1) << x << ", " << y;
      EXPECT_NEAR(wet.aov(Aov::kPath, x, y), end.distance, 0.25) << x << ", " << y;
    }
  }
  EXPECT_GT(behind, 4);
}

// A post that stands on the bottom: its foot, a steep slope, is nearly as deep as the bottom.
TEST(BottomLayer, FeetOfObjectsAreNoBottom) {
  Hidden hidden({40, 36, 52, 64});
  for (int c = 0; c < 3; ++c) {
    hidden.pool.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      return static_cast<float>(hidden.hides(x, y) ? kThing : 0.5);
    });
  }
  hidden.pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return static_cast<float>(hidden.pool.dry_depth(x, hidden.hides(x, y) ? 64 : y));
  });
  BottomLayerMaker maker;
  const BottomLayer* layer = hidden.made(maker);
  ASSERT_TRUE(layer);
  for (int y = 40; y < 54; ++y) {
    EXPECT_NEAR(at_pixel(*layer, layer->colors.channels[0], 46, y), 0.5, 0.2) << y;
    EXPECT_NEAR(at_pixel(*layer, layer->shape.channels[0], 46, y), hidden.drop(46, y), 0.2) << y;
  }
}

// Sunlight from the right, unrefracted 1.5 to the left on its way to the bottom, refracted 1; no
// sunlight enters at x < 0. Its strength is that of sun_color, or of the shadow's edge.
TEST(BottomLayer, ShadowsOfTheWaterFallOnTheBottomBehindAnObject) {
  constexpr double kRest = 0.2, kSun = 0.3;
  Hidden hidden({20, 40, 44, 60}, 0.7);
  hidden.pool.rise = 0;
  hidden.pool.scene.sun = Sun{.direction = {0.6, 0.8, 0}};
  hidden.pool.scene.sky = {{0.8 * kRest / kSun, 0.8 * kRest / kSun, 0.8 * kRest / kSun}};
  test::Buffers& buffers = hidden.pool.buffers;
  const auto lit = [&](int x, int y) {
    const double at = (hidden.pool.dry_depth(x, y) * hidden.pool.ray(x, y)).x;
    return hidden.hides(x, y) || at > -1.5 ? 1.0f : 0.0f;
  };
  for (int c = 0; c < 3; ++c) {
    buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      return static_cast<float>(hidden.hides(x, y) ? kThing : kRest + kSun * lit(x, y));
    });
    buffers.set(plane_after(PlaneId::kSunColorR, c), [&](int x, int y) {
      return static_cast<float>((hidden.hides(x, y) ? kThing / (kRest + kSun) : lit(x, y)) * kSun);
    });
  }
  buffers.set(PlaneId::kShadow, lit);
  buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return static_cast<float>((hidden.hides(x, y) ? 0.7 : 1) * hidden.pool.dry_depth(x, y));
  });
  buffers.set(PlaneId::kSurfaceShadow, [&](int x, int y) {
    const glm::dvec3 ray = hidden.pool.ray(x, y);
    return (-2 / ray.y * ray).x < 0 ? 0.0f : 1.0f;
  });
  Look look = rays();
  look.of<Caustics>() = {};
  for (const bool known : {true, false}) {
    for (int c = 0; !known && c < 3; ++c) {
      buffers.frame.planes[index_of(plane_after(PlaneId::kSunColorR, c))] = {};
    }
    const test::Picture wet = test::reference(look, buffers.frame, hidden.pool.scene);
    int dark = 0, bright = 0;
    for (int y = 20; y < Pool::kSize.height; ++y) {
      for (int x = 0; x < Pool::kSize.width; ++x) {
        const auto end = hidden.pool.end(x, y);
        const bool inside = end.x > 21 && end.x < 42 && end.y > 41 && end.y < 58;
        if (hidden.hides(x, y) || !inside || wet.aov(Aov::kConfidence, x, y) > 0) continue;
        if (std::abs(end.at.x + 1.008) < 0.15) continue;
        const bool shaded = end.at.x < -1;
        (shaded ? dark : bright) += 1;
        EXPECT_NEAR(wet.aov(Aov::kTransmitted, x, y), kRest + (shaded ? 0 : kSun), 0.06)
            << x << ", " << y << ": " << end.at.x << " " << known;
      }
    }
    EXPECT_GT(dark, 5);
    EXPECT_GT(bright, 5);
  }
}

TEST(BottomLayer, NothingOfAPostIsDraggedAlong) {
  EXPECT_EQ(Checked(box({0.2, -2.2, -4}, {0.1, 1.5, 0.1})).streaks(rays()), 0);
}

TEST(BottomLayer, NothingOfABoatIsDraggedAlong) {
  EXPECT_EQ(Checked(box({-0.3, -1.7, -4.5}, {0.7, 0.4, 0.3})).streaks(rays()), 0);
}

TEST(BottomLayer, NothingOfWhatHoversUnderWaterIsDraggedAlong) {
  EXPECT_EQ(Checked(box({0.1, -2.7, -4}, {0.25, 0.25, 0.25})).streaks(rays()), 0);
  // A sheet is thinner than wide: `thickness` must say so.
  EXPECT_EQ(Checked(box({0.1, -2.6, -4}, {0.35, 0.01, 0.3})).streaks(rays(0.02)), 0);
}

TEST(BottomLayer, EndsBehindAPostWhereThePictureShowsNoBottom) {
  constexpr double kEnd = 12, kUnsure = 1.5;  // end of the bottom; not judged around it
  PoolOf<288, 216> pool;
  pool.rise = 0;
  pool.draw([](double, double) { return double{kPlain}; });
  const auto post = box({0.2, -2.5, -6}, {0.3, 2, 0.3});
  const auto lies = [](double z) { return -z < kEnd; };
  const auto dry = [&](int x, int y) {
    const glm::dvec3 r = pool.ray(x, y);
    const double floor = pool.dry_depth(x, y);
    return std::min(lies(floor * r.z) ? floor : HUGE_VAL, post({0, 0, 0}, r));
  };
  pool.buffers.set(PlaneId::kDepth, [&](int x, int y) { return static_cast<float>(dry(x, y)); });
  const test::Picture wet = test::reference(rays(), pool.buffers.frame, pool.scene);
  int ended = 0, bottom = 0;
  for (int y = 0; y < pool.kSize.height; ++y) {
    for (int x = 0; x < pool.kSize.width; ++x) {
      const glm::dvec3 r = pool.ray(x, y), in = glm::normalize(r);
      if (!(in.y < -0.02) || dry(x, y) < -2 / r.y) continue;  // no water, or the post before it
      const glm::dvec3 entry = (-2 / r.y) * r, under = glm::refract(in, {0, 1, 0}, 1 / 1.333);
      if (post(entry, under) < HUGE_VAL) continue;
      const double ends = -(entry + -2 / under.y * under).z;
      if (std::abs(ends - kEnd) < kUnsure) continue;
      const bool found = wet.aov(Aov::kPath, x, y) < 1e20;
      EXPECT_EQ(found, ends < kEnd) << x << ", " << y;
      (ends < kEnd ? bottom : ended) += 1;
    }
  }
  EXPECT_GT(ended, 500);
  EXPECT_GT(bottom, 500);
}

TEST(BottomLayer, ARayPassesBehindWhatIsThin) {
  const Checked rope(box({0, -3, -5}, {5, 0.05, 0.05}));
  EXPECT_EQ(rope.streaks(rays()), 0);
  // With a large `thickness` the rope hides more.
  EXPECT_GT(rope.streaks(rays(100)), 0);
}

}  // namespace
}  // namespace limpid
