#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "shade/name_table.h"
#include "shade/recording.h"

namespace limpid {

class Symbol;
class SymbolMask;

/// The value of a Symbol during recording: a node, and the block in which this C++ object was
/// created. Assigning to an object of an outer block is recorded as a result of the block.
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

/// Records the operations on Symbols on this thread. Equal nodes are merged, constants are folded,
/// and nodes that no output needs are left out.
class Recorder {
 public:
  explicit Recorder(const NameTable& names);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  /// The recorder of this thread; there must be one.
  static Recorder& current();

  int literal(double value);
  int mask(bool value);
  /// A number of the frame, by its address. Throws Error if the address has no name.
  int given(double value, const void* address);
  /// A number by its name, and its index in a list. Throws Error if the name already has another
  /// value.
  int given(double value, const char* name, int place);
  int add(NodeOp op, NodeType type, std::array<int, 3> args, int what = 0, double number = 0);
  int part(int vector, int k) { return add(NodeOp::kPart, NodeType::kNumber, {vector, -1, -1}, k); }

  bool is_known(int node) const { return node_of(node).op == NodeOp::kLiteral; }
  /// Whether a mask may hold: false only if it is known not to hold.
  bool may_hold(int node) const { return !is_known(node) || node_of(node).number != 0; }

  /// Names the operator of the following nodes.
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

  /// body(index node) -> node of the mask of pixels that continue, or -1. The body runs again until
  /// no more numbers are found that it carries from one iteration to the next.
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
  /// Returns the recording, and ends it.
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
    int condition;  ///< the mask that holds in it, or -1
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
