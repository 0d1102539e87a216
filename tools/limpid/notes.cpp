#include "notes.h"

#include <algorithm>
#include <cstdio>

#include "core/ranges_text.h"

namespace limpid::tool {
namespace {

void note(const std::string& sentence) {
  std::fprintf(stderr, "limpid: %s\n", one_line(sentence).c_str());
}

}  // namespace

std::string one_line(std::string sentence) {
  for (char& c : sentence) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return sentence;
}

void tell_warnings(const std::vector<std::string>& sentences, bool quiet) {
  if (quiet) return;
  for (const std::string& sentence : sentences) note("warning: " + sentence);
}

void tell_rest(const Rest& rest, const CommonArguments& common) {
  if (common.quiet) return;
  const std::size_t of = rest.frames.size() + static_cast<std::size_t>(rest.kept);
  note(std::to_string(rest.kept) + " of " + std::to_string(of) + " frames are kept");
  if (rest.others.empty()) return;
  const Rest::Other& first = rest.others.front();
  const std::size_t again = rest.others.size();
  note(std::to_string(again) + " existing " + (again == 1 ? "frame is" : "frames are") +
       " made again; frame " + std::to_string(first.frame) + ": " + first.why);
  if (!common.verbose) return;
  for (std::size_t i = 1; i < rest.others.size(); ++i) {
    note("frame " + std::to_string(rest.others[i].frame) + ": " + rest.others[i].why);
  }
}

void tell_missing(const FilledSequence& filled, std::size_t of, const CommonArguments& common) {
  if (common.quiet || filled.missing.empty()) return;
  std::vector<int> numbers;
  for (const MissingPlate& plate : filled.missing) numbers.push_back(plate.frame);
  std::sort(numbers.begin(), numbers.end());
  const bool held = filled.missing.front().stand_in.has_value();
  note(std::to_string(numbers.size()) + " of " + std::to_string(of) + " frames have no plate and " +
       (held ? "are made from other plates" : "are left out") + ": " + ranges_text(numbers));
  if (!common.verbose) return;
  for (const MissingPlate& plate : filled.missing) {
    note("frame " + std::to_string(plate.frame) + ": " + plate.file.string() + " is missing" +
         (plate.stand_in ? ": made from frame " + std::to_string(*plate.stand_in) : ""));
  }
}

void tell_warnings(const Model& model, const std::string& file, const CommonArguments& common) {
  if (common.quiet) return;
  for (const std::string& warning : model.warnings) note("warning: " + file + ": " + warning);
}

}  // namespace limpid::tool
