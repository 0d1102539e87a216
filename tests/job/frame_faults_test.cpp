#include "job/frame_faults.h"

#include <string>

#include <gmock/gmock.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

TEST(FrameFaultsTest, EveryFrameIsLookedAtAndEachFaultIsToldInOrder) {
  const auto executor = make_executor(3);
  Sequence sequence;
  for (int frame = 20; frame > 0; --frame) sequence.frames.push_back(frame);
  const auto check_of = [](int frame) -> std::function<void()> {
    if (frame == 17) throw Error("no scene");
    return [frame] {
      if (frame % 5 == 0) throw Error("no plate " + std::to_string(frame));
    };
  };
  std::string told;
  for (const FrameFault& fault : faults_of_frames(sequence, check_of, *executor)) {
    told += std::to_string(fault.frame) + ": " + fault.sentence + "\n";
  }
  EXPECT_EQ(told,
            "20: no plate 20\n17: no scene\n15: no plate 15\n10: no plate 10\n5: no plate 5\n");
}

}  // namespace
}  // namespace limpid
