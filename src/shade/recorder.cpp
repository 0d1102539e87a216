#include "shade/recorder.h"

#include <algorithm>
#include <bit>

#include "limpid/core/error.h"
#include "limpid/core/number.h"

namespace limpid {
namespace {

/// A single pointer fits into the static TLS block of any program, and is found without a call.
[[gnu::tls_model("initial-exec")]] thread_local Recorder* recorder = nullptr;

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

}  // namespace

Handle::Handle() : born_(Recorder::current().block()) {}
Handle::Handle(int node) : node_(node), born_(Recorder::current().block()) {}
Handle::Handle(const Handle& other) : Handle(other.node_) {}
Handle& Handle::operator=(const Handle& other) {
  Recorder::current().assign(*this, other.node_);
  return *this;
}

bool Recorder::Key::operator==(const Key& other) const {
  const Node &a = node, &b = other.node;
  return a.op == b.op && a.type == b.type && a.args == b.args && a.what == b.what &&
         bits_of(a.number) == bits_of(b.number);
}
std::size_t Recorder::Hash::operator()(const Key& key) const {
  const Node& n = key.node;
  std::size_t hash = static_cast<std::size_t>(n.op) * 31 + static_cast<std::size_t>(n.what);
  for (const int arg : n.args) hash = hash * 1000003 + static_cast<std::size_t>(arg + 1);
  return hash * 1000003 + static_cast<std::size_t>(bits_of(n.number) >> 20);
}

Recorder::Recorder(const NameTable& names) : names_(names) {
  if (recorder) throw Error("a recording is going on on this thread");
  recorder = this;
  made_.blocks.emplace_back();
  open_.push_back({0, -1, {}});
}
Recorder::~Recorder() { recorder = nullptr; }

Recorder& Recorder::current() {
  if (!recorder) throw Error("symbols are numbers of a recording, and none is going on");
  return *recorder;
}

int Recorder::literal(double value) {
  return keep({NodeOp::kLiteral, NodeType::kNumber, {-1, -1, -1}, value});
}
int Recorder::mask(bool value) {
  return keep({NodeOp::kLiteral, NodeType::kMask, {-1, -1, -1}, value ? 1.0 : 0.0});
}

int Recorder::given(double value, const void* address) {
  const std::string* name = names_.name_of(address);
  if (!name) throw Error("a number of the frame lies where no name is known: given() needs one");
  return given(value, name->c_str(), -1);
}

int Recorder::given(double value, const char* name, int place) {
  std::string full = name;
  if (place >= 0) full += "[" + std::to_string(place) + "]";
  const auto [at, fresh] = given_.try_emplace(full, static_cast<int>(made_.given.size()));
  if (fresh) made_.given.push_back({full, value});
  const double known = made_.given[static_cast<std::size_t>(at->second)].value;
  if (bits_of(known) != bits_of(value) && known != value) {
    throw Error("the name " + full + " stands for two numbers of the frame");
  }
  return keep({NodeOp::kGiven, NodeType::kNumber, {-1, -1, -1}, 0, at->second});
}

bool Recorder::is_open(int block) const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](const OpenBlock& open) { return open.block == block; });
}

bool Recorder::holds(int mask) const {
  const auto implies = [&](int condition, auto&& self) -> bool {
    if (condition < 0) return false;
    if (condition == mask) return true;
    const Node& node = node_of(condition);
    return node.op == NodeOp::kAnd && (self(node.args[0], self) || self(node.args[1], self));
  };
  return std::any_of(open_.begin(), open_.end(),
                     [&](const OpenBlock& open) { return implies(open.condition, implies); });
}

int Recorder::fresh(const Node& node) {
  made_.nodes.push_back(node);
  made_.nodes.back().block = block();
  return static_cast<int>(made_.nodes.size()) - 1;
}

void Recorder::state(Statement::Kind kind, int what) {
  made_.blocks[static_cast<std::size_t>(block())].statements.push_back({kind, what});
}

int Recorder::keep(Node node) {
  const bool anywhere = node.op == NodeOp::kLiteral || node.op == NodeOp::kGiven;
  std::vector<int>& known = known_[{node}];
  for (const int id : known) {
    if (anywhere || is_open(node_of(id).block)) return id;
  }
  const int id = fresh(node);
  known.push_back(id);
  if (!anywhere) state(Statement::Kind::kNode, id);
  return id;
}

int Recorder::add(NodeOp op, NodeType type, std::array<int, 3> args, int what, double number) {
  const int folded = fold(op, args);
  if (folded >= 0) return folded;
  // A select of a known mask is folded above.
  if (is_arithmetic(op) && op != NodeOp::kSelect) {
    const auto known = [&](int arg) { return arg < 0 || is_known(arg); };
    const auto value = [&](int arg) { return arg < 0 ? 0.0 : node_of(arg).number; };
    if (known(args[0]) && known(args[1])) {
      const double made = computed(op, value(args[0]), value(args[1]), 0);
      return type == NodeType::kMask ? mask(made != 0) : literal(made);
    }
  }
  return keep({op, type, args, number, what});
}

/// An existing node equal to this operation, or -1. Operations on values that could be infinite or
/// NaN stay: 0 x is not folded.
int Recorder::fold(NodeOp op, const std::array<int, 3>& args) const {
  const auto [a, b, c] = args;
  const auto is = [&](int node, double value) {
    return is_known(node) && node_of(node).number == value;
  };
  switch (op) {
    case NodeOp::kAdd:
      return is(a, 0) ? b : is(b, 0) ? a : -1;
    case NodeOp::kSubtract:
      return is(b, 0) ? a : -1;
    case NodeOp::kMultiply:
      return is(a, 1) ? b : is(b, 1) ? a : -1;
    case NodeOp::kDivide:
      return is(b, 1) ? a : -1;
    case NodeOp::kAnd:
      if (is_known(a)) return may_hold(a) ? b : a;
      if (is_known(b)) return may_hold(b) ? a : b;
      return a == b || holds(b) ? a : holds(a) ? b : -1;
    case NodeOp::kOr:
      if (is_known(a)) return may_hold(a) ? a : b;
      if (is_known(b)) return may_hold(b) ? b : a;
      return a == b ? a : -1;
    case NodeOp::kNot:
      return node_of(a).op == NodeOp::kNot ? node_of(a).args[0] : -1;
    case NodeOp::kSelect:
      if (is_known(a)) return may_hold(a) ? b : c;
      return b == c || holds(a) ? b : -1;
    default:
      return -1;
  }
}

void Recorder::title(std::string name) {
  made_.titles.push_back(std::move(name));
  state(Statement::Kind::kTitle, static_cast<int>(made_.titles.size()) - 1);
}

void Recorder::assign(Handle& to, int node) {
  if (to.born_ != block()) {
    if (is_open(to.born_)) {
      std::vector<Carried>& assigned = open_.back().assigned;
      const bool there = std::any_of(assigned.begin(), assigned.end(),
                                     [&](const Carried& c) { return c.handle == &to; });
      if (!there) assigned.push_back({&to, to.node_});
    } else {
      to.born_ = block();
    }
  }
  to.node_ = node;
}

int Recorder::open(int condition) {
  const int inner = static_cast<int>(made_.blocks.size());
  made_.blocks.push_back({block(), {}});
  open_.push_back({inner, condition, {}});
  return inner;
}

void Recorder::close_if(int condition, int inner) {
  const std::vector<Carried> assigned = std::move(open_.back().assigned);
  open_.pop_back();
  Flow flow;
  flow.block = inner;
  flow.condition = condition;
  for (const auto& [handle, before] : assigned) {
    const int after = handle->node_;
    handle->node_ = before;
    if (after == before) continue;
    const int merged = fresh({NodeOp::kMerged, node_of(after).type});
    flow.merges.push_back({merged, before, after});
    assign(*handle, merged);
  }
  made_.flows.push_back(std::move(flow));
  state(Statement::Kind::kFlow, static_cast<int>(made_.flows.size()) - 1);
}

Flow Recorder::begin_loop(int begin, int end, std::vector<Carried>& carried) {
  Flow flow;
  flow.loops = true;
  flow.begin = begin, flow.end = end;
  for (const auto& [handle, before] : carried) {
    const NodeType type = before < 0 ? NodeType::kNumber : node_of(before).type;
    const int merged = fresh({NodeOp::kMerged, type});
    flow.merges.push_back({merged, before, merged});
    handle->node_ = merged;
  }
  flow.block = open(-1);
  flow.index = fresh({NodeOp::kIndex, NodeType::kNumber});
  return flow;
}

bool Recorder::end_loop(Flow& flow, int condition, std::vector<Carried>& carried) {
  const std::vector<Carried> assigned = std::move(open_.back().assigned);
  open_.pop_back();
  const std::size_t were = carried.size();
  for (const auto& [handle, before] : assigned) {
    std::size_t k = 0;
    while (k < were && carried[k].handle != handle) ++k;
    if (k < were) {
      flow.merges[k].after = handle->node_;
    } else {
      carried.push_back({handle, before});
    }
  }
  if (carried.size() > were) {  // run the body again, with these as carried values, too
    for (const auto& [handle, before] : carried) handle->node_ = before;
    return false;
  }
  flow.condition = condition;
  for (std::size_t k = 0; k < were; ++k) {
    carried[k].handle->node_ = carried[k].before;
    assign(*carried[k].handle, flow.merges[k].merged);
  }
  made_.flows.push_back(std::move(flow));
  state(Statement::Kind::kFlow, static_cast<int>(made_.flows.size()) - 1);
  return true;
}

Recording Recorder::take() {
  // Nodes that outputs need, directly or through other nodes.
  std::vector<bool> live(made_.nodes.size());
  std::vector<int> to_do;
  const auto need = [&](int node) {
    if (node < 0 || live[static_cast<std::size_t>(node)]) return;
    live[static_cast<std::size_t>(node)] = true;
    to_do.push_back(node);
  };
  std::unordered_map<int, std::pair<const Flow*, const Flow::Merge*>> merges;
  for (const Flow& flow : made_.flows) {
    for (const Flow::Merge& merge : flow.merges) merges[merge.merged] = {&flow, &merge};
  }
  for (const Output& output : made_.outputs) need(output.node);
  while (!to_do.empty()) {
    const Node& node = node_of(to_do.back());
    const int id = to_do.back();
    to_do.pop_back();
    for (const int arg : node.args) need(arg);
    if (node.op != NodeOp::kMerged) continue;
    const auto [flow, merge] = merges.at(id);
    need(merge->before), need(merge->after), need(flow->condition);
  }
  made_.live = std::move(live);
  // Numbers that no live node reads are left out of the shader.
  std::vector<int> place(made_.given.size(), -1);
  std::vector<GivenNumber> given;
  for (std::size_t i = 0; i < made_.nodes.size(); ++i) {
    Node& node = made_.nodes[i];
    if (node.op != NodeOp::kGiven || !made_.live[i]) continue;
    int& to = place[static_cast<std::size_t>(node.what)];
    if (to < 0) {
      to = static_cast<int>(given.size());
      given.push_back(made_.given[static_cast<std::size_t>(node.what)]);
    }
    node.what = to;
  }
  made_.given = std::move(given);
  return std::move(made_);
}

}  // namespace limpid
