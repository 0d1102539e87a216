#include "desk/saved_look.h"

#include <algorithm>
#include <vector>

#include "core/value_text.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

bool is_set(const Parameter& p, const std::vector<Parameter>& defaults) {
  return std::any_of(defaults.begin(), defaults.end(), [&](const Parameter& d) {
    return d.table == p.table && d.name == p.name && d.value != p.value;
  });
}

/// Whether setting another set parameter also sets this one: then its value must be written.
bool follows(const Parameter& p, const std::vector<Parameter>& all,
             const std::vector<Parameter>& defaults) {
  return std::any_of(all.begin(), all.end(), [&](const Parameter& other) {
    const auto brings = [&](const Condition& c) { return c.follows && c.key == p.name; };
    return other.table == p.table && is_set(other, defaults) &&
           std::any_of(other.used_when.begin(), other.used_when.end(), brings);
  });
}

/// The path of `file` relative to the folder.
std::string name_from(const std::string& file, const fs::path& folder) {
  const fs::path name = fs::path(file).lexically_relative(fs::absolute(folder).lexically_normal());
  return name.empty() || *name.begin() == ".." ? file : name.string();
}

bool is_wave_map(const Parameter& p) { return p.table == WaveNormals::kName && p.name == "map"; }

std::string comment(const Parameter& p, const Value& before, const DeskLook& of) {
  std::string text = "# ";
  if (!p.unit.empty()) text += std::string(p.unit) + ": ";
  text += p.about;
  if (p.value != before) text += " In " + of.word + " " + to_string(before) + ".";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return text + "\n";
}

}  // namespace

std::string saved_look(const Look& look, const DeskLook& of, const fs::path& folder) {
  const std::vector<Parameter> all = parameters(look), defaults = parameters(Look{}),
                               before = parameters(of.look);
  std::string text;
  std::string_view table;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Parameter p = all[i];
    if (!is_set(p, defaults) && !follows(p, all, defaults)) continue;
    if (p.table != table) text += "\n[" + std::string(p.table) + "]\n";
    table = p.table;
    text += comment(p, before[i].value, of);
    if (is_wave_map(p)) p.value = name_from(look.of<WaveNormals>().map, folder);
    text += toml_line(p.name, p.value);
  }
  std::string word = of.word;
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return "# From the look " + word + ". What is left out is at its default.\n" + text;
}

}  // namespace limpid
