#pragma once
#include <string>
#include <unordered_map>

#include "limpid/plan/plan.h"

#include "op/pass.h"

namespace limpid {

/// Where the numbers of a frame lie, and what they are called: parameters of the look by their
/// operator ("refraction.strength"), what camera and water say ("camera.eye_above"), and what was
/// made for the frame ("continuation.offset"). Refers to what it was made of.
class NameTable {
 public:
  NameTable(const Plan& plan, const Pass& pass);
  /// Of the number that begins at this address; null for none.
  const std::string* name_of(const void* address) const;

 private:
  template <class T>
  void add(const std::string& name, const T& number) {
    names_.emplace(&number, name);
  }
  void add_three(const std::string& name, const glm::dvec3& vector);
  void add_rays(const std::string& name, const Rays& rays);
  void add_bounds(const std::string& name, const Bounds& bounds);
  void add_view(const Pass& pass);
  void add_made(const Pass& pass);
  void add_look(const Look& look);

  std::unordered_map<const void*, std::string> names_;
};

}  // namespace limpid
