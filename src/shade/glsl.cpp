#include "shade/glsl.h"

#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "limpid/core/error.h"

namespace limpid {
namespace {

const Role& role_of(PlaneId plane) {
  for (const Role& role : roles()) {
    if (role.planes().has(plane)) return role;
  }
  throw Error("a plane without a role");
}

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
  Printer(const Recording& recording, std::string& text, GlslNeeds& needs)
      : r_(recording),
        text_(text),
        needs_(needs),
        uses_(r_.nodes.size()),
        pinned_(r_.nodes.size()) {
    count_uses();
  }

  void block(int index, int indent) {
    for (const Statement& s : r_.blocks[static_cast<std::size_t>(index)].statements) {
      switch (s.kind) {
        case Statement::Kind::kTitle:
          title_ = r_.titles[static_cast<std::size_t>(s.what)];
          break;
        case Statement::Kind::kNode:
          if (r_.live[static_cast<std::size_t>(s.what)]) define(s.what, indent);
          break;
        case Statement::Kind::kFlow:
          flow(s.what, indent);
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

  /// How often each node is read, and which must have a name: those that other blocks read, and
  /// those that go from one turn of a loop, or out of a block.
  void count_uses() {
    const auto pin = [&](int id) {
      if (id >= 0) pinned_[static_cast<std::size_t>(id)] = true;
    };
    for (std::size_t i = 0; i < r_.nodes.size(); ++i) {
      if (!r_.live[i]) continue;
      for (const int arg : r_.nodes[i].args) {
        if (arg < 0) continue;
        ++uses_[static_cast<std::size_t>(arg)];
        if (at(arg).block != r_.nodes[i].block) pin(arg);
      }
    }
    for (const Flow& flow : r_.flows) {
      if (!r_.is_live(flow)) continue;
      pin(flow.condition);
      for (const Flow::Merge& m : flow.merges) pin(m.before), pin(m.after);
    }
    for (const Output& output : r_.outputs) pin(output.node);
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
        return "(" + arg(0) + " ? " + arg(1) + " : " + arg(2) + ")";
      case NodeOp::kMin:
        return call("min", node);
      case NodeOp::kMax:
        return call("max", node);
      case NodeOp::kAbs:
        return call("abs", node);
      case NodeOp::kSqrt:
        return call("sqrt", node);
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
        return of_plane("texel") + "(limpid_pixel)" + channel();
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
        return "limpid_read_" + role_word(plane) + "_" + channel_letter(plane) + "(" + arg(0) + ")";
      case NodeOp::kPlace: {
        const int k = static_cast<int>(node.number);
        return of_plane("place") + "(" + arg(0) + ", ivec2(" + std::to_string(k & 1) + ", " +
               std::to_string(k >> 1) + "))";
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

  std::string fresh(char letter) { return letter + std::to_string(next_++); }

  void define(int id, int indent) {
    const Node& node = at(id);
    if (node.op == NodeOp::kPart) return;  // its vector has a name
    std::string words = expression(id);
    if (node.op == NodeOp::kRow) {  // read where it is needed, which no dry pixel does
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
    if (words.front() == '(' && is_one(words)) words = words.substr(1, words.size() - 2);
    names_[id] = fresh('t');
    line(indent,
         std::string("const ") + type_word(node.type) + " " + names_[id] + " = " + words + ";");
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

  void flow(int index, int indent) {
    const Flow& flow = r_.flows[static_cast<std::size_t>(index)];
    if (!r_.is_live(flow)) return;
    std::vector<Flow::Merge> merges;
    for (const Flow::Merge& m : flow.merges) {
      if (r_.live[static_cast<std::size_t>(m.merged)]) merges.push_back(m);
    }
    for (const Flow::Merge& m : merges) {
      const std::string name = fresh('v');
      const std::string begins = m.before < 0 ? "" : " = " + value(m.before);
      line(indent, std::string(type_word(at(m.merged).type)) + " " + name + begins + ";");
      names_[m.merged] = name;
    }
    if (!flow.loops) {
      line(indent, "if (" + bare(value(flow.condition)) + ") {");
      block(flow.block, indent + 1);
      leave(merges, indent + 1);
      line(indent, "}");
      return;
    }
    const std::string i = fresh('i');
    names_[flow.index] = "float(" + i + ")";
    needs_.loops = true;
    // Unrolled, a march's lookups overflow a device's instruction cache and registers.
    line(indent, "[[dont_unroll]] for (int " + i + " = " + std::to_string(flow.begin) + "; " + i +
                     " < " + std::to_string(flow.end) + "; ++" + i + ") {");
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
  std::vector<int> uses_;
  std::vector<bool> pinned_;
  std::unordered_map<int, std::string> names_;
  std::string title_;
  int next_ = 0;
};

}  // namespace

GlslBody::GlslBody(const Recording& recording) {
  Printer printer(recording, text_, needs_);
  printer.block(0, 1);
  for (const Output& output : recording.outputs) outputs_.push_back(printer.value(output.node));
}

std::string glsl_name(const std::string& name) {
  std::string word;
  for (const char c : name) {
    if (c == ']') continue;
    word += c == '.' || c == '[' ? '_' : c;
  }
  return word;
}

std::string role_word(PlaneId plane) { return std::string(role_of(plane).name); }

char channel_letter(PlaneId plane) {
  return "rgba"[index_of(plane) - index_of(role_of(plane).first)];
}

}  // namespace limpid
