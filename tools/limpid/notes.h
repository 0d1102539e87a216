#pragma once
#include <string>
#include <vector>

#include "limpid/job/missing.h"
#include "limpid/job/resume.h"
#include "limpid/raster/model.h"

#include "arguments.h"

/// What there is to say on stderr that is no error.

namespace limpid::tool {

/// Names come from files: they shall not steer a terminal, nor make two lines of a sentence.
std::string one_line(std::string sentence);

/// A line each.
void tell_warnings(const std::vector<std::string>& sentences, bool quiet);

/// "12 of 240 frames are there already", and which are made again and why: the first, or with -v
/// each.
void tell_rest(const Rest& rest, const CommonArguments& common);
/// Which frames lack a plate and what becomes of them; with -v each file.
void tell_missing(const FilledSequence& filled, std::size_t of, const CommonArguments& common);
/// What of a scene's geometry is not drawn, a line each; `file` is where it was read from.
void tell_warnings(const Model& model, const std::string& file, const CommonArguments& common);

}  // namespace limpid::tool
