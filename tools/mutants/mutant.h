#pragma once
#include <type_traits>

/// Included by each file that holds mutants (see sites.py). Each place of the code that can be
/// changed has a number, and the environment variable LIMPID_MUTANT holds the number of the place
/// that this process changes. `a < b` is written `a < Mark<7, false>() < b`: of the same
/// precedence, so that no operand has to be found in the text; the types of the operands select the
/// change.

namespace limpid_mutants {

/// The result of a recording run of the tests for a place.
enum Reached : unsigned char { kNever, kFirst, kSecond, kUnchangeable };

constexpr int kRecording = -2;
extern int active;               ///< the number to change, -1 for none, or kRecording
extern unsigned char reached[];  ///< a Reached for each number, filled while recording

#define LIMPID_MUTANT_INLINE inline __attribute__((always_inline))

LIMPID_MUTANT_INLINE bool is_active(int number, Reached change) {
  if (active == number) return true;
  if (active == kRecording) reached[number] = change;
  return false;
}

/// Constant: the place may be a part of a constant expression, which stays unchanged.
template <int Number, bool Constant>
LIMPID_MUTANT_INLINE constexpr bool on(Reached change = kFirst) {
  if constexpr (Constant) {
    if (std::is_constant_evaluated()) return false;
  }
  return is_active(Number, change);
}

template <int Number, bool Constant, class T>
LIMPID_MUTANT_INLINE constexpr T number(T is, T becomes) {
  return on<Number, Constant>() ? becomes : is;
}

template <int Number, bool Constant>
struct Mark {};

template <class A, int Number, bool Constant>
struct Left {
  const A& a;
};

template <class A, class B>
constexpr bool kWhole = std::conjunction_v<std::is_integral<A>, std::is_integral<B>>;

// FIRST is the change where USES_FIRST holds for the operands' types and it compiles, else SECOND
// where that compiles.
#define LIMPID_MUTANT_OPERATOR(SYMBOL, USES_FIRST, FIRST, SECOND)                        \
  template <class A, int N, bool C>                                                      \
  LIMPID_MUTANT_INLINE constexpr Left<A, N, C> operator SYMBOL(const A& a, Mark<N, C>) { \
    return {a};                                                                          \
  }                                                                                      \
  template <class A, int N, bool C, class B>                                             \
  LIMPID_MUTANT_INLINE constexpr auto operator SYMBOL(Left<A, N, C> left, const B& b) {  \
    const A& a = left.a;                                                                 \
    using R = decltype(a SYMBOL b);                                                      \
    if constexpr (USES_FIRST && requires { static_cast<R>(FIRST); }) {                   \
      return on<N, C>(kFirst) ? static_cast<R>(FIRST) : a SYMBOL b;                      \
    } else if constexpr (requires { static_cast<R>(SECOND); }) {                         \
      return on<N, C>(kSecond) ? static_cast<R>(SECOND) : a SYMBOL b;                    \
    } else {                                                                             \
      on<N, C>(kUnchangeable);                                                           \
      return a SYMBOL b;                                                                 \
    }                                                                                    \
  }

LIMPID_MUTANT_OPERATOR(<, (kWhole<A, B>), (a <= b), (a >= b))
LIMPID_MUTANT_OPERATOR(>, (kWhole<A, B>), (a >= b), (a <= b))
LIMPID_MUTANT_OPERATOR(<=, (kWhole<A, B>), (a < b), (a > b))
LIMPID_MUTANT_OPERATOR(>=, (kWhole<A, B>), (a > b), (a < b))
LIMPID_MUTANT_OPERATOR(==, true, (a != b), (a != b))
LIMPID_MUTANT_OPERATOR(!=, true, (a == b), (a == b))
LIMPID_MUTANT_OPERATOR(+, true, (a - b), (a - b))
LIMPID_MUTANT_OPERATOR(-, true, (a + b), (a + b))
LIMPID_MUTANT_OPERATOR(*, true, (a / b), ((a * b) + (a * b)))
LIMPID_MUTANT_OPERATOR(/, true, (a * b), (a * b))
LIMPID_MUTANT_OPERATOR(%, true, (a / b), (a / b))
#undef LIMPID_MUTANT_OPERATOR

// These operators associate from right to left.
template <class B, int Number, bool Constant>
struct Right {
  const B& b;
};

#define LIMPID_MUTANT_ASSIGNMENT(SYMBOL, CHANGED)                                         \
  template <int N, bool C, class B>                                                       \
  LIMPID_MUTANT_INLINE constexpr Right<B, N, C> operator SYMBOL(Mark<N, C>, const B& b) { \
    return {b};                                                                           \
  }                                                                                       \
  template <class A, class B, int N, bool C>                                              \
  LIMPID_MUTANT_INLINE constexpr A& operator SYMBOL(A& a, Right<B, N, C> right) {         \
    if constexpr (requires { a CHANGED right.b; }) {                                      \
      if (on<N, C>()) {                                                                   \
        a CHANGED right.b;                                                                \
        return a;                                                                         \
      }                                                                                   \
    } else {                                                                              \
      on<N, C>(kUnchangeable);                                                            \
    }                                                                                     \
    a SYMBOL right.b;                                                                     \
    return a;                                                                             \
  }

LIMPID_MUTANT_ASSIGNMENT(+=, -=)
LIMPID_MUTANT_ASSIGNMENT(-=, +=)
LIMPID_MUTANT_ASSIGNMENT(*=, /=)
LIMPID_MUTANT_ASSIGNMENT(/=, *=)
#undef LIMPID_MUTANT_ASSIGNMENT

/// `!x` and `-x`, written `Not<7, false>() ->* x`, which binds as tightly as the place needs.
template <int Number, bool Constant>
struct Not {
  template <class A>
  LIMPID_MUTANT_INLINE constexpr auto operator->*(const A& a) const {
    return on<Number, Constant>() ? decltype(!a)(a) : !a;
  }
};
template <int Number, bool Constant>
struct Negative {
  template <class A>
  LIMPID_MUTANT_INLINE constexpr auto operator->*(const A& a) const {
    return on<Number, Constant>() ? decltype(-a)(a) : -a;
  }
};

}  // namespace limpid_mutants
