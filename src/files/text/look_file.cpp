#include "limpid/files/text/look_file.h"

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

Look look_of(const TomlNode& root, std::string name) {
  Look look;
  look.name = std::move(name);
  const std::vector<Parameter> all = parameters(look);
  std::vector<std::string> tables;
  for (const Parameter& p : all) {
    if (tables.empty() || tables.back() != p.table) tables.emplace_back(p.table);
  }
  root.expect_keys(tables);
  for (const TomlNode& table : root.items) {
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
  return look;
}

}  // namespace

Look load_look(const fs::path& path) {
  Look look = look_of(parse_toml(path), path.stem().string());
  resolve_files(look, fs::absolute(path).parent_path());
  look.file = fs::absolute(path).string();
  return look;
}

Look look_from_toml(const std::string& text, const std::string& name) {
  return look_of(parse_toml_text(text, name), name);
}

Look look_named(std::string_view name, std::span<const fs::path> folders) {
  const fs::path path(name);
  if (path.extension() == ".toml" || path.has_parent_path()) return load_look(path);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (path.string() + ".toml");
    std::error_code absent;
    if (fs::exists(file, absent)) return load_look(file);
  }
  const std::vector<std::string> known = look_names(folders);
  throw Error("no look is named '" + path.string() + "': expected " +
              (known.empty() ? "the path of a look file" : "one of " + join(known)) +
              did_you_mean(name, known));
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

}  // namespace limpid
