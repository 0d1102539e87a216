#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "limpid/gpu/gpu_runner.h"

namespace limpid {

/// A hard case, measured: an input at the edge of what numbers can say, and what became of it. What
/// is measured is an error or a count, and up to `bound` of it is right.
struct HardRow {
  std::string group, name;
  std::string quantity;  ///< what is measured, with its unit
  std::string reason;    ///< why the bound is what it is
  double bound = 0, measured = 0;
  std::int64_t values = 0;  ///< that were judged; of none nothing is known
  std::string worst;        ///< where the largest was: runner, look, pixel; "" where all were 0

  bool passed() const { return values > 0 && measured <= bound; }
  /// The share of the bound that is left: 1 where nothing was measured, below 0 where it is broken.
  double margin() const { return measured == 0 ? 1 : 1 - measured / bound; }
};

/// All hard cases. Bounds come from theory (quantisation, roundings counted, closed forms in long
/// double) or are 0. Where a chain is run it is run by `reference` and by `fused` on every
/// instruction set that the machine has, by a GPU if one is named, and with every look of the data
/// folder where any will do.
class HardSuite {
 public:
  /// Reads the looks of a data folder. `threads` as for make_executor(); the numbers do not depend
  /// on them. Throws Error where there are no looks, and as GpuRunner.
  explicit HardSuite(const std::filesystem::path& data, int threads = 1,
                     const GpuOptions* gpu = nullptr);
  HardSuite(HardSuite&&) noexcept;
  HardSuite& operator=(HardSuite&&) noexcept;
  ~HardSuite();

  /// "group: name" of every case, in order. Needs no files.
  static std::vector<std::string> names();
  /// Throws Error for an unknown name.
  HardRow measure(const std::string& name) const;
  std::vector<HardRow> measure_all() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A line a row, and one that counts those within their bounds.
std::string to_text(std::span<const HardRow> rows);

}  // namespace limpid
