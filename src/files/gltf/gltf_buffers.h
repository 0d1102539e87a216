#pragma once
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/gltf/gltf_files.h"
#include "files/gltf/memory_budget.h"

namespace limpid {

/// The bytes of a document's buffers. It lives no longer than its file.
class GltfBuffers {
 public:
  /// Reads the buffers of a checked document. Throws Error for one whose file is missing, too short
  /// or outside of `folder`, and for what is not base64.
  GltfBuffers(const GltfFile& file, const std::filesystem::path& folder, MemoryBudget& budget);
  GltfBuffers(const GltfBuffers&) = delete;
  GltfBuffers& operator=(const GltfBuffers&) = delete;

  /// Those of a buffer view; throws Error for one of a packed buffer.
  std::string_view view(int index) const;

 private:
  struct View {
    int buffer;
    std::size_t offset, length;
  };

  std::deque<std::string> owned_;          // of files and data uris
  std::vector<std::string_view> buffers_;  // a packed one is empty
  std::vector<View> views_;
};

}  // namespace limpid
