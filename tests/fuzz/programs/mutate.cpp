// Reads damaged copies of every file below a folder, each in a process of its own: none may
// crash, take longer than kMaxSeconds, or more memory than the limit and a tenth.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/memory_file.h"
#include "fuzz/mutations.h"
#include "fuzz/probe.h"
#include "fuzz/read_exr.h"

namespace {

namespace fs = std::filesystem;
using namespace limpid::fuzz;

constexpr int kMaxSeconds = 2;
constexpr long long kLimit = 256LL << 20;

struct File {
  fs::path path;
  std::vector<std::uint8_t> bytes;
};

/// All of them: names tell little about damaged ones.
std::vector<File> files_below(const fs::path& folder) {
  std::vector<File> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    files.push_back({entry.path(), {bytes.begin(), bytes.end()}});
  }
  std::sort(files.begin(), files.end(),
            [](const File& a, const File& b) { return a.path < b.path; });
  return files;
}

/// What became of all copies.
struct Tally {
  long long copies = 0, accepted = 0, refused = 0, broken = 0;
  double slowest = 0;
  long long largest = 0;
  std::string slowest_name, largest_name;

  void add(const Outcome& outcome, const std::string& name) {
    ++copies;
    accepted += outcome.end == Outcome::End::kAccepted;
    refused += outcome.end == Outcome::End::kRefused;
    if (outcome.seconds > slowest) slowest = outcome.seconds, slowest_name = name;
    if (outcome.memory > largest) largest = outcome.memory, largest_name = name;
    std::string cause = outcome.cause;
    if (cause.empty() && outcome.memory > kLimit + kLimit / 10) {
      cause = std::to_string(outcome.memory >> 20) + " MiB";
    }
    if (cause.empty()) return;
    ++broken;
    std::printf("BROKEN: %s: %s\n", name.c_str(), cause.c_str());
  }
};

int run(const fs::path& folder, std::uint64_t count) {
  limpid::Limits limits;
  limits.max_memory = kLimit;
  const std::vector<File> files = files_below(folder);
  MemoryFile memory;
  Tally tally;
  const long long baseline = probe([] {}, kMaxSeconds).memory;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const File& other = files[(f + 1) % files.size()];
    for (std::uint64_t number = 0; number < count; ++number) {
      memory.hold(damaged(files[f].bytes, other.bytes, number));
      Outcome outcome = probe([&] { read_exr(memory.path(), limits); }, kMaxSeconds, 4 * kLimit);
      outcome.memory -= std::min(outcome.memory, baseline);
      tally.add(outcome, files[f].path.string() + " #" + std::to_string(number) + " (" +
                             std::string(name_of(damage_of(number))) + ")");
    }
  }
  std::printf("%zu files, %lld copies: %lld read, %lld refused, %lld broken\n", files.size(),
              tally.copies, tally.accepted, tally.refused, tally.broken);
  std::printf("slowest  %.3f s of the processor, at most %d: %s\n", tally.slowest, kMaxSeconds,
              tally.slowest_name.c_str());
  std::printf("largest  %.1f MiB, at most %.1f: %s\n",
              static_cast<double>(tally.largest) / (1 << 20), 1.1 * (kLimit >> 20),
              tally.largest_name.c_str());
  return tally.copies > 0 && tally.broken == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 1000;
  const char* text = argc == 3 ? argv[2] : "1000";
  const bool number = std::from_chars(text, text + std::strlen(text), count).ec == std::errc();
  if (argc < 2 || argc > 3 || !number || !fs::is_directory(argv[1])) {
    std::fprintf(stderr, "mutate FOLDER [COPIES]: expected a folder with EXR files and a number\n");
    return 2;
  }
  return run(argv[1], count);
}
