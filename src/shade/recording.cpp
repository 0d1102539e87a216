#include "shade/recording.h"

#include <cmath>

#include "limpid/core/error.h"
#include "limpid/core/number.h"

namespace limpid {

double computed(NodeOp op, double a, double b, double c) {
  switch (op) {
    case NodeOp::kAdd:
      return a + b;
    case NodeOp::kSubtract:
      return a - b;
    case NodeOp::kMultiply:
      return a * b;
    case NodeOp::kDivide:
      return a / b;
    case NodeOp::kLess:
      return a < b;
    case NodeOp::kGreater:
      return a > b;
    case NodeOp::kLessOrEqual:
      return a <= b;
    case NodeOp::kGreaterOrEqual:
      return a >= b;
    case NodeOp::kAnd:
      return a != 0 && b != 0;
    case NodeOp::kOr:
      return a != 0 || b != 0;
    case NodeOp::kNot:
      return a == 0;
    case NodeOp::kSelect:
      return a != 0 ? b : c;
    case NodeOp::kMin:
      return min(a, b);
    case NodeOp::kMax:
      return max(a, b);
    case NodeOp::kAbs:
      return std::fabs(a);
    case NodeOp::kSqrt:
      return std::sqrt(a);
    case NodeOp::kFloor:
      return std::floor(a);
    case NodeOp::kExp:
      return std::exp(a);
    case NodeOp::kSin:
      return std::sin(a);
    case NodeOp::kCos:
      return std::cos(a);
    case NodeOp::kAtan2:
      return std::atan2(a, b);
    case NodeOp::kPow:
      return std::pow(a, b);
    default:
      throw Error("no arithmetic makes this node");
  }
}

PlaneSet Recording::planes() const {
  PlaneSet set;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    const PlaneId plane = static_cast<PlaneId>(node.what);
    switch (node.op) {
      case NodeOp::kBilinear3:
        if (live[i]) set = set | PlaneSet{plane_after(plane, 1), plane_after(plane, 2)};
        [[fallthrough]];
      case NodeOp::kOwn:
      case NodeOp::kBeside:
      case NodeOp::kNearest:
      case NodeOp::kBilinear:
      case NodeOp::kRead:
      case NodeOp::kPlace:
        if (live[i]) set = set | PlaneSet{plane};
        break;
      default:
        break;
    }
  }
  return set;
}

std::vector<std::optional<double>> values_of_frame(const Recording& r) {
  std::vector<std::optional<double>> values(r.nodes.size());
  for (std::size_t i = 0; i < r.nodes.size(); ++i) {
    const Node& node = r.nodes[i];
    if (node.op == NodeOp::kLiteral) values[i] = node.number;
    if (node.op == NodeOp::kGiven && r.live[i]) {
      values[i] = r.given[static_cast<std::size_t>(node.what)].value;
    }
    if (!is_arithmetic(node.op) || !r.live[i]) continue;
    double args[3] = {0, 0, 0};
    bool known = true;
    for (std::size_t k = 0; k < 3 && node.args[k] >= 0; ++k) {
      const std::optional<double>& value = values[static_cast<std::size_t>(node.args[k])];
      known = known && value;
      args[k] = value.value_or(0);
    }
    if (known) values[i] = computed(node.op, args[0], args[1], args[2]);
  }
  return values;
}

}  // namespace limpid
