#include <new>

#include <gtest/gtest.h>

#include "limpid/raster/rasterise.h"

#include "allocations/count.h"
#include "raster/raster_scenes.h"

namespace limpid {
namespace {

/// A host's executor whose tasks find no memory, and may not throw.
class Starved : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) {
      try {
        const test::NoMemory none;
        task(context, i);
      } catch (...) {
        ++thrown;
      }
    }
  }
  int thrown = 0;
};

TEST(Allocations, WantOfMemoryInATaskIsThrownOnceTheTasksAreDone) {
  const Model model = test::mixed_model();
  Starved starved;
  EXPECT_THROW(
      rasterise(model, test::mixed_view(64, 48), test::low_sun(), test::kEverything, starved),
      std::bad_alloc);
  EXPECT_EQ(starved.thrown, 0);
}

}  // namespace
}  // namespace limpid
