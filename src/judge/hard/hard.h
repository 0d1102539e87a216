#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "limpid/gpu/gpu_runner.h"

namespace limpid {

/// A hard case, measured: an input at the limits of number formats, and its result. `measured` is
/// an error or a count; values up to `bound` are right.
struct HardRow {
  std::string group, name;
  std::string quantity;  ///< the measured quantity, with its unit
  std::string reason;    ///< derivation of the bound
  double bound = 0, measured = 0;
  std::int64_t values = 0;  ///< number of judged values; with 0 the case shows nothing
  std::string worst;        ///< place of the largest: runner, look, pixel; "" if all were 0

  bool passed() const { return values > 0 && measured <= bound; }
  /// The unused share of the bound: 1 if 0 was measured, below 0 if the bound is broken.
  double margin() const { return measured == 0 ? 1 : 1 - measured / bound; }
};

/// All hard cases. Bounds come from theory (quantisation, counted roundings, closed forms in long
/// double) or are 0. A chain runs by `reference` and by `fused` on every instruction set of the
/// machine, by a GPU if one is named, and with every look of the data folder if the case holds for
/// any look.
class HardSuite {
 public:
  /// Reads the looks of a data folder. `threads` as for make_executor(); the results do not depend
  /// on them. Throws Error if there are no looks, and as GpuRunner.
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

/// A line per row, and one with the number of rows within their bounds.
std::string to_text(std::span<const HardRow> rows);

}  // namespace limpid
