#pragma once
#include <string>
#include <vector>

#include "limpid/job/missing.h"
#include "limpid/job/resume.h"
#include "limpid/raster/model.h"

#include "arguments.h"

/// Messages on stderr that are no errors.

namespace limpid::tool {

/// Names come from files: control characters must not reach the terminal, nor split a sentence.
std::string one_line(std::string sentence);

/// One line each.
void tell_warnings(const std::vector<std::string>& sentences, bool quiet);

/// "12 of 240 frames are kept", and the frames that are made again with the reason: the
/// first, or with -v each.
void tell_rest(const Rest& rest, const CommonArguments& common);
/// The frames without a plate and their replacement; with -v each file.
void tell_missing(const FilledSequence& filled, std::size_t of, const CommonArguments& common);
/// The parts of a scene's geometry that are not drawn, a line each; `file` is its file.
void tell_warnings(const Model& model, const std::string& file, const CommonArguments& common);

}  // namespace limpid::tool
