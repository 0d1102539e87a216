#pragma once
#include <cstdint>
#include <initializer_list>

namespace limpid {

/// A set of values of an enum class that counts from 0, at most 32 of them.
template <class E>
class EnumSet {
 public:
  constexpr EnumSet() = default;
  constexpr EnumSet(std::initializer_list<E> values) {
    for (E v : values) bits_ |= 1u << static_cast<int>(v);
  }
  constexpr bool has(E v) const { return (bits_ >> static_cast<int>(v)) & 1u; }
  constexpr bool covers(EnumSet s) const { return (s.bits_ & ~bits_) == 0; }
  constexpr bool meets(EnumSet s) const { return (s.bits_ & bits_) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  friend constexpr EnumSet operator|(EnumSet a, EnumSet b) { return from(a.bits_ | b.bits_); }
  friend constexpr EnumSet operator&(EnumSet a, EnumSet b) { return from(a.bits_ & b.bits_); }
  friend constexpr EnumSet operator-(EnumSet a, EnumSet b) { return from(a.bits_ & ~b.bits_); }
  friend constexpr bool operator==(EnumSet, EnumSet) = default;

 private:
  static constexpr EnumSet from(std::uint32_t bits) {
    EnumSet s;
    s.bits_ = bits;
    return s;
  }
  std::uint32_t bits_ = 0;
};

}  // namespace limpid
