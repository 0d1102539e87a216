#pragma once
#include <vector>

#include "op/pass.h"
#include "shade/recording.h"

namespace limpid {

/// Runs a recording in double, pixel by pixel, with the lookups of run_reference(), to check that
/// the recording computes what the operators compute. Slow.
class Interpreter {
 public:
  /// `frame` is completed, `pass` belongs to it; they and the recording must live as long.
  Interpreter(const Recording& recording, const Pass& pass, const Frame& frame);
  /// The outputs of the pixel (x, y) of Frame::work(), in their order, valid until the next call.
  const std::vector<double>& run(int x, int y);

 private:
  struct Value {
    double of[4];
  };
  struct At;
  void run_block(int block, const At& at);
  void run_flow(const Flow& flow, const At& at);
  void run_node(int node, const At& at);
  const Value& value(int node) const { return values_[static_cast<std::size_t>(node)]; }

  const Recording& recording_;
  const Pass& pass_;
  const Frame& frame_;
  std::vector<Value> values_;
  std::vector<bool> live_flows_;
  std::vector<double> outputs_;
};

}  // namespace limpid
