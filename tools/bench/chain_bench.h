#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/plan/plan.h"

#include "arguments.h"
#include "gl_process.h"
#include "judge/report/picture.h"
#include "made_plate.h"
#include "picture_error.h"
#include "realistic_numbers.h"
#include "rows.h"
#include "scalar_loop.h"

namespace limpid::bench {

/// A look on the plate, and its picture by the reference, if a row needs that picture.
struct JudgedLook {
  JudgedLook(const Look& a_look, const MadePlate& plate);

  Look look;
  Plan plan;
  Picture judge;
  double reference_seconds = 0;  ///< 0 until the reference has run
};

struct ChainRow : Row {
  JudgedLook* judged = nullptr;         ///< the look of the row, if its picture is checked
  std::function<void()> fetch = [] {};  ///< copies the picture into the canvas
  PictureError error = {};
};

/// The rows of the table for a size of picture: the runners of the library and their rivals, on one
/// plate, from the same planes into one canvas.
class ChainBench {
 public:
  /// `label` is the value of --size. Throws Error when a row's picture differs from that of the
  /// reference: its time would be that of other work.
  ChainBench(const std::string& label, const Arguments& arguments);
  ChainBench(const ChainBench&) = delete;
  ChainBench& operator=(const ChainBench&) = delete;

  void time(int rounds) { time_rows(rows_, rounds); }

  const std::vector<ChainRow>& rows() const { return rows_; }
  const MadePlate& plate() const { return plate_; }
  std::string renderer() const;  ///< the name of OpenGL's renderer, "" without a row of OpenGL
  /// The error of the look `fast` against `physical`, both by the reference; empty unless both have
  /// rows.
  std::optional<PictureError> fast_error() const;

 private:
  using Paint = std::function<void(const Target& target, Executor& executor)>;
  void add_rows(const std::string& label);
  void add(const std::string& name, JudgedLook* judged, int threads, Paint paint);
  void add_reference();
  void add_llvmpipe(const std::string& label, int threads);
  void add_fused(const std::string& name, const std::string& simd, JudgedLook& look, int threads);
  void judge(JudgedLook& look);
  void check(ChainRow& row);

  const Arguments& arguments_;
  MadePlate plate_;
  JudgedLook realistic_, physical_, fast_;
  RealisticNumbers numbers_;
  ScalarJob scalar_;
  std::array<std::unique_ptr<Executor>, 2> executors_;  ///< 1 thread, 2 threads
  std::vector<std::unique_ptr<GlProcess>> processes_;
  Picture canvas_;
  std::vector<ChainRow> rows_;
};

/// The pixels of 1080p or 4K.
Size size_of(const std::string& label);

/// A LlvmpipeChain on the plate of that size, which it loads before it returns.
std::unique_ptr<GlDrawing> llvmpipe_chain(const std::string& label);

}  // namespace limpid::bench
