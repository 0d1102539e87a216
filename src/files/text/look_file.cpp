#include "limpid/files/text/look_file.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "files/text/toml_value.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// Relative file names in the look become absolute.
void resolve_files(Look& look, const fs::path& folder) {
  std::string& map = look.of<WaveNormals>().map;
  if (!map.empty()) map = (folder / map).lexically_normal().string();
}

constexpr std::string_view kAbout = "about", kBase = "base";

/// Applies the file to the look.
void read(const TomlNode& root, Look& look) {
  const std::vector<Parameter> all = parameters(look);
  std::vector<std::string> known = {std::string(kAbout), std::string(kBase)};
  for (const Parameter& p : all) {
    if (known.back() != p.table) known.emplace_back(p.table);
  }
  root.expect_keys(known);
  look.about.clear();
  if (const TomlNode* about = root.find(kAbout)) {
    look.about = about->word();
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
    if (std::any_of(look.about.begin(), look.about.end(), is_control)) {
      about->refuse("a sentence on one line");
    }
  }
  for (const TomlNode& table : root.items) {
    if (table.key == kAbout || table.key == kBase) continue;
    std::vector<std::string> keys;
    for (const Parameter& p : all) {
      if (p.table == table.key) keys.emplace_back(p.name);
    }
    table.expect_keys(keys);
    for (const Parameter& p : all) {
      const TomlNode* node = p.table == table.key ? table.find(p.name) : nullptr;
      if (!node) continue;
      const Value value = value_of(*node, p);
      at_place(node->place, [&] { look.set(p.table, p.name, value); });
    }
  }
}

using Folders = std::span<const fs::path>;

/// The file of the look of that name; a relative path begins in the folder `from`.
fs::path file_of(std::string_view name, Folders folders, const fs::path& from) {
  const fs::path path(name);
  if (path.extension() == ".toml" || path.has_parent_path()) return from / path;
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (path.string() + ".toml");
    std::error_code absent;
    if (fs::exists(file, absent)) return file;
  }
  const std::vector<std::string> known = look_names(folders);
  std::vector<std::string> searched;
  for (const fs::path& folder : folders) searched.push_back(folder.string());
  const std::string empty = searched.empty() ? "" : ", or looks in one of " + join(searched);
  throw Error("no look is named '" + path.string() + "': expected " +
              (known.empty() ? "the path of a look file" + empty : "one of " + join(known)) +
              did_you_mean(name, known));
}

/// `above` are the files of the looks based on this look, in the order of their reading.
Look load(const fs::path& path, Folders folders, std::vector<fs::path>& above) {
  const TomlNode root = parse_toml(path);
  above.push_back(path);
  Look look;
  if (const TomlNode* base = root.find(kBase)) {
    const std::string& name = base->word();
    const fs::path file =
        at_place(base->place, [&] { return file_of(name, folders, path.parent_path()); });
    for (const fs::path& one : above) {
      std::error_code absent;
      if (fs::equivalent(one, file, absent)) base->refuse("a look that is not based on this one");
    }
    look = load(file, folders, above);
    look.bases.insert(look.bases.begin(), look.file);
  }
  read(root, look);
  look.name = path.stem().string();
  look.file = fs::absolute(path).string();
  resolve_files(look, fs::absolute(path).parent_path());
  return look;
}

}  // namespace

Look load_look(const fs::path& path, Folders folders) {
  std::vector<fs::path> above;
  return load(path, folders, above);
}

Look look_from_toml(const std::string& text, const std::string& name) {
  const TomlNode root = parse_toml_text(text, name);
  if (const TomlNode* base = root.find(kBase)) {
    base->refuse("none, since only look files have a base");
  }
  Look look;
  read(root, look);
  look.name = name;
  return look;
}

Look look_named(std::string_view name, Folders folders) {
  return load_look(file_of(name, folders, {}), folders);
}

std::vector<std::string> look_names(std::span<const fs::path> folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code absent;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, absent)) {
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

void apply_setting(Look& look, std::string_view setting) {
  const std::size_t equals = setting.find('=');
  const std::string_view name = trimmed(setting.substr(0, equals));
  const std::size_t dot = name.find('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos) {
    throw Error("setting '" + std::string(setting) + "': expected operator.parameter=value",
                Fault::kUsage);
  }
  const std::string_view table = name.substr(0, dot), key = name.substr(dot + 1);
  const std::string_view text = trimmed(setting.substr(equals + 1));
  Value value = std::string(text);
  for (const Parameter& p : parameters(look)) {
    if (p.table == table && p.name == key) value = value_of_setting(name, text, p);
  }
  try {
    look.set(table, key, value);
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
  resolve_files(look, fs::current_path());
}

void apply_settings(Look& look, std::span<const std::string> settings) {
  const Look base = look;
  const auto apply = [&] {
    for (const std::string& setting : settings) apply_setting(look, setting);
  };
  apply();
  forget_unread(look, base);
  apply();  // a setting that repeats a value of the look is no value of the look alone
}

}  // namespace limpid
