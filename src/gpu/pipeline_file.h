#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace limpid {

/// What a start with the same look, device and driver need not compile again.
struct CompiledPipeline {
  std::vector<std::uint32_t> spirv;
  std::vector<std::byte> device_code;  ///< VkPipelineCache's data
};

/// None where the file is not there, or not as it was written: a driver trusts what it is given.
std::optional<CompiledPipeline> read_pipeline(const std::filesystem::path& path);

/// Makes the folder, too. Throws Error where that or the file cannot be written.
void write_pipeline(const std::filesystem::path& path, const CompiledPipeline& compiled);

}  // namespace limpid
