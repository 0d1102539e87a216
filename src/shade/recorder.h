#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "shade/name_table.h"
#include "shade/recording.h"

namespace limpid {

class Symbol;
class SymbolMask;

/// What formulas hold while they are recorded: a node, and the block in which this C++ object came
/// to be. An assignment to an object from an outer block is one that its block leaves behind.
class Handle {
 public:
  Handle();
  explicit Handle(int node);
  Handle(const Handle& other);
  Handle& operator=(const Handle& other);
  int node() const { return node_; }

 private:
  friend class Recorder;
  int node_ = -1;
  int born_;
};

/// Writes down what formulas do with Symbols on this thread, from the first node on. Equal nodes
/// are one, numbers that are known are reckoned with, and what no output needs is left out.
class Recorder {
 public:
  explicit Recorder(const NameTable& names);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  /// Of this thread; there must be one.
  static Recorder& current();

  int literal(double value);
  int mask(bool value);
  /// A number of the frame, by the address at which it lies. Throws Error where no name is known.
  int given(double value, const void* home);
  /// One by its name, with a place for one of a list. Throws Error for a name that stands for
  /// another value already.
  int given(double value, const char* name, int place);
  int add(NodeOp op, NodeType type, std::array<int, 3> args, int what = 0, double number = 0);
  int part(int vector, int k) { return add(NodeOp::kPart, NodeType::kNumber, {vector, -1, -1}, k); }

  bool is_known(int node) const { return node_of(node).op == NodeOp::kLiteral; }
  /// Whether a mask may hold: false only where that is known.
  bool may_hold(int node) const { return !is_known(node) || node_of(node).number != 0; }

  /// What follows belongs to this operator.
  void title(std::string name);

  template <class Body>
  void if_any(int condition, Body&& body) {
    if (is_known(condition)) {
      if (may_hold(condition)) body();
      return;
    }
    if (holds(condition)) return body();
    const int inner = open(condition);
    body();
    close_if(condition, inner);
  }

  /// body(node of the index) -> node of the mask of those that go on, or -1. The body runs until no
  /// more numbers are found that it carries from one turn to the next.
  template <class Body>
  void loop(int begin, int end, Body&& body) {
    if (begin >= end) return;
    std::vector<Carried> carried;
    for (;;) {
      Flow flow = begin_loop(begin, end, carried);
      const int condition = body(flow.index);
      if (end_loop(flow, condition, carried)) return;
    }
  }

  void output(std::string name, int node) { made_.outputs.push_back({std::move(name), node}); }
  /// What was recorded. Ends the recording.
  Recording take();

 private:
  friend class Handle;
  /// A C++ object that a block has changed, and its node before.
  struct Carried {
    Handle* handle;
    int before;
  };
  struct OpenBlock {
    int block;
    int condition;  ///< that holds in it, or -1
    std::vector<Carried> assigned;
  };
  struct Key {
    Node node;
    bool operator==(const Key& other) const;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  const Node& node_of(int node) const { return made_.nodes[static_cast<std::size_t>(node)]; }
  int block() const { return open_.back().block; }
  bool is_open(int block) const;
  /// Whether a mask is known to hold in the open blocks.
  bool holds(int mask) const;
  int fold(NodeOp op, const std::array<int, 3>& args) const;
  int fresh(const Node& node);
  int keep(Node node);
  void state(Statement::Kind kind, int what);
  int open(int condition);
  void close_if(int condition, int inner);
  Flow begin_loop(int begin, int end, std::vector<Carried>& carried);
  bool end_loop(Flow& flow, int condition, std::vector<Carried>& carried);
  void assign(Handle& to, int node);

  const NameTable& names_;
  Recording made_;
  std::vector<OpenBlock> open_;
  std::unordered_map<Key, std::vector<int>, Hash> known_;
  std::unordered_map<std::string, int> given_;
};

}  // namespace limpid
