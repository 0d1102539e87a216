#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "limpid/plan/plan.h"
#include "limpid/shade/shader_text.h"

#include "op/pass.h"

namespace limpid {

/// Of which textures a shader reads four texels at once (textureGather, which not all languages
/// know): made ones, or all, whose images are as large as their windows then.
enum class Gathered { kNothing, kMade, kAll };

/// A texture of a program, and where its values come from; ShaderTexture::texels is empty.
struct ProgramTexture : ShaderTexture {
  /// Writes row y, 0 ... height - 1: `width` texels of `step` floats each, of which the first
  /// `channels` are written; the others stay as they are or become 0.
  std::function<void(int y, float* row, int step)> fill;
  /// Or, of a usampler2D, which gathered ones may be: `width` texels of 32 bits.
  std::function<void(int y, std::uint32_t* row)> pack;
};

/// A shader, and the values of the frame that it was recorded for.
struct ShaderProgram {
  std::string text, id;
  int block_binding = 0;
  std::vector<std::byte> block;
  std::vector<ShaderNumber> numbers;
  std::vector<ProgramTexture> textures;
  std::vector<ShaderOutput> outputs;
  Rect work;
  Size group;  ///< ShaderText::group()
};

/// Records the plan. `frame` is what completers made of `plate`, `pass` is of that. All of them are
/// to live as long as textures are filled. Throws Error as ShaderText.
ShaderProgram program_of(const Plan& plan, const Frame& plate, const Frame& frame, const Pass& pass,
                         const ShaderOptions& options, Gathered gathered = Gathered::kNothing);

}  // namespace limpid
