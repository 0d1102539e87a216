#pragma once
#include <string>
#include <string_view>

#include "desk/desk.h"

/// What a page says to a desk and hears of it, as JSON.

namespace limpid {

/// All that a page needs to begin with: plate, looks with their values, operators with their
/// fields, what can be shown.
std::string desk_json(Desk& desk);

/// The requests. Throw Error, which names key and expectation, for what is no JSON, for keys that
/// are unknown, missing, or hold something else.
struct NewPicture : PictureRequest {
  bool instead = false;  ///< of all that have been asked for
};
NewPicture picture_request(std::string_view json);
DeskChoice choice_request(std::string_view json);
struct PixelRequest : DeskChoice {
  int x = 0, y = 0;
};
PixelRequest pixel_request(std::string_view json);
struct SaveRequest : DeskChoice {
  std::string name;
  bool replace = false;
};
SaveRequest save_request(std::string_view json);

/// The facts as JSON after their size as four bytes, the lowest first; then the pixels.
std::string picture_bytes(const DeskPicture& picture);
/// Numbers that are not finite are null.
std::string pixel_json(const PixelRequest& request, const PixelNumbers& numbers);
/// {"key": "text"}
std::string text_json(const std::string& key, const std::string& text);

}  // namespace limpid
