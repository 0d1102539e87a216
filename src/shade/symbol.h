#pragma once
#include <limits>

#include "limpid/core/number.h"

#include "shade/recorder.h"

/// @file
/// A number that records: the Recorder of the thread records the operations of operators that run
/// on Symbols (core/number.h has these operations).

namespace limpid {

class SymbolMask : public Handle {
 public:
  SymbolMask() = default;
  explicit SymbolMask(bool value) : Handle(Recorder::current().mask(value)) {}
  static SymbolMask of(int node) { return SymbolMask(Node{}, node); }
  friend SymbolMask operator&&(const SymbolMask& a, const SymbolMask& b) {
    return made(NodeOp::kAnd, a.node(), b.node());
  }
  friend SymbolMask operator||(const SymbolMask& a, const SymbolMask& b) {
    return made(NodeOp::kOr, a.node(), b.node());
  }
  friend SymbolMask operator!(const SymbolMask& a) { return made(NodeOp::kNot, a.node()); }
  static SymbolMask made(NodeOp op, int a, int b = -1) {
    return of(Recorder::current().add(op, NodeType::kMask, {a, b, -1}));
  }

 private:
  struct Node {};
  SymbolMask(Node, int node) : Handle(node) {}
};

class Symbol : public Handle {
 public:
  Symbol() = default;
  explicit Symbol(double constant) : Handle(Recorder::current().literal(constant)) {}
  static Symbol of(int node) { return Symbol(Node{}, node); }

  friend Symbol operator+(const Symbol& a, const Symbol& b) { return made(NodeOp::kAdd, a, b); }
  friend Symbol operator-(const Symbol& a, const Symbol& b) {
    return made(NodeOp::kSubtract, a, b);
  }
  friend Symbol operator*(const Symbol& a, const Symbol& b) {
    return made(NodeOp::kMultiply, a, b);
  }
  friend Symbol operator/(const Symbol& a, const Symbol& b) { return made(NodeOp::kDivide, a, b); }
  friend SymbolMask operator<(const Symbol& a, const Symbol& b) {
    return SymbolMask::made(NodeOp::kLess, a.node(), b.node());
  }
  friend SymbolMask operator>(const Symbol& a, const Symbol& b) {
    return SymbolMask::made(NodeOp::kGreater, a.node(), b.node());
  }
  friend SymbolMask operator<=(const Symbol& a, const Symbol& b) {
    return SymbolMask::made(NodeOp::kLessOrEqual, a.node(), b.node());
  }
  friend SymbolMask operator>=(const Symbol& a, const Symbol& b) {
    return SymbolMask::made(NodeOp::kGreaterOrEqual, a.node(), b.node());
  }
  static Symbol made(NodeOp op, const Symbol& a) {
    return of(Recorder::current().add(op, NodeType::kNumber, {a.node(), -1, -1}));
  }
  static Symbol made(NodeOp op, const Symbol& a, const Symbol& b) {
    return of(Recorder::current().add(op, NodeType::kNumber, {a.node(), b.node(), -1}));
  }

 private:
  struct Node {};
  Symbol(Node, int node) : Handle(node) {}
};

inline Symbol select(const SymbolMask& condition, const Symbol& yes, const Symbol& no) {
  const std::array<int, 3> args{condition.node(), yes.node(), no.node()};
  return Symbol::of(Recorder::current().add(NodeOp::kSelect, NodeType::kNumber, args));
}
inline Symbol min(const Symbol& a, const Symbol& b) { return Symbol::made(NodeOp::kMin, a, b); }
inline Symbol max(const Symbol& a, const Symbol& b) { return Symbol::made(NodeOp::kMax, a, b); }
inline Symbol abs(const Symbol& x) { return Symbol::made(NodeOp::kAbs, x); }
inline Symbol sqrt(const Symbol& x) { return Symbol::made(NodeOp::kSqrt, x); }
inline Symbol floor(const Symbol& x) { return Symbol::made(NodeOp::kFloor, x); }
inline Symbol exp(const Symbol& x) { return Symbol::made(NodeOp::kExp, x); }
inline Symbol sin(const Symbol& x) { return Symbol::made(NodeOp::kSin, x); }
inline Symbol cos(const Symbol& x) { return Symbol::made(NodeOp::kCos, x); }
inline Symbol atan2(const Symbol& y, const Symbol& x) { return Symbol::made(NodeOp::kAtan2, y, x); }
inline Symbol pow(const Symbol& x, const Symbol& p) { return Symbol::made(NodeOp::kPow, x, p); }
/// A constant exponent is part of the formula, as it is for lanes.
inline Symbol pow(const Symbol& x, double p) { return pow(x, Symbol(p)); }

/// For a recorded pixel: false only if it is certain. Work that operators skip then has no effect.
inline bool any(const SymbolMask& mask) { return Recorder::current().may_hold(mask.node()); }
/// Not known when recording: no comparison holds.
inline double least(const Symbol&) { return std::numeric_limits<double>::quiet_NaN(); }
inline double greatest(const Symbol&) { return std::numeric_limits<double>::quiet_NaN(); }

template <class Body>
[[gnu::visibility("hidden")]] void if_any(const SymbolMask& mask, Body&& body) {
  Recorder::current().if_any(mask.node(), body);
}

template <>
struct Loop<Symbol> {
  struct Index {
    Symbol value;
    friend Index operator-(int n, const Index& i) { return {Symbol(double(n)) - i.value}; }
  };
  template <class Body>
  static void repeat(int count, Body&& body) {
    if (count == 1) return body();
    Recorder::current().loop(0, count, [&](int) {
      body();
      return -1;
    });
  }
  /// No step is skipped: whether a lookup is needed is not known when recording.
  template <class Leap, class Body>
  static void steps(int begin, int end, Leap&&, Body&& body) {
    if (end - begin == 1) return void(body(Index{Symbol(double(begin))}));
    Recorder::current().loop(begin, end,
                             [&](int index) { return body(Index{Symbol::of(index)}).node(); });
  }
  template <class Body>
  static void each(int count, Body&& body) {
    Recorder::current().loop(0, count, [&](int index) {
      body(Index{Symbol::of(index)});
      return -1;
    });
  }
  static SymbolMask is(const Index& i, int k) {
    return i.value > Symbol(k - 0.5) && i.value < Symbol(k + 0.5);
  }
  template <class Body>
  static void only(const Index& i, int k, Body&& body) {
    Recorder::current().if_any(is(i, k).node(), body);
  }
  static Symbol pick(const Index& i, const Symbol& first, const Symbol& second,
                     const Symbol& third) {
    return select(i.value < Symbol(0.5), first, select(i.value < Symbol(1.5), second, third));
  }
  static Symbol ratio(const Index& i, int n) { return i.value / Symbol(double(n)); }
  static Symbol ratio(int i, int n) { return Symbol(double(i) / n); }
};

template <>
struct Given<Symbol> {
  static Symbol known(double x, const void* address) {
    return Symbol::of(Recorder::current().given(x, address));
  }
  static Symbol named(double x, const char* name, int place) {
    return Symbol::of(Recorder::current().given(x, name, place));
  }
};

}  // namespace limpid
