#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "files/gltf/gltf_buffers.h"
#include "files/gltf/memory_budget.h"
#include "files/text/json_place.h"

namespace limpid {

/// The elements of an accessor: a view into their buffer, or a copy with the sparse values.
class GltfElements {
 public:
  std::size_t count() const { return count_; }
  int components() const { return components_; }  ///< of an element
  /// Requires an accessor of unsigned integers.
  std::uint32_t integer(std::size_t element, int component) const;
  /// Normalized integers are numbers of -1 ... 1 or 0 ... 1 (glTF 2.0, 3.11 "Animations": c / 127,
  /// at least -1), other integers keep their value.
  float number(std::size_t element, int component) const;
  glm::vec3 vector(std::size_t element) const;
  glm::dmat4 matrix(std::size_t element) const;

 private:
  friend class GltfAccessors;

  template <class T>
  T raw(std::size_t element, int component) const;

  std::unique_ptr<char[]> copy_;
  const char* first_ = nullptr;
  std::size_t stride_ = 0, count_ = 0;
  int component_ = 0, components_ = 1;
  bool normalized_ = false;
};

/// The accessors of a checked document.
class GltfAccessors {
 public:
  GltfAccessors(const JsonPlace& root, const GltfBuffers& buffers, MemoryBudget& budget);

  /// Throws Error for sparse indices that do not rise or lie beyond the count, and for packed
  /// bytes.
  GltfElements of(int index) const;
  std::size_t count(int index) const { return accessors_.at(index).count; }

 private:
  struct Part {
    int view = -1;
    std::size_t offset = 0;
  };
  struct Accessor {
    Part base;
    std::size_t stride, element, count;  // bytes, bytes
    int component;
    bool normalized;
    std::size_t sparse = 0;  // number of sparse values
    Part indices, values;
    int index_component = 0;
  };

  static Part part_of(const JsonPlace& place);
  const char* bytes(const Part& part) const;
  void put_sparse(const Accessor& accessor, int index, char* copy) const;

  const GltfBuffers& buffers_;
  MemoryBudget& budget_;
  std::vector<Accessor> accessors_;
};

}  // namespace limpid
