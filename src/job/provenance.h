#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/scene.h"
#include "limpid/job/output.h"
#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"
#include "limpid/raster/model.h"
#include "limpid/raster/render_plate.h"

#include "job/shared_textures.h"

/// How an output was made, as attributes "limpid/..." (job/output.h lists them). Independent of
/// folders, date, host and threads.

namespace limpid {

using Record = std::map<std::string, std::string>;

/// Version, scene, inputs, options, and the hash of scene and inputs.
Record record_of(const Scene& scene, const std::string& inputs, const std::string& options);
/// The look as requested.
void add_look(Record& record, const Look& look);
/// And the look as planned.
void add_look(Record& record, const Look& look, const Plan& plan);

/// A model and its representation in a record: the hash of all its drawn parts.
struct HashedModel {
  explicit HashedModel(const Model& named);
  const Model* model;
  std::string hash;
};

/// Parts of `inputs`: a few lines of TOML each.
std::string model_inputs(const HashedModel& model, Size size);
std::string model_inputs(const HashedModel& model, const RenderOptions& options);
std::string texture_inputs(const TextureFiles& files, SharedTextures& textures);

/// A line of TOML; `value` is used verbatim.
std::string line(std::string_view key, const std::string& value);
/// `aovs = ["path", "visible"]`.
std::string aovs_line(const std::vector<Aov>& aovs, bool visible = false);

/// Parts of `options`.
std::string display_options(const DisplayChoice& display);
std::string picture_options(const OutputChoice& choice, const std::string& gpu);
std::string raster_options(const std::string& simd);
std::string file_options(const std::string& compression, bool store_float);

}  // namespace limpid
