#include "limpid/compositor.h"

#include <gtest/gtest.h>

#include "allocations/count.h"
#include "embed/host.h"

namespace limpid {
namespace {

/// No run after the first allocates, whatever must be converted on entry and output.
TEST(Allocations, NoneAfterACompositorsFirstFrame) {
  const Size size{133, 77};
  const test::Buffers b = test::noisy_frame(rect_of(size));
  Scene scene = test::simple_scene(size);
  scene.water->waves = {{0.05, 1, 0.5, 0, 2}, {0.03, 0.2, 2, 1, 3}};
  const test::Picture picture(rect_of(size));
  test::HostMemory halves(4, rect_of(size), {.sample = Sample::kHalf, .interleaved = true});
  for (const Conventions& conventions :
       {Conventions{.trusted = true}, Conventions{}, Conventions{.depth = DepthKind::kInverse}}) {
    for (const bool half : {false, true}) {
      HostFrame frame = test::host_frame(b.frame, scene);
      HostPicture out = test::host_picture(picture.target, {Aov::kPath});
      for (int c = 0; half && c < 4; ++c) {
        test::fill(halves.channel(c), b.frame.planes[c]);
        frame.planes[c] = halves.channel(c);
        (c < 3 ? out.color[static_cast<std::size_t>(c)] : out.alpha) = halves.channel(c);
      }
      Compositor compositor(conventions);
      compositor.run(frame, out);
      const int before = test::allocations();
      for (int i = 0; i < 3; ++i) {
        frame.scene.time += 0.04;
        compositor.run(frame, out);
      }
      EXPECT_EQ(test::allocations(), before) << static_cast<int>(conventions.depth) << half;
    }
  }
}

}  // namespace
}  // namespace limpid
