#include "fuzz/mutations.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>

#include <gmock/gmock.h>

#include "fuzz/memory_file.h"
#include "fuzz/probe.h"
#include "fuzz/read_exr.h"
#include "paths.h"

namespace limpid::fuzz {
namespace {

using testing::HasSubstr;

std::vector<std::uint8_t> counted(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

TEST(Mutations, AreTheSameForTheSameNumberAndAllKindsCome) {
  const std::vector<std::uint8_t> bytes = counted(3000), other(50, 7);
  std::set<Damage> kinds;
  std::set<std::string> copies;
  for (std::uint64_t number = 0; number < 100; ++number) {
    kinds.insert(damage_of(number));
    copies.insert(text_of(damaged(bytes, other, number)));
    EXPECT_EQ(damaged(bytes, other, number), damaged(bytes, other, number));
  }
  EXPECT_EQ(kinds.size(), std::size(kDamages) + 1);
  EXPECT_GT(copies.size(), 90u);
  EXPECT_EQ(damaged(bytes, other, 0), bytes);
}

TEST(Mutations, DoWhatTheirNamesSay) {
  const std::vector<std::uint8_t> bytes = counted(3000), other(50, 7);
  for (std::uint64_t number = 1; number < 200; ++number) {
    const std::vector<std::uint8_t> copy = damaged(bytes, other, number);
    const auto different = [&] {
      std::size_t count = 0;
      for (std::size_t i = 0; i < bytes.size(); ++i) count += copy[i] != bytes[i];
      return count;
    };
    switch (damage_of(number)) {
      case Damage::kNone:
        FAIL() << number;
      case Damage::kBits:
        ASSERT_EQ(copy.size(), bytes.size());
        EXPECT_LE(different(), 8u);
        break;
      case Damage::kRun:
        ASSERT_EQ(copy.size(), bytes.size());
        EXPECT_LE(different(), 64u);
        break;
      case Damage::kCut:
        EXPECT_LT(copy.size(), bytes.size());
        EXPECT_TRUE(std::equal(copy.begin(), copy.end(), bytes.begin()));
        break;
      case Damage::kSplice:
        EXPECT_GE(copy.size(), bytes.size());
        EXPECT_GE(std::count(copy.begin(), copy.end(), 7),
                  std::count(bytes.begin(), bytes.end(), 7));
        break;
      case Damage::kField:
        ASSERT_EQ(copy.size(), bytes.size());
        EXPECT_LE(different(), 4u);
        EXPECT_TRUE(std::equal(copy.begin() + 1030, copy.end(), bytes.begin() + 1030));
        break;
    }
  }
}

TEST(Mutations, OfNothingAndOfOneByte) {
  for (std::uint64_t number = 0; number < 50; ++number) {
    EXPECT_TRUE(damaged({}, {}, number).empty());
    EXPECT_LE(damaged(counted(1), {}, number).size(), 2u);
  }
}

TEST(Probe, TellsHowWorkEnds) {
  using End = Outcome::End;
  EXPECT_EQ(probe([] {}, 2).end, End::kAccepted);
  EXPECT_EQ(probe([] { throw Error("no"); }, 2).end, End::kRefused);
  const Outcome threw = probe([] { throw std::bad_alloc(); }, 2);
  EXPECT_EQ(threw.end, End::kBroken);
  EXPECT_EQ(threw.cause, "an exception that is no Error");
  const Outcome killed = probe([] { std::raise(SIGKILL); }, 2);
  EXPECT_EQ(killed.end, End::kBroken);
  EXPECT_THAT(killed.cause, HasSubstr("signal 9"));
}

TEST(Probe, EndsWhatDoesNotEnd) {
  const Outcome outcome = probe(
      [] {
        for (volatile unsigned i = 0;;) i = i + 1;
      },
      1);
  EXPECT_EQ(outcome.end, Outcome::End::kBroken);
  // Ended by processor time, or on a busy machine by wall-clock time.
  EXPECT_THAT(outcome.cause, testing::AnyOf(HasSubstr("signal 24"), HasSubstr("signal 14"),
                                            HasSubstr("signal 9")));
}

TEST(Probe, MeasuresMemory) {
  constexpr std::size_t kSize = 64 << 20;
  const auto work = [] {
    const std::vector<char> memory(kSize, 'x');
    if (memory[kSize / 2] != 'x') throw Error("lost");
  };
  const long long more = probe(work, 2).memory - probe([] {}, 2).memory;
  EXPECT_GT(more, 0.9 * kSize);
  EXPECT_LT(more, 1.5 * kSize);
}

/// The program `mutate` makes a thousand mutations of each file; this test makes few.
TEST(Mutations, OfDamagedFilesAreRefusedOrRead) {
  std::vector<std::vector<std::uint8_t>> files;
  for (const auto& entry : std::filesystem::directory_iterator(LIMPID_TEST_DATA "/damaged")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    files.emplace_back(bytes.begin(), bytes.end());
  }
  ASSERT_EQ(files.size(), 29u);
  Limits limits;
  limits.max_memory = 64 << 20;
  MemoryFile memory;
  for (std::size_t f = 0; f < files.size(); ++f) {
    for (std::uint64_t number = 1; number < 6; ++number) {
      memory.hold(damaged(files[f], files[(f + 1) % files.size()], number));
      const Outcome outcome = probe([&] { read_exr(memory.path(), limits); }, 20);
      EXPECT_NE(outcome.end, Outcome::End::kBroken)
          << outcome.cause << ", file " << f << " #" << number;
    }
  }
}

}  // namespace
}  // namespace limpid::fuzz
