#include "desk/desk_json.h"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "limpid/plan/plan.h"
#include "limpid/version.h"

#include "core/toml_text.h"

namespace limpid {
namespace {

using Json = nlohmann::ordered_json;  // the order of settings matters

// --- answers ---

std::string_view kind_name(FieldKind kind) {
  switch (kind) {
    case FieldKind::kReal:
      return "real";
    case FieldKind::kChoice:
      return "choice";
    case FieldKind::kColor:
      return "color";
    case FieldKind::kText:
      return "text";
    case FieldKind::kCountOrWord:
      return "count_or_word";
    case FieldKind::kTable:
      return "table";
    case FieldKind::kDirection:
      return "direction";
    case FieldKind::kMatrix:
      return "matrix";
    case FieldKind::kFile:
      break;
  }
  return "file";
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json value_json(const Value& value) {
  if (const double* x = std::get_if<double>(&value)) return number(*x);
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  if (const auto* c = std::get_if<Rgb<double>>(&value)) {
    return {number(c->r), number(c->g), number(c->b)};
  }
  Json rows = Json::array();
  for (const std::vector<double>& row : std::get<Rows>(value)) {
    Json& list = rows.emplace_back(Json::array());
    for (const double x : row) list.push_back(number(x));
  }
  return rows;
}

Json words_json(std::span<const std::string_view> words) {
  Json list = Json::array();
  for (const std::string_view word : words) list.push_back(word);
  return list;
}

/// An end of a range, null if infinite.
Json bound(double x) {
  return std::abs(x) < std::numeric_limits<double>::max() ? number(x) : Json(nullptr);
}

Json field_json(const Parameter& p) {
  Json conditions = Json::array();
  for (const Condition& condition : p.used_when) {
    if (condition.key.empty()) continue;
    Json words = Json::array();
    for (const std::string_view word : condition.words) {
      if (!word.empty()) words.push_back(word);
    }
    conditions.push_back({{"key", condition.key},
                          {"words", words},
                          {"or_above_zero", condition.or_above_zero},
                          {"follows", condition.follows},
                          {"text", to_string(condition)}});
  }
  const bool numbers = p.kind == FieldKind::kReal || p.kind == FieldKind::kColor ||
                       p.kind == FieldKind::kCountOrWord || p.kind == FieldKind::kTable;
  return {{"name", p.name},
          {"unit", p.unit},
          {"kind", kind_name(p.kind)},
          {"least", numbers ? bound(p.range.min) : Json(nullptr)},
          {"most", numbers ? bound(p.range.max) : Json(nullptr)},
          {"choices", words_json(p.choices)},
          {"columns", words_json(p.columns)},
          {"least_columns", p.least_columns},
          {"about", p.about},
          {"used_when", conditions}};
}

Json operators_json() {
  Json list = Json::array();
  const std::vector<Parameter> all = parameters(Look{});
  const auto add = [&](std::string_view name, std::string_view about) {
    Json fields = Json::array();
    for (const Parameter& p : all) {
      if (p.table == name) fields.push_back(field_json(p));
    }
    list.push_back({{"name", name}, {"about", about}, {"fields", std::move(fields)}});
  };
  add(Water::kName, Water::kAbout);
  for (const OperatorInfo& op : operators()) add(op.name, op.about);
  return list;
}

Json look_json(const DeskLook& look) {
  Json values = Json::object();
  for (const Parameter& p : parameters(look.look)) {
    values[std::string(p.table)][std::string(p.name)] = value_json(p.value);
  }
  return {{"name", look.word},
          {"about", look.look.about},
          {"preset", look.is_preset()},
          {"values", std::move(values)}};
}

/// The values of the settings, by their names.
Json settings_json(const std::vector<std::string>& settings, const Look& look) {
  Json set = Json::object();
  for (const std::string& setting : settings) {
    for (const Parameter& p : parameters(look)) {
      const std::string name = std::string(p.table) + "." + std::string(p.name);
      const std::size_t end = setting.find_first_of(" \t=");
      if (setting.substr(0, end) == name) set[name] = value_json(p.value);
    }
  }
  return set;
}

Json optional_json(const std::optional<int>& x) { return x ? Json(*x) : Json(nullptr); }

Json pixel_of(const Rgb<float>& c) { return {number(c.r), number(c.g), number(c.b)}; }

/// Names of files may be invalid UTF-8.
std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// --- requests ---

/// A JSON object whose keys are read one by one; unread keys are refused.
class Asked {
 public:
  explicit Asked(std::string_view text, std::initializer_list<const char*> more)
      : json_(Json::parse(text, nullptr, false)) {
    if (json_.is_discarded() || !json_.is_object()) throw Error("request: expected a JSON object");
    std::vector<std::string> known = {"look", "set", "frame", "time"};
    known.insert(known.end(), more.begin(), more.end());
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      throw Error("request: unknown key '" + key + "': expected some of " + join(known) +
                  did_you_mean(key, known));
    }
  }

  /// Null if it is missing.
  const Json* find(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }

  std::string text(const char* key, std::optional<std::string> otherwise = {}) const {
    const Json* value = find(key);
    if (!value && otherwise) return *otherwise;
    if (!value || !value->is_string()) refuse(key, "a string");
    return value->get<std::string>();
  }

  bool flag(const char* key) const {
    const Json* value = find(key);
    if (value && !value->is_boolean()) refuse(key, "true or false");
    return value && value->get<bool>();
  }

  double real(const char* key, double otherwise) const {
    const Json* value = find(key);
    if (value && !value->is_number()) refuse(key, "a number");
    return value ? value->get<double>() : otherwise;
  }

  int count(const char* key) const {
    const Json* value = find(key);
    const bool fits = value && value->is_number_integer() &&
                      value->get<double>() >= std::numeric_limits<int>::min() &&
                      value->get<double>() <= std::numeric_limits<int>::max();
    if (!fits) refuse(key, "a whole number");
    return value->get<int>();
  }

  [[noreturn]] static void refuse(const std::string& key, const std::string& expected) {
    throw Error("request: " + key + ": expected " + expected);
  }

 private:
  Json json_;
};

constexpr double kMaxSeconds = 1e12;  ///< so that no wave's phase overflows

std::string numbers_text(const Json& list) {
  std::vector<std::string> texts;
  for (const Json& x : list) texts.push_back(toml_text(x.get<double>()));
  return "[" + join(texts) + "]";
}

bool is_numbers(const Json& value) {
  const auto is_number = [](const Json& x) { return x.is_number(); };
  return value.is_array() && std::all_of(value.begin(), value.end(), is_number);
}

/// In the syntax of `--set`.
std::string setting_text(const std::string& key, const Json& value) {
  if (value.is_string()) return key + "=" + value.get<std::string>();
  if (value.is_number()) return key + "=" + toml_text(value.get<double>());
  if (is_numbers(value)) return key + "=" + numbers_text(value);
  if (!value.is_array() || !std::all_of(value.begin(), value.end(), is_numbers)) {
    Asked::refuse("set: " + key, "a number, a string, or a list of numbers or of rows of numbers");
  }
  std::vector<std::string> rows;
  for (const Json& row : value) rows.push_back(numbers_text(row));
  return key + "=[" + join(rows) + "]";
}

void put_choice(const Asked& asked, DeskChoice& choice) {
  choice.look = asked.text("look");
  if (const Json* set = asked.find("set")) {
    if (!set->is_object()) Asked::refuse("set", "an object of settings");
    for (const auto& [key, value] : set->items()) {
      choice.settings.push_back(setting_text(key, value));
    }
  }
  if (asked.find("frame")) choice.frame = asked.count("frame");
  if (asked.find("time")) {
    choice.time = asked.real("time", 0);
    if (!(std::abs(*choice.time) <= kMaxSeconds)) Asked::refuse("time", "-1e12 ... 1e12 (s)");
  }
}

}  // namespace

std::string desk_json(Desk& desk) {
  const DeskOptions& options = desk.options();
  const Desk::Facts facts = desk.facts();
  const Rect& w = facts.window;
  Json looks = Json::array(), shows = Json::array();
  for (const DeskLook& look : options.looks) looks.push_back(look_json(look));
  for (const DeskShow& show : desk.shows()) {
    shows.push_back({{"name", show.name}, {"about", show.about}});
  }
  return dumped({{"version", kVersion},
                 {"plate", join(facts.files)},
                 {"size", {w.width(), w.height()}},
                 {"window", {w.x0, w.y0, w.x1, w.y1}},
                 {"frames", options.frames},
                 {"frame", optional_json(facts.frame)},
                 {"fps", options.fps},
                 {"time", facts.time},
                 {"runner", desk.runner()},
                 {"looks", std::move(looks)},
                 {"start", options.start},
                 {"set", settings_json(options.settings, facts.look)},
                 {"operators", operators_json()},
                 {"shows", std::move(shows)},
                 {"displays", desk.displays()},
                 {"folder", std::filesystem::absolute(options.folder).string()},
                 {"warnings", facts.warnings}});
}

NewPicture picture_request(std::string_view json) {
  const Asked asked(json, {"half", "show", "exposure", "display", "instead"});
  NewPicture request;
  put_choice(asked, request);
  request.half = asked.flag("half");
  request.instead = asked.flag("instead");
  request.show = asked.text("show", "picture");
  request.exposure = asked.real("exposure", 0);
  request.display = asked.text("display", "");
  return request;
}

DeskChoice choice_request(std::string_view json) {
  DeskChoice choice;
  put_choice(Asked(json, {}), choice);
  return choice;
}

PixelRequest pixel_request(std::string_view json) {
  const Asked asked(json, {"half", "show", "exposure", "display", "x", "y"});
  PixelRequest request;
  put_choice(asked, request);
  request.x = asked.count("x");
  request.y = asked.count("y");
  return request;
}

SaveRequest save_request(std::string_view json) {
  const Asked asked(json, {"name", "replace"});
  SaveRequest request;
  put_choice(asked, request);
  request.name = asked.text("name");
  request.replace = asked.flag("replace");
  return request;
}

std::string picture_bytes(const DeskPicture& picture) {
  Json milliseconds = Json::object();
  for (const auto& [name, time] : picture.milliseconds) milliseconds[name] = time;
  Json replaced = Json::array();
  for (const auto& [key, value, why] : picture.replaced) {
    replaced.push_back({{"key", key}, {"value", value}, {"why", why}});
  }
  Json unread = Json::array();
  for (const auto& [key, why] : picture.unread) unread.push_back({{"key", key}, {"why", why}});
  const Shown& shown = picture.shown;
  const std::string facts = dumped({{"width", shown.size.width},
                                    {"height", shown.size.height},
                                    {"half", picture.half},
                                    {"milliseconds", std::move(milliseconds)},
                                    {"replaced", std::move(replaced)},
                                    {"unread", std::move(unread)},
                                    {"warnings", picture.warnings},
                                    {"advice", picture.advice},
                                    {"wet", picture.wet ? Json(*picture.wet) : Json(nullptr)},
                                    {"scale", shown.scale ? Json(*shown.scale) : Json(nullptr)}});
  std::string bytes;
  bytes.reserve(4 + facts.size() + shown.rgba.size());
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(facts.size() >> (8 * i) & 255);
  bytes += facts;
  bytes.append(reinterpret_cast<const char*>(shown.rgba.data()), shown.rgba.size());
  return bytes;
}

std::string pixel_json(const PixelRequest& request, const PixelNumbers& numbers) {
  Json all = Json::object();
  for (const auto& [aov, values] : numbers.aovs) {
    const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
    Json& channels = all[std::string(info.name)];
    for (std::size_t i = 0; i < values.size(); ++i) {
      channels[std::string(1, info.suffixes[i])] = number(values[i]);
    }
  }
  return dumped({{"x", request.x},
                 {"y", request.y},
                 {"dry", pixel_of(numbers.dry)},
                 {"picture", pixel_of(numbers.picture)},
                 {"aovs", std::move(all)}});
}

std::string text_json(const std::string& key, const std::string& text) {
  return dumped({{key, text}});
}

}  // namespace limpid
