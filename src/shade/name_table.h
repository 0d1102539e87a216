#pragma once
#include <string>
#include <unordered_map>

#include "limpid/plan/plan.h"

#include "op/pass.h"

namespace limpid {

/// The names of a frame's numbers by their addresses: parameters of the look by operator
/// ("refraction.strength"), numbers of camera and water ("camera.eye_above"), and numbers made for
/// the frame ("continuation.offset"). Refers to its inputs.
class NameTable {
 public:
  NameTable(const Plan& plan, const Pass& pass);
  /// The name of the number at this address; null for none.
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
