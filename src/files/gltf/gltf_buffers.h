#pragma once
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/gltf/gltf_files.h"
#include "files/gltf/memory_budget.h"

namespace limpid {

/// The bytes of a document's buffers. Must not outlive its file.
class GltfBuffers {
 public:
  /// Reads the buffers of a checked document. Throws Error for a buffer whose file is missing, too
  /// short or outside of `folder`, and for invalid base64.
  GltfBuffers(const GltfFile& file, const std::filesystem::path& folder, MemoryBudget& budget);
  GltfBuffers(const GltfBuffers&) = delete;
  GltfBuffers& operator=(const GltfBuffers&) = delete;

  /// The bytes of a buffer view; throws Error for a packed buffer.
  std::string_view view(int index) const;

 private:
  struct View {
    int buffer;
    std::size_t offset, length;
  };

  std::deque<std::string> owned_;          // from files and data uris
  std::vector<std::string_view> buffers_;  // a packed buffer is empty
  std::vector<View> views_;
};

}  // namespace limpid
