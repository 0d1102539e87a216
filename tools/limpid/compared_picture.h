#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limpid/core/color_space.h"
#include "limpid/files/limits.h"

#include "judge/compare/color_pair.h"
#include "judge/compare/compare.h"

/// Pictures as `compare` reads them.

namespace limpid::tool {

struct ComparedPicture {
  std::string path;
  Size display;  ///< of the display window
  std::vector<std::string> names;
  std::vector<Plane> planes;  ///< one per name, with the data window

  /// Null for an unknown name.
  const Plane* find(const std::string& name) const;
};

/// Red, green and blue of a picture, scene-linear.
struct PictureColor {
  Size display;  ///< of the display window
  std::array<Plane, 3> planes;
};

/// A channel of one picture, and the channel of the other to compare with.
struct ChannelPair {
  std::string a, b;
  friend bool operator==(const ChannelPair&, const ChannelPair&) = default;
};

/// The channel names of read_picture(): for an EXR of several flat parts those of all parts, from
/// the second on with the part's name in front, as in "right.R". Throws Error as read_picture().
std::vector<std::string> channel_names(const std::string& path, const Limits& limits);

/// Parses --channels: each text is a channel or layer of both pictures (all the layer's channels),
/// or `A=B` with one of each. Each pair once, in order. Throws Error that lists the existing names
/// for an unknown name, and for layers with different components.
std::vector<ChannelPair> pairs_of(const std::vector<std::string>& texts, const std::string& a,
                                  const std::vector<std::string>& known_a, const std::string& b,
                                  const std::vector<std::string>& known_b);

/// Reads the channels of an EXR, or of another format, that `wanted` names; all channels of the
/// first part if it is empty. Throws Error for unknown channels.
ComparedPicture read_picture(const std::string& path, const std::vector<std::string>& wanted,
                             const Limits& limits);

/// Whether the file is an EXR with such a channel in its first part.
bool has_channel(const std::string& path, const std::string& name);

/// The channels of both, in the order of `a`. Throws Error if their names differ.
std::vector<ComparedChannel> channels_of(const ComparedPicture& a, const ComparedPicture& b);
/// The channels of the pairs, which must have been read. A pair of different names is called "A=B".
std::vector<ComparedChannel> channels_of(const ComparedPicture& a, const ComparedPicture& b,
                                         const std::vector<ChannelPair>& pairs);

/// Whether the colors of a picture are linear (EXR, HDR, PFM), not encoded as sRGB.
bool is_linear(const std::string& path);

/// The color space of a picture: Rec.709 if it is encoded as sRGB, else `named`, else that of its
/// file, else `untold`. Throws Error for chromaticities that are none.
Primaries primaries_of(const std::string& path, const std::optional<Primaries>& named,
                       const Primaries& untold = kRec709);

/// The colors of a picture as the metrics of color want them: scene-linear, larger values than
/// `clip` counted as that. EXR, HDR and PFM are taken to be linear, other formats to be encoded as
/// sRGB.
class LinearColor {
 public:
  /// Of primaries `to`, the picture's being `from`. Throws Error where there are no channels R, G
  /// and B, be it of one layer.
  LinearColor(const ComparedPicture& picture, const std::optional<double>& clip,
              const Primaries& from, const Primaries& to = kRec709);

  ColorViews views() const { return {planes_[0].view(), planes_[1].view(), planes_[2].view()}; }
  std::array<Plane, 3> take() && { return std::move(planes_); }

 private:
  std::array<Plane, 3> planes_;
};

/// The colors of the picture alone are read, and made those of primaries `to`, of which a linear
/// one is that does not say. Throws Error as LinearColor.
PictureColor read_color(const std::string& path, const Primaries& to, const Limits& limits);

}  // namespace limpid::tool
