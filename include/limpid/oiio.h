#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include <OpenImageIO/imagebuf.h>

#include "limpid/compositor.h"
#include "limpid/core/error.h"

/// @file
/// Adapter for pictures of OpenImageIO, without copies. A buffer must own its pixels or wrap memory
/// of the application, and be flat, of float or half; it may have any strides and channels.
/// Channels are named by index or by name, as in "R" or "ViewLayer.Depth.Z". The data window of the
/// buffer becomes that of the views, its display window that of the frame, in the same coordinates.
/// Other buffers are refused by an Error such as `ImageBuf 'a.png': pixels of uint8, expected ...`.
/// Views own no memory: the buffer must outlive them with the same pixels.

namespace limpid {

/// Throws Error unless the pixels can be read without a copy.
inline void validate(const OIIO::ImageBuf& buf) {
  std::string fault;
  if (buf.deep() || buf.spec().depth > 1) {
    fault = "it is deep or a volume, expected a flat picture";
  } else if (!buf.localpixels()) {
    fault = "it has no pixels in memory, expected read(0, 0, true) before";
  } else if (buf.pixeltype() != OIIO::TypeFloat && buf.pixeltype() != OIIO::TypeHalf) {
    fault = std::string("pixels of ") + buf.pixeltype().c_str() +
            ", expected float or half, scene-linear";
  }
  if (!fault.empty()) throw Error("ImageBuf '" + std::string(buf.name()) + "': " + fault);
}

/// The window of the pixels.
inline Rect window_of(const OIIO::ImageBuf& buf) {
  return {buf.xbegin(), buf.ybegin(), buf.xend(), buf.yend()};
}

/// The display window: HostFrame::display.
inline Rect display_of(const OIIO::ImageBuf& buf) {
  const OIIO::ROI full = buf.roi_full();
  return {full.xbegin, full.ybegin, full.xend, full.yend};
}

/// The index of a channel. Throws Error with the names of all channels for an unknown name.
inline int channel_named(const OIIO::ImageBuf& buf, const std::string& name) {
  const int channel = buf.spec().channelindex(name);
  if (channel < 0) {
    throw Error("ImageBuf '" + std::string(buf.name()) + "': has no channel " + name + "; it has " +
                join(buf.spec().channelnames));
  }
  return channel;
}

/// A channel for reading or, if the buffer is not const, for writing. Throws Error as validate()
/// does, and for a missing channel.
inline HostInput channel_of(const OIIO::ImageBuf& buf, int channel) {
  validate(buf);
  if (channel < 0 || channel >= buf.nchannels()) {
    throw Error("ImageBuf '" + std::string(buf.name()) + "': has no channel " +
                std::to_string(channel) + ", expected 0 ... " +
                std::to_string(buf.nchannels() - 1));
  }
  return {static_cast<const std::byte*>(buf.localpixels()) + channel * buf.pixeltype().size(),
          buf.pixeltype() == OIIO::TypeHalf ? Sample::kHalf : Sample::kFloat, buf.pixel_stride(),
          buf.scanline_stride(), window_of(buf)};
}
inline HostOutput channel_of(OIIO::ImageBuf& buf, int channel) {
  const HostInput view = channel_of(std::as_const(buf), channel);
  return {const_cast<void*>(view.data), view.sample, view.x_stride, view.y_stride, view.window};
}

/// Uses a channel as a plane of the frame, as in set_plane(frame, PlaneId::kDepth, buf, "Z").
inline void set_plane(HostFrame& frame, PlaneId id, const OIIO::ImageBuf& buf, int channel) {
  frame.plane(id) = channel_of(buf, channel);
}
inline void set_plane(HostFrame& frame, PlaneId id, const OIIO::ImageBuf& buf,
                      const std::string& name) {
  set_plane(frame, id, buf, channel_named(buf, name));
}

/// Three planes from `red` on: R, G and B of a layer, as in set_colors(frame,
/// PlaneId::kReflectionR, buf, "mirrored.").
inline void set_colors(HostFrame& frame, PlaneId red, const OIIO::ImageBuf& buf,
                       const std::string& layer = {}) {
  for (int c = 0; c < 3; ++c) set_plane(frame, plane_after(red, c), buf, layer + "RGB"[c]);
}

/// Sets the dry picture: R, G, B of a layer, and its A, if any, by which the colors must be
/// multiplied.
inline void set_color(HostFrame& frame, const OIIO::ImageBuf& buf, const std::string& layer = {}) {
  set_colors(frame, PlaneId::kColorR, buf, layer);
  const int alpha = buf.spec().channelindex(layer + "A");
  frame.plane(PlaneId::kColorA) = alpha >= 0 ? channel_of(buf, alpha) : HostInput{};
}

/// R, G, B of a layer, and A if there is one, as the destination of the wet picture.
inline HostPicture picture_of(OIIO::ImageBuf& buf, const std::string& layer = {}) {
  HostPicture picture;
  for (int c = 0; c < 3; ++c) {
    picture.color[c] = channel_of(buf, channel_named(buf, layer + "RGB"[c]));
  }
  const int alpha = buf.spec().channelindex(layer + "A");
  if (alpha >= 0) picture.alpha = channel_of(buf, alpha);
  return picture;
}

/// R, G, B of a layer as a tiling map or an environment. Throws Error unless they are floats with
/// strides of whole floats.
inline Texture texture_of(const OIIO::ImageBuf& buf, const std::string& layer = {}) {
  Texture texture;
  for (int c = 0; c < 3; ++c) {
    const HostInput channel = channel_of(buf, channel_named(buf, layer + "RGB"[c]));
    if (!is_floats(channel)) {
      throw Error("texture of ImageBuf '" + std::string(buf.name()) + "': expected aligned float");
    }
    texture.channels[c] = floats_of(channel);
    texture.channels[c].window = rect_of(channel.window.size());
  }
  return texture;
}

}  // namespace limpid
