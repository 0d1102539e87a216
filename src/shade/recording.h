#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/frame.h"

/// @file
/// The formulas for one pixel as a program in static single assignment (Cytron et al. 1991,
/// "Efficiently Computing Static Single Assignment Form and the Control Dependence Graph"), in
/// nested blocks. Made by a Recorder; run in double by interpret.h, printed as a shader by glsl.h.

namespace limpid {

enum class NodeType : std::uint8_t { kNumber, kMask, kTwo, kThree, kFour };

enum class NodeOp : std::uint8_t {
  kLiteral,  ///< Node::number
  kGiven,    ///< index in Recording::given: Node::what
  kMerged,   ///< one of Flow::merges
  kIndex,    ///< the integer index of the loop Node::what
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kLess,
  kGreater,
  kLessOrEqual,
  kGreaterOrEqual,
  kAnd,
  kOr,
  kNot,
  kSelect,
  kMin,
  kMax,
  kAbs,
  kSqrt,
  kFloor,
  kExp,
  kSin,
  kCos,
  kAtan2,
  kPow,
  kPart,  ///< component Node::what of a vector
  // Values of the pixel. `plane` is Node::what, shifts are in uv from the pixel's centre.
  kColumn,     ///< x of the centre, in pixels from the corner of the display window
  kRow,        ///< RowValue Node::what
  kOwn,        ///< plane at the pixel itself
  kBeside,     ///< plane at the neighbour Node::number, 0 ... 8, row after row
  kNearest,    ///< plane at a shift
  kBilinear,   ///< plane at a shift
  kBilinear3,  ///< three planes at a shift
  kQuad,       ///< column and row of the upper left texel, from the pixel's, and the two weights
  kRead,       ///< plane at the four texels of a quad
  kPlace,      ///< plane, texel Node::number of a quad: the shift of its centre
  // Textures, by TextureId in Node::what.
  kTiled,        ///< three channels at periods
  kTiledWide,    ///< the same for a pixel this many texels wide
  kSlopeMean,    ///< of levels of slopes, at periods, for a pixel this many texels wide
  kSlopeSquare,  ///< xx, xy, yy of the same
  kLatLong,      ///< three channels at a place
  kGrid,         ///< one channel at texels
};

/// Whether a node of it follows from its arguments alone: computed() has how.
constexpr bool is_arithmetic(NodeOp op) { return op >= NodeOp::kAdd && op <= NodeOp::kPow; }
/// In double; masks are 1 or 0.
double computed(NodeOp op, double a, double b, double c);

/// Numbers of a picture row, made in double for each (core/water_view.h): RowRays.
enum class RowValue : std::uint8_t {
  kOriginX,
  kOriginY,
  kOriginZ,
  kRayX,
  kRayY,
  kRayZ,
  kV,
  kCalmOver,
  kCalmUnder,
};
constexpr int kRowValues = 9;

/// The textures of lookups.
enum class TextureId : std::uint8_t {
  kWaveMap,
  kWaveSlopes,
  kEnvironment,
  kEdgeColors,
  kEdgeShape,
  kContinuation,
  kBottomColors,
  kBottomShape,
  kCaustics,  ///< the first level; the others follow, each by CausticsTable::first
};

struct Node {
  NodeOp op;
  NodeType type;
  std::array<int, 3> args{-1, -1, -1};  ///< nodes
  double number = 0;
  int what = 0;
  int block = 0;  ///< the block in which it is made
};

/// An if or a loop, and the nodes that it changes.
struct Flow {
  struct Merge {
    int merged;         ///< the node of the number after it, and within a loop's block
    int before, after;  ///< nodes: the number before it, and at the end of the block
  };
  bool loops = false;
  int block = -1;
  int condition = -1;      ///< of an if; of a loop the condition to continue, or -1
  int begin = 0, end = 0;  ///< of a loop's index
  int index = -1;          ///< node
  std::vector<Merge> merges;
};

struct Statement {
  enum class Kind : std::uint8_t { kNode, kFlow, kTitle } kind;
  int what;  ///< node, flow, or index in Recording::titles
};

struct Block {
  int parent = -1;
  std::vector<Statement> statements;
};

/// A number from scene, look, frame or time.
struct GivenNumber {
  std::string name;  ///< "refraction.strength", "camera.eye_above", "waves.phase[2]"
  double value;      ///< of the recorded frame
};

/// A number that the program outputs.
struct Output {
  std::string name;  ///< "color.r", "path"
  int node;
};

struct Recording {
  std::vector<Node> nodes;
  std::vector<Flow> flows;
  std::vector<Block> blocks;  ///< [0] is the whole program
  std::vector<std::string> titles;
  std::vector<GivenNumber> given;
  std::vector<Output> outputs;
  /// For each node, whether an output needs it.
  std::vector<bool> live;

  bool is_live(const Flow& flow) const {
    for (const Flow::Merge& merge : flow.merges) {
      if (live[static_cast<std::size_t>(merge.merged)]) return true;
    }
    return false;
  }
  /// Planes that live nodes look up.
  PlaneSet planes() const;
};

/// For each node, its value where it follows from numbers of the frame alone.
std::vector<std::optional<double>> values_of_frame(const Recording& recording);

}  // namespace limpid
