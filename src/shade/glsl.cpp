#include "shade/glsl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "shade/look_ahead.h"
#include "shade/shared_quad.h"

namespace limpid {
namespace {

const char* type_word(NodeType type) {
  switch (type) {
    case NodeType::kNumber:
      return "float";
    case NodeType::kMask:
      return "bool";
    case NodeType::kTwo:
      return "vec2";
    case NodeType::kThree:
      return "vec3";
    case NodeType::kFour:
      return "vec4";
  }
  return "";
}

class Printer {
 public:
  Printer(const Recording& recording, bool computes_frame, std::string& text, GlslNeeds& needs,
          std::vector<double>& frame_numbers)
      : r_(recording),
        text_(text),
        needs_(needs),
        frame_numbers_(frame_numbers),
        uses_(r_.nodes.size()),
        pinned_(r_.nodes.size()),
        chosen_(r_.nodes.size()),
        defined_(r_.nodes.size()),
        printed_(r_.flows.size()) {
    if (computes_frame) of_frame_ = values_of_frame(r_);
    count_uses();
    for (const SharedQuad& quad : shared_quads(r_)) shared_.push_back({quad, {}, {}});
  }

  void block(int index, int indent) {
    const auto& statements = r_.blocks[static_cast<std::size_t>(index)].statements;
    for (auto s = statements.begin(); s != statements.end(); ++s) {
      switch (s->kind) {
        case Statement::Kind::kTitle:
          title_ = r_.titles[static_cast<std::size_t>(s->what)];
          break;
        case Statement::Kind::kNode:
          node(std::span(s, statements.end()), indent);
          break;
        case Statement::Kind::kFlow:
          flow(std::span(s, statements.end()), indent);
          break;
      }
    }
  }

  std::string value(int id) {
    const Node& node = at(id);
    switch (node.op) {
      case NodeOp::kLiteral:
        return node.type == NodeType::kMask ? node.number != 0 ? "true" : "false"
                                            : number(node.number);
      case NodeOp::kGiven:
        return "limpid." + glsl_name(r_.given[static_cast<std::size_t>(node.what)].name);
      case NodeOp::kPart:
        return value(node.args[0]) + "." + "xyzw"[node.what];
      default:
        return names_.at(id);
    }
  }

 private:
  const Node& at(int id) const { return r_.nodes[static_cast<std::size_t>(id)]; }

  /// Whether it is a number that is computed once a frame. (Masks, which a uniform block does not
  /// have, follow from such numbers in a step.)
  bool is_of_frame(int id) const {
    const Node& node = at(id);
    return !of_frame_.empty() && of_frame_[static_cast<std::size_t>(id)] &&
           node.type == NodeType::kNumber && is_arithmetic(node.op);
  }
  /// Whether it is a number or a mask that follows from the frame, and no pixel reads it.
  bool is_idle(int id) const {
    const auto i = static_cast<std::size_t>(id);
    return !of_frame_.empty() && of_frame_[i] && is_arithmetic(at(id).op) && uses_[i] == 0 &&
           !pinned_[i];
  }
  void name_of_frame(int id) {
    const auto [name, fresh] = names_.try_emplace(id);
    if (!fresh) return;
    name->second = "limpid.frame_" + std::to_string(frame_numbers_.size());
    frame_numbers_.push_back(*of_frame_[static_cast<std::size_t>(id)]);
  }

  /// How often each node is read, and which must have a name: those that other blocks read, and
  /// those that go from one turn of a loop, or out of a block.
  void count_uses() {
    const auto pin = [&](int id) {
      if (id < 0) return;
      pinned_[static_cast<std::size_t>(id)] = true;
      if (is_of_frame(id)) name_of_frame(id);
    };
    for (const Flow& flow : r_.flows) {
      if (!r_.is_live(flow)) continue;
      pin(flow.condition);
      for (const Flow::Merge& m : flow.merges) {
        if (!r_.live[static_cast<std::size_t>(m.merged)]) continue;
        if (m.before >= 0 && !flow.loops) ++chosen_[static_cast<std::size_t>(m.before)];
        pin(m.before), pin(m.after);
      }
    }
    for (const Output& output : r_.outputs) pin(output.node);
    for (std::size_t i = r_.nodes.size(); i-- > 0;) {  // readers before what they read
      const Node& node = r_.nodes[i];
      const int id = static_cast<int>(i);
      if (!r_.live[i] || is_of_frame(id) || is_idle(id)) continue;
      for (const int arg : node.args) {
        if (arg < 0) continue;
        ++uses_[static_cast<std::size_t>(arg)];
        if (is_of_frame(arg)) name_of_frame(arg);
        if (at(arg).block != node.block) pin(arg);
      }
    }
  }
  /// Whether nothing but one if reads a texel, where its condition does not hold.
  bool is_otherwise(int id) const {
    return id >= 0 && at(id).op == NodeOp::kOwn && uses_[static_cast<std::size_t>(id)] == 0 &&
           chosen_[static_cast<std::size_t>(id)] == 1;
  }

  std::string number(double x) {
    if (std::isinf(x)) {
      needs_.infinity = true;
      return x > 0 ? "limpid_infinity" : "(-limpid_infinity)";
    }
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(static_cast<float>(x)));
    std::string word = text;
    if (word.find_first_of(".e") == std::string::npos) word += ".0";
    return std::signbit(x) ? "(" + word + ")" : word;
  }

  void line(int indent, const std::string& words) {
    if (!title_.empty()) {
      text_ += std::string(static_cast<std::size_t>(2 * indent), ' ') + "// " + title_ + "\n";
      title_.clear();
    }
    text_ += std::string(static_cast<std::size_t>(2 * indent), ' ') + words + "\n";
  }

  std::string call(const std::string& function, const Node& node) {
    std::string words = function + "(";
    for (std::size_t k = 0; k < node.args.size() && node.args[k] >= 0; ++k) {
      words += (k > 0 ? ", " : "") + value(node.args[k]);
    }
    return words + ")";
  }

  std::string power(const Node& node) {
    const Node& exponent = at(node.args[1]);
    // A device's exp2 and log2 are inexact; a chain of products has the error p / 2^24.
    constexpr double kLongest = 65536;
    const int whole = exponent.op == NodeOp::kLiteral && exponent.number <= kLongest
                          ? static_cast<int>(exponent.number)
                          : 0;
    if (whole > 0 && whole == exponent.number) {
      needs_.powers.insert(whole);
      return "limpid_power_" + std::to_string(whole) + "(" + value(node.args[0]) + ")";
    }
    needs_.power = true;
    return call("limpid_power", node);
  }

  std::string expression(int id) {
    const Node& node = at(id);
    const auto arg = [&](std::size_t k) { return value(node.args[k]); };
    const auto infix = [&](const char* op) { return "(" + arg(0) + " " + op + " " + arg(1) + ")"; };
    const PlaneId plane = static_cast<PlaneId>(node.what);
    const auto lookup = [&] { needs_.lookups.insert({node.op, node.what}); };
    const auto of_plane = [&](const char* verb) {
      lookup();
      return std::string("limpid_") + verb + "_" + role_word(plane);
    };
    const auto channel = [&] { return std::string(".") + channel_letter(plane); };
    needs_.ops.insert(node.op);
    switch (node.op) {
      case NodeOp::kAdd:
        return infix("+");
      case NodeOp::kSubtract:
        return infix("-");
      case NodeOp::kMultiply:
        return infix("*");
      case NodeOp::kDivide:
        return infix("/");
      case NodeOp::kLess:
        return infix("<");
      case NodeOp::kGreater:
        return infix(">");
      case NodeOp::kLessOrEqual:
        return infix("<=");
      case NodeOp::kGreaterOrEqual:
        return infix(">=");
      case NodeOp::kAnd:
        return infix("&&");
      case NodeOp::kOr:
        return infix("||");
      case NodeOp::kNot:
        return "(!" + arg(0) + ")";
      case NodeOp::kSelect:
        // Of `?:` compilers make branches, unless both sides are names.
        return "mix(" + arg(2) + ", " + arg(1) + ", " + arg(0) + ")";
      case NodeOp::kMin:
        return call("min", node);
      case NodeOp::kMax:
        return call("max", node);
      case NodeOp::kAbs:
        return call("abs", node);
      case NodeOp::kSqrt:
        return call(of_frame_.empty() ? "sqrt" : "limpid_sqrt", node);
      case NodeOp::kFloor:
        return call("floor", node);
      case NodeOp::kExp:
        return call("exp", node);
      case NodeOp::kSin:
        return call("sin", node);
      case NodeOp::kCos:
        return call("cos", node);
      case NodeOp::kAtan2:
        return call("limpid_atan2", node);
      case NodeOp::kPow:
        return power(node);
      case NodeOp::kColumn:
        return "limpid_column()";
      case NodeOp::kRow:
        return "limpid_row(" + std::to_string(node.what) + ")";
      case NodeOp::kOwn:
        lookup();
        return own(node.what);
      case NodeOp::kBeside: {
        const int k = static_cast<int>(node.number);
        return of_plane("texel") + "(limpid_pixel + ivec2(" + std::to_string(k % 3 - 1) + ", " +
               std::to_string(k / 3 - 1) + "))" + channel();
      }
      case NodeOp::kNearest:
        return of_plane("nearest") + "(vec2(" + arg(0) + ", " + arg(1) + "))" + channel();
      case NodeOp::kBilinear:
        return of_plane("bilinear") + "_" + channel_letter(plane) + "(vec2(" + arg(0) + ", " +
               arg(1) + "))";
      case NodeOp::kBilinear3:
        return of_plane("bilinear") + "(vec2(" + arg(0) + ", " + arg(1) + ")).rgb";
      case NodeOp::kQuad:
        return "limpid_quad(vec2(" + arg(0) + ", " + arg(1) + "))";
      case NodeOp::kRead:
        lookup();
        return read(node.what, arg(0));
      case NodeOp::kPlace: {
        constexpr const char* kCorners[] = {"0.0, 0.0", "1.0, 0.0", "0.0, 1.0", "1.0, 1.0"};
        const auto k = static_cast<std::size_t>(node.number);
        return of_plane("place") + "(" + arg(0) + ", vec2(" + kCorners[k] + "))";
      }
      case NodeOp::kTiled:
        lookup();
        return "limpid_tiled(vec2(" + arg(0) + ", " + arg(1) + "))";
      case NodeOp::kTiledWide:
        lookup();
        return "limpid_tiled_wide(vec2(" + arg(0) + ", " + arg(1) + "), " + arg(2) + ")";
      case NodeOp::kSlopeMean:
        lookup();
        return "limpid_slope_mean(vec2(" + arg(0) + ", " + arg(1) + "), " + arg(2) + ")";
      case NodeOp::kSlopeSquare:
        lookup();
        return "limpid_slope_square(vec2(" + arg(0) + ", " + arg(1) + "), " + arg(2) + ")";
      case NodeOp::kLatLong:
        lookup();
        return "limpid_lat_long_" + std::to_string(node.what) + "(vec2(" + arg(0) + ", " + arg(1) +
               "))";
      case NodeOp::kGrid:
        lookup();
        return "limpid_grid_" + std::to_string(node.what) + "(vec2(" + arg(0) + ", " + arg(1) +
               "))";
      case NodeOp::kLiteral:
      case NodeOp::kGiven:
      case NodeOp::kMerged:
      case NodeOp::kIndex:
      case NodeOp::kPart:
        break;
    }
    return value(id);
  }

  using Known = std::unordered_map<int, bool>;
  /// Whether a node can be written where the printer is: it, and what it is made of. `known` has
  /// the answers that were found there.
  bool is_at_hand(int id, Known& known) const {
    const Node& node = at(id);
    const bool written = defined_[static_cast<std::size_t>(id)] || names_.count(id) > 0;
    if (written || node.op == NodeOp::kLiteral || node.op == NodeOp::kGiven) return true;
    if (node.op == NodeOp::kMerged || node.op == NodeOp::kIndex) return false;
    if (const auto answer = known.find(id); answer != known.end()) return answer->second;
    const auto is_there = [&](int arg) { return arg < 0 || is_at_hand(arg, known); };
    return known[id] = std::all_of(node.args.begin(), node.args.end(), is_there);
  }
  /// Writes it there.
  void bring(int id, int indent) {
    const Node& node = at(id);
    if (defined_[static_cast<std::size_t>(id)] || names_.count(id) > 0) return;
    if (node.op <= NodeOp::kIndex) return;
    for (const int arg : node.args) {
      if (arg >= 0) bring(arg, indent);
    }
    define_once(id, indent);
  }

  /// The lookups of one width, in one if: with an if in each, devices wait for the one before. The
  /// others of the block come first, too. (NVIDIA H100: a look with four takes .92 of the time.)
  void tiled_wide(int first, std::span<const Statement> rest, int indent) {
    if (defined_[static_cast<std::size_t>(first)]) return;
    Known known;
    const int width = at(first).args[2];
    std::vector<int> all;
    for (const Statement& s : rest) {
      if (s.kind != Statement::Kind::kNode || !r_.live[static_cast<std::size_t>(s.what)]) continue;
      const Node& node = at(s.what);
      const bool same = node.op == NodeOp::kTiledWide && node.args[2] == width;
      if (same && is_at_hand(s.what, known)) all.push_back(s.what);
    }
    if (all.size() == 1) return define_once(first, indent);
    for (const int id : all) {
      for (const int arg : at(id).args) bring(arg, indent);
    }
    for (const int id : all) {
      needs_.ops.insert(NodeOp::kTiledWide);
      needs_.lookups.insert({NodeOp::kTiledWide, at(id).what});
      defined_[static_cast<std::size_t>(id)] = true;
      names_[id] = fresh('v');
      line(indent, "vec3 " + names_[id] + ";");
    }
    using Words = const std::string&;
    const auto each = [&](int inner, auto&& words_of) {
      for (const int id : all) {
        const Node& node = at(id);
        const std::string place = "vec2(" + value(node.args[0]) + ", " + value(node.args[1]) + ")";
        line(inner, words_of(names_[id], place) + ";");
      }
    };
    const std::string wide = value(width), share = fresh('t'), rest_of = fresh('t');
    const std::string level = fresh('t'), next = fresh('t'), fine = fresh('t');
    const auto at_level = [](Words which, Words place) {
      return "limpid_level_wave_levels(limpid.levels_wave_levels[" + which + "], " + place + ")";
    };
    line(indent, "if (limpid_is_fine(" + wide + ")) {");
    each(indent + 1, [](Words v, Words place) { return v + " = limpid_tiled(" + place + ")"; });
    line(indent, "} else {");  // limpid_tiled_wide(), with all lookups of a level together
    line(indent + 1, "float " + rest_of + ";");
    line(indent + 1, "const int " + level + " = limpid_level_of(max(0.5 * " + wide +
                         ", 1.0), limpid.counts.x - 1, " + rest_of + ");");
    each(indent + 1, [&](Words v, Words place) { return v + " = " + at_level(level, place); });
    line(indent + 1, "if (" + rest_of + " > 0.0) {");
    line(indent + 2, "const int " + next + " = min(" + level + " + 1, limpid.counts.x - 1);");
    each(indent + 2, [&](Words v, Words place) {
      return v + " += " + rest_of + " * (" + at_level(next, place) + " - " + v + ")";
    });
    line(indent + 1, "}");
    each(indent + 1, [](Words v, Words) { return v + " *= limpid_level_unit"; });
    line(indent + 1, "const float " + share + " = limpid_share(" + wide + ");");
    line(indent + 1, "if (" + share + " < 1.0) {");
    line(indent + 2, "vec3 " + fine + ";");
    each(indent + 2, [&](Words v, Words place) {
      return fine + " = limpid_tiled(" + place + "), " + v + " = " + fine + " + " + share + " * (" +
             v + " - " + fine + ")";
    });
    line(indent + 1, "}");
    line(indent, "}");
  }

  /// Mean and square of the slopes at one place have the same texels around them.
  void slopes(std::span<const Statement> rest, int indent) {
    const int mean = rest[0].what;
    if (defined_[static_cast<std::size_t>(mean)]) return;
    for (const Statement& s : rest) {
      if (s.kind != Statement::Kind::kNode || !r_.live[static_cast<std::size_t>(s.what)]) continue;
      const Node& node = at(s.what);
      if (node.op != NodeOp::kSlopeSquare || node.args != at(mean).args) continue;
      for (const int id : {mean, s.what}) {
        needs_.lookups.insert({at(id).op, at(id).what});
        defined_[static_cast<std::size_t>(id)] = true;
        names_[id] = fresh('v');
      }
      needs_.slope_moments = true;
      line(indent, "vec2 " + names_[mean] + ";");
      line(indent, "vec3 " + names_[s.what] + ";");
      line(indent, "limpid_slope_moments(vec2(" + value(node.args[0]) + ", " + value(node.args[1]) +
                       "), " + value(node.args[2]) + ", " + names_[mean] + ", " + names_[s.what] +
                       ");");
      return;
    }
    define_once(mean, indent);
  }

  /// The first of these statements.
  void node(std::span<const Statement> rest, int indent) {
    const int id = rest[0].what;
    if (!r_.live[static_cast<std::size_t>(id)]) return;
    if (at(id).op == NodeOp::kTiledWide) return tiled_wide(id, rest, indent);
    if (at(id).op == NodeOp::kSlopeMean) return slopes(rest, indent);
    define_once(id, indent);
  }

  void define_once(int id, int indent) {
    if (defined_[static_cast<std::size_t>(id)]) return;
    defined_[static_cast<std::size_t>(id)] = true;
    define(id, indent);
  }

  std::string fresh(char letter) { return letter + std::to_string(next_++); }

  void define(int id, int indent) {
    const Node& node = at(id);
    if (node.op == NodeOp::kPart) return;  // its vector has a name
    if (is_of_frame(id) || is_idle(id)) return;
    // Of `&&` and `||` compilers make branches, unless the right side is a name.
    if (node.op == NodeOp::kAnd || node.op == NodeOp::kOr) name(node.args[1], indent);
    std::string words = shared(id, indent);
    if (words.empty()) words = expression(id);
    if (node.op == NodeOp::kRow || is_otherwise(id)) {  // read where it is needed alone
      names_[id] = std::move(words);
      return;
    }
    constexpr std::size_t kLongest = 72;
    const bool once = uses_[static_cast<std::size_t>(id)] == 1;
    if (once && !pinned_[static_cast<std::size_t>(id)] && node.type <= NodeType::kMask &&
        node.op <= NodeOp::kPow && words.size() < kLongest) {
      names_[id] = std::move(words);
      return;
    }
    names_[id] = std::move(words);
    name(id, indent);
  }

  /// A variable for a node that is written as an expression.
  void name(int id, int indent) {
    const auto written = names_.find(id);
    if (written == names_.end() || written->second.find('(') == std::string::npos) return;
    const std::string words = std::exchange(written->second, fresh('t'));
    line(indent, std::string("const ") + type_word(at(id).type) + " " + written->second + " = " +
                     bare(words) + ";");
  }

  struct Shared {
    SharedQuad nodes;
    std::string quad, texels;  ///< names; empty before the nearest texel is written
  };
  /// The expression of a node that shares texels with another one, or nothing.
  std::string shared(int id, int indent) {
    for (Shared& s : shared_) {
      const auto unless_refused = [&](const std::string& own, const std::string& read) {
        return "(" + value(s.nodes.refused) + " ? vec4(" + own + ") : " + read + ")";
      };
      if (id == s.nodes.nearest) {
        const Node& node = at(id);
        s.quad = fresh('q'), s.texels = fresh('q');
        needs_.nearest_of = true;
        needs_.lookups.insert({NodeOp::kRead, node.what});
        line(indent, "const vec4 " + s.quad + " = limpid_quad(vec2(" + value(node.args[0]) + ", " +
                         value(node.args[1]) + "));");
        line(indent, "const vec4 " + s.texels + " = " + read(node.what, s.quad) + ";");
        return "limpid_nearest_of(" + s.texels + ", " + s.quad + ")";
      }
      if (s.quad.empty()) continue;
      if (id == s.nodes.quad) return unless_refused("0.0", s.quad);
      if (id == s.nodes.read) return unless_refused(own(at(id).what), s.texels);
    }
    return "";
  }
  static std::string read(int plane, const std::string& quad) {
    const auto id = static_cast<PlaneId>(plane);
    return "limpid_read_" + role_word(id) + "_" + channel_letter(id) + "(" + quad + ")";
  }
  static std::string own(int plane) {
    const auto id = static_cast<PlaneId>(plane);
    return "limpid_texel_" + role_word(id) + "(limpid_pixel)." + channel_letter(id);
  }

  /// Whether the first parenthesis closes at the end of the text.
  static bool is_one(const std::string& words) {
    int depth = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      depth += words[i] == '(' ? 1 : words[i] == ')' ? -1 : 0;
      if (depth == 0) return i + 1 == words.size();
    }
    return false;
  }

  const Flow& flow_at(int index) const { return r_.flows[static_cast<std::size_t>(index)]; }

  std::vector<Flow::Merge> live_merges(const Flow& flow) const {
    std::vector<Flow::Merge> merges;
    for (const Flow::Merge& m : flow.merges) {
      if (r_.live[static_cast<std::size_t>(m.merged)]) merges.push_back(m);
    }
    return merges;
  }

  std::string declare(const Flow::Merge& m) {
    names_[m.merged] = fresh('v');
    return std::string(type_word(at(m.merged).type)) + " " + names_[m.merged];
  }

  /// The first of these statements.
  void flow(std::span<const Statement> rest, int indent) {
    const Flow& flow = flow_at(rest[0].what);
    if (!r_.is_live(flow) || printed_[static_cast<std::size_t>(rest[0].what)]) return;
    flow.loops ? loop(flow, indent) : ifs(rest, indent);
  }

  /// An if, and those behind it that have its condition, if nothing between them needs what the
  /// first ones change: more lookups are on their way together, and each number that they share
  /// lives for a shorter time.
  void ifs(std::span<const Statement> rest, int indent) {
    const int condition = flow_at(rest[0].what).condition;
    std::vector<Statement> all{rest[0]};
    std::string title;
    std::vector<std::string> titles{""};
    Known known;
    std::size_t last = 0;
    for (std::size_t i = 1; i < rest.size(); ++i) {
      const Statement& s = rest[i];
      if (s.kind == Statement::Kind::kTitle) title = r_.titles[static_cast<std::size_t>(s.what)];
      if (s.kind == Statement::Kind::kNode && r_.live[static_cast<std::size_t>(s.what)] &&
          !is_at_hand(s.what, known)) {
        break;
      }
      if (s.kind != Statement::Kind::kFlow || !r_.is_live(flow_at(s.what))) continue;
      if (flow_at(s.what).loops || flow_at(s.what).condition != condition) break;
      all.push_back(s);
      titles.push_back(std::exchange(title, {}));
      last = i;
    }
    for (std::size_t i = 1; i < last; ++i) {
      if (rest[i].kind == Statement::Kind::kNode) node(rest.subspan(i), indent);
    }
    std::unordered_map<int, int> begins;  // the number of each merge where nothing changes it
    std::vector<std::string> otherwise;
    for (const Statement& s : all) {
      for (const Flow::Merge& m : live_merges(flow_at(s.what))) {
        const auto earlier = begins.find(m.before);
        const int before = earlier == begins.end() ? m.before : earlier->second;
        begins[m.merged] = before;
        const std::string begin = before < 0 ? "" : " = " + value(before);
        const std::string declared = declare(m);
        if (is_otherwise(before)) otherwise.push_back(names_[m.merged] + begin);
        line(indent, declared + (is_otherwise(before) ? "" : begin) + ";");
      }
    }
    line(indent, "if (" + bare(value(condition)) + ") {");
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Flow& flow = flow_at(all[k].what);
      if (!titles[k].empty()) title_ = titles[k];
      block(flow.block, indent + 1);
      leave(live_merges(flow), indent + 1);
      printed_[static_cast<std::size_t>(all[k].what)] = true;
    }
    if (!otherwise.empty()) line(indent, "} else {");
    for (const std::string& set : otherwise) line(indent + 1, set + ";");
    line(indent, "}");
  }

  /// Names of the results of a lookup, of this step of a loop and of the next ones.
  using Texels = std::array<std::string, LookAhead::kSteps>;

  /// At the begin of the loop's block; `i` is the index.
  void look_ahead(const Flow& flow, const LookAhead& ahead, const std::vector<Texels>& results,
                  const std::string& i, int indent) {
    constexpr std::size_t kAhead = LookAhead::kSteps;
    line(indent, "if ((" + i + " - " + std::to_string(flow.begin) + ") % " +
                     std::to_string(kAhead) + " == 0) {");
    const std::string index = names_.at(flow.index);
    for (std::size_t k = 0; k < kAhead; ++k) {
      if (k > 0) names_[flow.index] = "(" + index + " + " + std::to_string(k) + ".0)";
      for (const int id : ahead.places) define_once(id, indent + 1);
      for (std::size_t l = 0; l < ahead.lookups.size(); ++l) {
        line(indent + 1, results[l][k] + " = " + expression(ahead.lookups[l]) + ";");
      }
      for (const int id : ahead.places) {  // the next step has its own
        names_.erase(id);
        defined_[static_cast<std::size_t>(id)] = false;
      }
    }
    line(indent, "} else {");
    for (const Texels& texels : results) {
      for (std::size_t k = 1; k < kAhead; ++k)
        line(indent + 1, texels[k - 1] + " = " + texels[k] + ";");
    }
    line(indent, "}");
    names_[flow.index] = index;
    // Nodes that only these lookups need are not written again.
    std::unordered_map<int, int> gone;
    const auto leave_out = [&](int id) {
      defined_[static_cast<std::size_t>(id)] = true;
      for (const int arg : at(id).args) ++gone[arg];
    };
    for (std::size_t l = 0; l < ahead.lookups.size(); ++l) {
      names_[ahead.lookups[l]] = results[l][0];
      leave_out(ahead.lookups[l]);
    }
    for (std::size_t p = ahead.places.size(); p-- > 0;) {
      const auto id = static_cast<std::size_t>(ahead.places[p]);
      if (!pinned_[id] && uses_[id] == gone[ahead.places[p]]) leave_out(ahead.places[p]);
    }
  }

  void loop(const Flow& flow, int indent) {
    const std::vector<Flow::Merge> merges = live_merges(flow);
    for (const Flow::Merge& m : merges) {
      const std::string begin = m.before < 0 ? "" : " = " + value(m.before);
      line(indent, declare(m) + begin + ";");
    }
    const LookAhead ahead(r_, flow, [&](int id) { return is_of_frame(id) || is_idle(id); });
    std::vector<Texels> results;
    for (const int id : ahead.lookups) {
      std::string words = type_word(at(id).type);
      for (std::string& texel : results.emplace_back()) {
        texel = fresh('a');
        words += (words.find(' ') == std::string::npos ? " " : ", ") + texel;
      }
      line(indent, words + ";");
    }
    // Counted in float, too: devices convert slowly.
    const std::string i = fresh('i'), real = names_[flow.index] = fresh('f');
    line(indent, "float " + real + " = " + std::to_string(flow.begin) + ".0;");
    needs_.loops = true;
    // Unrolled, a march's lookups overflow a device's instruction cache and registers.
    line(indent, "[[dont_unroll]] for (int " + i + " = " + std::to_string(flow.begin) + "; " + i +
                     " < " + std::to_string(flow.end) + "; ++" + i + ", " + real + " += 1.0) {");
    if (!ahead.lookups.empty()) look_ahead(flow, ahead, results, i, indent + 1);
    block(flow.block, indent + 1);
    std::string goes_on;
    if (flow.condition >= 0) {
      goes_on = fresh('g');
      line(indent + 1, "const bool " + goes_on + " = " + bare(value(flow.condition)) + ";");
    }
    leave(merges, indent + 1);
    if (flow.condition >= 0) line(indent + 1, "if (!" + goes_on + ") break;");
    line(indent, "}");
  }

  static std::string bare(const std::string& words) {
    return words.front() == '(' && is_one(words) ? words.substr(1, words.size() - 2) : words;
  }

  /// All at once, because one value may be the source of another.
  void leave(const std::vector<Flow::Merge>& merges, int indent) {
    std::vector<std::string> sets;
    for (const Flow::Merge& m : merges) {
      if (m.after == m.merged) continue;
      std::string from = value(m.after);
      for (const Flow::Merge& other : merges) {
        if (other.merged != m.after) continue;
        const std::string held = fresh('h');
        line(indent, std::string("const ") + type_word(at(m.merged).type) + " " + held + " = " +
                         from + ";");
        from = held;
        break;
      }
      sets.push_back(names_.at(m.merged) + " = " + from + ";");
    }
    for (const std::string& set : sets) line(indent, set);
  }

  const Recording& r_;
  std::string& text_;
  GlslNeeds& needs_;
  std::vector<double>& frame_numbers_;
  std::vector<std::optional<double>> of_frame_;
  std::vector<int> uses_;
  std::vector<bool> pinned_;
  std::vector<int> chosen_;  ///< how often an if leaves it as it is
  std::vector<bool> defined_;
  std::vector<bool> printed_;  ///< of the flows
  std::vector<Shared> shared_;
  std::unordered_map<int, std::string> names_;
  std::string title_;
  int next_ = 0;
};

}  // namespace

GlslBody::GlslBody(const Recording& recording, bool computes_frame) {
  Printer printer(recording, computes_frame, text_, needs_, frame_numbers_);
  printer.block(0, 1);
  for (const Output& output : recording.outputs) outputs_.push_back(printer.value(output.node));
}

}  // namespace limpid
