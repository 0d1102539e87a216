#include "fuzz/mutations.h"

#include <algorithm>
#include <iterator>
#include <random>

namespace limpid::fuzz {
namespace {

constexpr std::size_t kHeader = 1024;  // bytes that nearly every header ends within
constexpr std::uint32_t kEdges[] = {0,          1,          2,          0x7f,       0xff,
                                    0x100,      0x7fff,     0xffff,     0x10000,    0x7fffffff,
                                    0x80000000, 0xfffffffe, 0xffffffff, 0x40000000, 0x00ffffff};

/// Numbers without std::uniform_int_distribution, which differs between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t end) { return end == 0 ? 0 : engine_() % end; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(engine_()); }
  bool one_in(std::size_t count) { return below(count) == 0; }

 private:
  std::mt19937_64 engine_;
};

/// Headers are small, but most faults of parsers show there: every second place is in a header.
std::size_t some_place(Random& random, std::size_t size) {
  return random.below(random.one_in(2) ? std::min(size, kHeader) : size);
}

void flip_bits(std::vector<std::uint8_t>& bytes, Random& random) {
  for (std::size_t left = 1 + random.below(8); left > 0; --left) {
    bytes[some_place(random, bytes.size())] ^= static_cast<std::uint8_t>(1u << random.below(8));
  }
}

void fill_run(std::vector<std::uint8_t>& bytes, Random& random) {
  const std::size_t begin = some_place(random, bytes.size());
  const std::size_t end = std::min(bytes.size(), begin + 1 + random.below(64));
  const std::size_t kind = random.below(3);
  for (std::size_t i = begin; i < end; ++i) {
    bytes[i] = kind == 0 ? std::uint8_t{0} : kind == 1 ? std::uint8_t{0xff} : random.byte();
  }
}

void splice(std::vector<std::uint8_t>& bytes, Bytes other, Random& random) {
  if (other.empty()) other = bytes;
  const std::size_t from = random.below(other.size());
  const std::vector<std::uint8_t> piece(
      other.begin() + static_cast<std::ptrdiff_t>(from),
      other.begin() +
          static_cast<std::ptrdiff_t>(std::min(other.size(), from + 1 + random.below(4096))));
  const std::size_t place = some_place(random, bytes.size());
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(place);
  if (random.one_in(2)) {
    bytes.insert(at, piece.begin(), piece.end());
  } else {
    std::copy_n(piece.begin(), std::min(piece.size(), bytes.size() - place), at);
  }
}

void edit_field(std::vector<std::uint8_t>& bytes, Random& random) {
  const std::size_t header = std::min(bytes.size(), kHeader);
  const std::uint32_t value = kEdges[random.below(std::size(kEdges))];
  const std::size_t place = random.below(header);
  for (std::size_t i = 0; i < 4 && place + i < bytes.size(); ++i) {
    bytes[place + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace

std::string_view name_of(Damage damage) {
  constexpr std::string_view kNames[] = {"none", "bits", "run", "cut", "splice", "field"};
  return kNames[static_cast<std::size_t>(damage)];
}

Damage damage_of(std::uint64_t number) {
  return number == 0 ? Damage::kNone : kDamages[number % std::size(kDamages)];
}

std::vector<std::uint8_t> damaged(Bytes bytes, Bytes other, std::uint64_t number) {
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  if (copy.empty()) return copy;
  Random random(number);
  switch (damage_of(number)) {
    case Damage::kNone:
      break;
    case Damage::kBits:
      flip_bits(copy, random);
      break;
    case Damage::kRun:
      fill_run(copy, random);
      break;
    case Damage::kCut:
      copy.resize(some_place(random, copy.size()));
      break;
    case Damage::kSplice:
      splice(copy, other, random);
      break;
    case Damage::kField:
      edit_field(copy, random);
      break;
  }
  return copy;
}

}  // namespace limpid::fuzz
