#include "complete/edges.h"

#include <vector>

#include <gtest/gtest.h>

#include "complete/post.h"
#include "core/edge_cover.h"

// Pixels that show water and an object before it.

namespace limpid {
namespace {

using test::Post;

constexpr int kRow = 60;

/// The frame after Edges, and the edges of a row.
struct Parted {
  Edges edges;
  Frame frame;

  explicit Parted(const Post& post, int threads = 1) : frame(post.buffers.frame) {
    edges.make(frame, post.pass(), *make_executor(threads));
  }
  const EdgeCover::Pixel* at(int x, int y = kRow) const {
    if (!frame.edges) return nullptr;
    for (const auto& p : frame.edges->rows[static_cast<std::size_t>(y - frame.edges->first_row)]) {
      if (p.x == x) return &p;
    }
    return nullptr;
  }
  bool wet(int x, const Post& post) const {
    const RowRays<double> rays(post.pass(), kRow + 0.5);
    return rays.calm_depth(x + 0.5) < frame.plane(PlaneId::kDepth).at(x, kRow);
  }
  /// The share of a pixel that is not water.
  double cover(int x, const Post& post) const {
    if (const EdgeCover::Pixel* p = at(x)) return p->cover;
    return wet(x, post) ? 0 : 1;
  }
};

void expect_parted(const Post& post, double tolerance) {
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  for (int x = 0; x < Post::kSize.width; ++x) {
    EXPECT_NEAR(parted.cover(x, post), post.cover(x), tolerance) << x;
    const EdgeCover::Pixel* p = parted.at(x);
    if (!p) continue;
    // The two parts add up to the pixel; the part behind is the bottom.
    for (int c = 0; c < 3; ++c) {
      const PlaneId plane = plane_after(PlaneId::kColorR, c);
      const float behind = parted.frame.plane(plane).at(x, kRow);
      EXPECT_NEAR(Post::channel(p->color, c) + (1 - p->cover) * behind,
                  post.buffers.frame.plane(plane).at(x, kRow), 1e-6);
      EXPECT_NEAR(behind, Post::channel(post.light, c), 0.05 + post.texture / 2) << x;
    }
    EXPECT_NEAR(parted.frame.plane(PlaneId::kDepth).at(x, kRow), post.bottom_depth(kRow),
                0.02 * post.bottom_depth(kRow));
  }
}

TEST(Edges, OfAFilterOfMotionAndOfALens) {
  for (const double blur : {1.0, 2.0, 6.0, 16.0}) {
    SCOPED_TRACE(blur);
    Post post;
    post.blur = blur;
    expect_parted(post.make(), 0.06);
  }
}

TEST(Edges, WithDepthsOfOneSampleOfMany) {
  for (const double blur : {4.0, 12.0}) {
    SCOPED_TRACE(blur);
    Post post;
    post.blur = blur;
    post.kind = Post::Depth::kOneSample;
    expect_parted(post.make(), 0.08);
  }
}

// The post covers at most .6 of any pixel: no pixel shows the post alone.
TEST(Edges, OfWhatIsThinnerThanItsBlur) {
  Post post;
  post.width = 6;
  post.blur = 10;
  post.kind = Post::Depth::kOneSample;
  post.make();
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  double sum = 0, truth = 0, off = 0;
  for (int x = 50; x < 80; ++x) {
    sum += parted.cover(x, post);
    truth += post.cover(x);
    off = std::max(off, std::abs(parted.cover(x, post) - post.cover(x)));
  }
  EXPECT_NEAR(sum, truth, 0.2 * truth);
  EXPECT_LT(off, 0.25);
}

/// Reeds left and right of a post, each .3 of a pixel wide. The depth's sample hits every third row
/// of them.
constexpr double kReed = 0.3;
bool has_reed(int x) { return (x > 4 && x < 36 && x % 5 == 0) || (x > 92 && x % 5 == 0); }
Post among_reeds(double blur, const Rgb<float>& reed) {
  Post post;
  post.blur = blur;
  post.make();
  const auto change = [&](PlaneId id, const auto& changed) {
    const View<const float>& plane = post.buffers.frame.plane(id);
    std::vector<float> before;
    for (int y = 0; y < Post::kSize.height; ++y) {
      for (int x = 0; x < Post::kSize.width; ++x) before.push_back(plane.at(x, y));
    }
    post.buffers.set(id, [&](int x, int y) {
      const float was = before[static_cast<std::size_t>(y * Post::kSize.width + x)];
      return has_reed(x) ? changed(x, y, was) : was;
    });
  };
  for (int c = 0; c < 3; ++c) {
    change(plane_after(PlaneId::kColorR, c), [&](int, int, float behind) {
      return behind + static_cast<float>(kReed) * (Post::channel(reed, c) - behind);
    });
  }
  change(PlaneId::kDepth, [](int x, int y, float behind) {
    return (x + y) % 3 == 0 ? static_cast<float>(Post::kPostDepth) : behind;
  });
  return post;
}

// The post shows that the picture is filtered, and so the reeds are.
TEST(Edges, OfWhatIsThinnerThanAPixel) {
  const Post post = among_reeds(1.3, {0.1f, 0.06f, 0.03f});
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  double sum = 0, count = 0;
  for (int x = 8; x < 120; ++x) {
    if (!has_reed(x)) continue;
    sum += parted.cover(x, post), count += 1;
    EXPECT_LT(parted.cover(x, post), 0.6) << x;
  }
  EXPECT_NEAR(sum / count, kReed, 0.1);
}

TEST(Edges, OfWhatIsThinnerThanAPixelAndOfTheColorBehindAreNone) {
  const Post post = among_reeds(1.3, Post{}.light);
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  for (int x = 8; x < 120; ++x) {
    if (has_reed(x)) {
      EXPECT_EQ(parted.cover(x, post), 0) << x;
    }
  }
}

// A thin object of another color is there, even where the bottom's texture hides the reeds.
TEST(Edges, OfWhatIsThinAndOfAnotherColorAreNotWater) {
  Post post = among_reeds(1.3, Post{}.light);
  const View<const float> before = post.buffers.frame.plane(PlaneId::kColorR);
  std::vector<float> red;
  for (int y = 0; y < Post::kSize.height; ++y) {
    for (int x = 0; x < Post::kSize.width; ++x) red.push_back(before.at(x, y));
  }
  post.buffers.set(PlaneId::kColorR, [&](int x, int y) {
    return x == 15 && y == kRow ? 5 : red[static_cast<std::size_t>(y * Post::kSize.width + x)];
  });
  const Parted parted(post);
  EXPECT_EQ(parted.cover(15, post), 1);
}

// Without a filter the sample that hits an object is all of its pixel.
TEST(Edges, OfWhatIsThinAndUnfilteredStayHard) {
  EXPECT_FALSE(Parted(among_reeds(0, {0.1f, 0.06f, 0.03f})).frame.edges);
}

// Within three pixels of each edge is the next one: an edge alone does not tell the filter.
TEST(Edges, OfPalesThatStandClose) {
  const auto cover = [](int x) {
    const double inside = 1.6 - std::abs(std::fmod(x + 0.5, 6.4) - 3.2);
    return std::clamp(inside + 0.5, 0.0, 1.0);
  };
  Post post;
  post.make();
  for (int c = 0; c < 3; ++c) {
    const float pale = Post::channel(post.dark, c), water = Post::channel(post.light, c);
    post.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int) {
      return water + static_cast<float>(cover(x)) * (pale - water);
    });
  }
  post.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return cover(x) > 0.5 ? static_cast<float>(Post::kPostDepth) : post.bottom_depth(y);
  });
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  for (int x = 8; x < 120; ++x) EXPECT_NEAR(parted.cover(x, post), cover(x), 0.06) << x;
}

// A bright line as wide as a pixel along one of four posts changes most there, and does not grow.
TEST(Edges, OfMostObjectsTellThoseOfOneWithABrightLine) {
  constexpr int kApart = 32, kWide = 12;
  const auto inside = [](int x) { return kWide / 2 - std::abs((x % kApart) + 0.3 - kApart / 2); };
  const auto cover = [&](int x) { return std::clamp(inside(x) + 0.5, 0.0, 1.0); };
  Post post;
  post.make();
  for (int c = 0; c < 3; ++c) {
    post.buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int) {
      const bool line = x < kApart && cover(x) > 0.5 && inside(x) < 1;
      const float front = line ? 60.0f : Post::channel(post.dark, c);
      return static_cast<float>(cover(x)) * front +
             static_cast<float>(1 - cover(x)) * Post::channel(post.light, c);
    });
  }
  post.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return cover(x) > 0.5 ? static_cast<float>(Post::kPostDepth) : post.bottom_depth(y);
  });
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  for (int x = kApart; x < Post::kSize.width; ++x)
    EXPECT_NEAR(parted.cover(x, post), cover(x), 0.1) << x;
}

TEST(Edges, TextureOfBothSidesDoesNotCount) {
  Post post;
  post.blur = 2;
  post.texture = 0.4f;
  expect_parted(post.make(), 0.25);
}

// Light and texture make the two sides differ more with distance from the edge. This is no blur: an
// antialiased post, though thin, stays as it is.
TEST(Edges, LightThatChangesAlongTheBottomIsNoBlur) {
  Post post;
  post.blur = 1;
  post.width = 12;
  post.rise = 1;
  post.texture = 0.5f;
  post.make();
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  for (int y = 20; y < 80; ++y) {
    for (int x = 0; x < Post::kSize.width; ++x) {
      const double from_edge = std::abs(std::abs(x + 0.5 - Post::kMiddle) - post.width / 2);
      if (from_edge > 2.5) {
        EXPECT_FALSE(parted.at(x, y)) << x << " " << y;
      }
    }
  }
}

TEST(Edges, HardOnesStayAsTheyAre) {
  for (const float texture : {0.0f, 0.6f}) {
    Post post;
    post.texture = texture;
    const Parted parted(post.make());
    EXPECT_FALSE(parted.frame.edges);
    for (int i = 0; i < kPlaneCount; ++i) {
      EXPECT_EQ(parted.frame.planes[i].data, post.buffers.frame.planes[i].data);
    }
  }
}

TEST(Edges, SidesOfOneColorDoNotTell) {
  Post post;
  post.blur = 4;
  post.dark = post.light;
  EXPECT_FALSE(Parted(post.make()).frame.edges);
}

// Light that rises across both sides, as wide as the picture, is no blur either.
TEST(Edges, LightOverBothSidesIsNoBlur) {
  Post post;
  post.dark = post.light;
  post.make();
  for (int c = 0; c < 3; ++c) {
    post.buffers.set(plane_after(PlaneId::kColorR, c),
                     [](int x, int y) { return 0.2f + 0.01f * float(x) + 0.004f * float(y); });
  }
  EXPECT_FALSE(Parted(post).frame.edges);
}

// The ground goes on through the water's edge; the ground's color changes slowly everywhere.
TEST(Edges, AShoreIsNone) {
  Post post;
  post.make();
  post.buffers.set(PlaneId::kDepth, [&](int, int y) { return 2.0f + 0.03f * float(96 - y); });
  for (int c = 0; c < 3; ++c) {
    post.buffers.set(plane_after(PlaneId::kColorR, c),
                     [](int, int y) { return 0.2f + 0.002f * float(y); });
  }
  EXPECT_FALSE(Parted(post).frame.edges);
}

// The alpha of a picture without a bottom is the share of its objects.
TEST(Edges, AlphaTellsWhereNothingIsBehind) {
  Post post;
  post.blur = 6;
  post.light = {0, 0, 0};
  post.make();
  post.buffers.set(PlaneId::kColorA, [&](int x, int) { return static_cast<float>(post.cover(x)); });
  post.buffers.set(PlaneId::kDepth, [&](int x, int) {
    return post.cover(x) > 0.5 ? static_cast<float>(Post::kPostDepth) : test::kInf;
  });
  const Parted parted(post);
  ASSERT_TRUE(parted.frame.edges);
  int found = 0;
  for (int x = 0; x < Post::kSize.width; ++x) {
    const EdgeCover::Pixel* p = parted.at(x);
    if (!p) continue;
    ++found;
    EXPECT_FLOAT_EQ(p->cover, static_cast<float>(post.cover(x)));
    EXPECT_NEAR(p->color.r, post.dark.r * p->cover, 1e-6);
    EXPECT_NEAR(parted.frame.plane(PlaneId::kColorR).at(x, kRow), 0, 1e-9);
    EXPECT_EQ(parted.frame.plane(PlaneId::kDepth).at(x, kRow), test::kInf);
  }
  EXPECT_EQ(found, 12);
}

/// The layers of deep samples: the post, and the bottom behind it.
struct DeepPost {
  Post post;
  std::array<Plane, 4> before;

  DeepPost() {
    post.blur = 8;
    post.make();
    for (int c = 0; c < 4; ++c) {
      Plane& plane = before[static_cast<std::size_t>(c)] = Plane(rect_of(Post::kSize));
      for (int y = 0; y < Post::kSize.height; ++y) {
        for (int x = 0; x < Post::kSize.width; ++x) {
          const auto cover = static_cast<float>(post.cover(x));
          plane.view().at(x, y) = c == 3 ? cover : cover * Post::channel(post.dark, c);
        }
      }
      post.buffers.frame.foreground[static_cast<std::size_t>(c)] = plane.view();
    }
    post.buffers.set(PlaneId::kBelowDepth, [&](int, int y) { return post.bottom_depth(y); });
    for (int c = 0; c < 3; ++c) {
      post.buffers.fill(plane_after(PlaneId::kBelowR, c), Post::channel(post.light, c));
    }
  }
};

TEST(Edges, DeepSamplesTellThemExactly) {
  DeepPost deep;
  const Parted parted(deep.post);
  ASSERT_TRUE(parted.frame.edges);
  for (int x = 0; x < Post::kSize.width; ++x) {
    const double cover = deep.post.cover(x);
    EXPECT_NEAR(parted.cover(x, deep.post), cover, 1e-6) << x;
    const EdgeCover::Pixel* p = parted.at(x);
    EXPECT_EQ(p != nullptr, cover > 0 && cover < 1) << x;
    if (!p) continue;
    EXPECT_EQ(parted.frame.plane(PlaneId::kColorG).at(x, kRow), deep.post.light.g);
    EXPECT_NEAR(parted.frame.plane(PlaneId::kDepth).at(x, kRow), deep.post.bottom_depth(kRow),
                1e-5);
    EXPECT_NEAR(p->color.g, cover * deep.post.dark.g, 1e-6);
  }
}

TEST(Edges, DeepSamplesWithoutALayerBelowDoNotTell) {
  DeepPost deep;
  deep.post.buffers.frame.planes[index_of(PlaneId::kBelowDepth)] = {};
  EXPECT_FALSE(Parted(deep.post).frame.edges);
}

TEST(Edges, ViewsThatMayBeginInTheWaterAreLeftAlone) {
  Post post;
  post.blur = 4;
  post.make();
  Pass pass = post.pass();
  pass.submersible = true;
  Frame frame = post.buffers.frame;
  Edges().make(frame, pass, *make_executor(1));
  EXPECT_FALSE(frame.edges);
}

TEST(Edges, ThreadsDoNotMatterNorFramesBefore) {
  Post post;
  post.blur = 5;
  post.texture = 0.2f;
  post.make();
  const Parted one(post);
  Parted two(post, 2);
  const auto expect_same = [&] {
    ASSERT_TRUE(one.frame.edges && two.frame.edges);
    for (int y = 0; y < Post::kSize.height; ++y) {
      for (int x = 0; x < Post::kSize.width; ++x) {
        const EdgeCover::Pixel *a = one.at(x, y), *b = two.at(x, y);
        ASSERT_EQ(a == nullptr, b == nullptr);
        if (a) {
          EXPECT_EQ(a->cover, b->cover);
        }
        for (const PlaneId id : {PlaneId::kColorR, PlaneId::kDepth}) {
          EXPECT_EQ(one.frame.plane(id).at(x, y), two.frame.plane(id).at(x, y));
        }
      }
    }
  };
  expect_same();
  Post hard;
  hard.make();
  Frame other = hard.buffers.frame;
  two.edges.make(other, hard.pass(), *make_executor(2));
  EXPECT_FALSE(other.edges);
  two.frame = post.buffers.frame;
  two.edges.make(two.frame, post.pass(), *make_executor(2));
  expect_same();
}

// Interleaved pixels, and color that reaches farther than depth.
TEST(Edges, StridesAndWindowsDoNotMatter) {
  Post post;
  post.blur = 3;
  post.make();
  const Parted plain(post);
  const Rect window = rect_of(Post::kSize), wider{-3, -2, window.x1 + 5, window.y1 + 1};
  std::vector<float> pixels(static_cast<std::size_t>(3 * wider.area()));
  Frame frame = post.buffers.frame;
  for (int c = 0; c < 3; ++c) {
    const View<float> to{pixels.data() + c, 3, std::ptrdiff_t{3} * wider.width(), wider};
    View<const float>& from = frame.planes[index_of(plane_after(PlaneId::kColorR, c))];
    for (int y = wider.y0; y < wider.y1; ++y) {
      for (int x = wider.x0; x < wider.x1; ++x) {
        to.at(x, y) = from.at(std::clamp(x, 0, window.x1 - 1), std::clamp(y, 0, window.y1 - 1));
      }
    }
    from = to;
  }
  Edges edges;
  edges.make(frame, post.pass(), *make_executor(1));
  ASSERT_TRUE(frame.edges);
  EXPECT_EQ(frame.plane(PlaneId::kColorR).window, wider);
  EXPECT_EQ(frame.plane(PlaneId::kColorB).at(-3, 5), frame.plane(PlaneId::kColorB).at(0, 5));
  for (int x = 0; x < window.x1; ++x) {
    EXPECT_EQ(frame.plane(PlaneId::kColorG).at(x, kRow),
              plain.frame.plane(PlaneId::kColorG).at(x, kRow));
  }
}

}  // namespace
}  // namespace limpid
