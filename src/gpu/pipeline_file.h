#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace limpid {

/// Compiled code that a start with the same look, device and driver can reuse.
struct CompiledPipeline {
  std::vector<std::uint32_t> spirv;
  std::vector<std::byte> device_code;  ///< VkPipelineCache's data
};

/// None if the file does not exist, or has changed: drivers do not check their input.
std::optional<CompiledPipeline> read_pipeline(const std::filesystem::path& path);

/// Makes the folder, too. Throws Error if the folder or the file cannot be written.
void write_pipeline(const std::filesystem::path& path, const CompiledPipeline& compiled);

}  // namespace limpid
