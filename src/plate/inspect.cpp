#include "limpid/plate/inspect.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "limpid/core/error.h"

#include "plate/layer_views.h"

namespace limpid {
namespace {

using Row = std::vector<std::string>;
constexpr std::string_view kSampleNames[] = {"half", "float", "uint"};

/// Names come from files: control characters must not reach the terminal.
std::string visible(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return text;
}

/// Rows with columns padded to their widest entry; no blanks at the ends of lines.
std::string aligned(const std::vector<Row>& rows, const std::string& indent) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += visible(row[i]);
      if (i + 1 < row.size()) line += std::string(widths[i] - row[i].size() + 2, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string window_text(const Rect& r) {
  std::string text = std::to_string(r.width()) + "x" + std::to_string(r.height());
  if (r.x0 != 0 || r.y0 != 0) {
    text += " at (" + std::to_string(r.x0) + ", " + std::to_string(r.y0) + ")";
  }
  return text;
}

std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string part_text(std::size_t index, const ExrPart& part) {
  Row facts;
  if (part.data == part.display) {
    facts.push_back(window_text(part.data));
  } else {
    facts.push_back("data window " + window_text(part.data));
    facts.push_back("display window " + window_text(part.display));
  }
  facts.push_back(part.compression);
  facts.push_back(part.tiled ? "tiled" : "scan lines");
  if (part.deep) facts.push_back("deep");
  if (part.pixel_aspect != 1) facts.push_back("pixel aspect " + number_text(part.pixel_aspect));
  if (!part.view.empty()) facts.push_back("view " + visible(part.view));
  if (!part.views.empty()) facts.push_back("views " + visible(join(part.views, " ")));
  const std::string name = part.name.empty() ? "" : " '" + visible(part.name) + "'";
  return "  part " + std::to_string(index) + name + ": " + join(facts) + "\n";
}

/// "half", or "half, one in 2x2" where the channel is subsampled.
std::string sample_text(const ExrChannel& channel) {
  std::string text(kSampleNames[static_cast<int>(channel.type)]);
  if (channel.x_sampling != 1 || channel.y_sampling != 1) {
    text +=
        ", one in " + std::to_string(channel.x_sampling) + "x" + std::to_string(channel.y_sampling);
  }
  return text;
}

/// A row for each layer and sample type: layer, components, type.
std::vector<Row> layer_rows(const ExrPart& part) {
  struct Line {
    std::string layer, samples;
    std::vector<std::string> components;
  };
  std::vector<Line> lines;
  for (const ExrChannel& channel : part.channels) {
    ChannelName name = split_channel(channel.name);
    const std::string samples = sample_text(channel);
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& l) {
      return l.layer == name.layer && l.samples == samples;
    });
    if (line == lines.end()) line = lines.insert(line, {name.layer, samples, {}});
    line->components.push_back(name.component);
  }
  std::vector<Row> rows;
  for (Line& line : lines) {
    sort_components(line.components);
    rows.push_back(
        {line.layer.empty() ? "(no layer)" : line.layer, join(line.components, " "), line.samples});
  }
  return rows;
}

/// "ViewLayer.Combined.R G B A": the layer once, then the components.
std::string channels_text(const LayerChoice& choice) {
  std::string text, layer;
  for (const ChannelRef& ref : choice.channels) {
    const ChannelName name = split_channel(ref.name);
    if (!text.empty()) text += " ";
    if ((text.empty() || name.layer != layer) && !name.layer.empty()) text += name.layer + ".";
    text += name.component;
    layer = name.layer;
  }
  return text;
}

/// "left (used), right"
std::string views_text(const InspectedViews& views) {
  std::vector<std::string> names = views.names;
  if (views.used.empty()) names.insert(names.begin(), "default");
  for (std::string& name : names) {
    const bool used = views.used.empty() ? name == "default" : is_same_view(name, views.used);
    name = visible(name) + (used ? " (used)" : "");
  }
  return "views\n  " + join(names) + "\n";
}

/// "(a.exr)", or "(a.exr, part 1)" where the file has several.
std::string place_text(const InspectedFile& file, const LayerChoice& choice) {
  if (file.parts.size() == 1) return "(" + file.name + ")";
  std::vector<std::string> parts;
  for (const ChannelRef& ref : choice.channels) {
    const std::string part = std::to_string(ref.part);
    if (parts.empty() || parts.back() != part) parts.push_back(part);
  }
  return "(" + file.name + (parts.size() == 1 ? ", part " : ", parts ") + join(parts) + ")";
}

/// One line per text, or the name and then its lines.
std::string made_text(const std::map<std::string, std::string>& texts) {
  std::string text;
  for (const auto& [name, value] : texts) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < value.size();) {
      const std::size_t end = std::min(value.find('\n', at), value.size());
      lines.push_back(visible(value.substr(at, end - at)));
      at = end + 1;
    }
    text += "  " + visible(name);
    if (lines.size() == 1) {
      text += "  " + lines[0] + "\n";
      continue;
    }
    text += "\n";
    for (const std::string& line : lines) text += (line.empty() ? "" : "    " + line) + "\n";
  }
  return text;
}

}  // namespace

std::string inspect_text(std::span<const InspectedFile> files, const LayerChoices& choices,
                         const std::map<std::string_view, std::string>& problems,
                         const InspectedViews& views) {
  std::string text;
  for (const InspectedFile& file : files) {
    text += visible(file.name);
    if (!file.color_space.empty()) text += ": " + visible(file.color_space);
    text += "\n";
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
      text += part_text(i, file.parts[i]) + aligned(layer_rows(file.parts[i]), "    ");
    }
  }

  if (!views.names.empty()) text += views_text(views);

  std::vector<Row> found, open;
  std::set<int> used;
  for (const Role& role : roles()) {
    const auto choice = choices.find(role.name);
    const auto problem = problems.find(role.name);
    if (choice != choices.end()) {
      const LayerChoice& c = choice->second;
      for (const ChannelRef& ref : c.channels) used.insert(ref.file);
      found.push_back({std::string(role.name), channels_text(c),
                       place_text(files[c.channels[0].file], c), "- " + c.reason});
    } else if (problem != problems.end()) {
      open.push_back({std::string(role.name), problem->second});
    } else {
      open.push_back({std::string(role.name), std::string(role.about)});
    }
  }
  if (!found.empty()) text += "found\n" + aligned(found, "  ");
  if (!open.empty()) text += "not found\n" + aligned(open, "  ");

  std::vector<Row> unused;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!used.contains(static_cast<int>(i))) unused.push_back({files[i].name});
  }
  if (!unused.empty()) text += "not used\n" + aligned(unused, "  ");

  for (const InspectedFile& file : files) {
    if (!file.made.empty()) {
      text += "how " + visible(file.name) + " was made\n" + made_text(file.made);
    }
  }
  return text;
}

}  // namespace limpid
