#pragma once
#include <string>
#include <string_view>

#include "desk/desk.h"

/// Requests and answers between a page and a desk, as JSON.

namespace limpid {

/// The data for the start of a page: plate, looks with their values, operators with their fields,
/// and what can be shown.
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

/// The size of the JSON as four bytes, the lowest first; the JSON; then the pixels.
std::string picture_bytes(const DeskPicture& picture);
/// Numbers that are not finite are null.
std::string pixel_json(const PixelRequest& request, const PixelNumbers& numbers);
/// {"key": "text"}
std::string text_json(const std::string& key, const std::string& text);

}  // namespace limpid
