#!/usr/bin/env python3
"""Puts water into a sequence of plates: OpenImageIO reads and writes, limpid does the rest.

    python3 sequence.py data/plates/lagoon/lagoon.toml --frames 1-24 --look realistic -o wet.%04d.exr

The scene file is one of limpid's, whose camera has view and projection. Names of its plates may hold
the frame's number, as in dry.%04d.exr.
"""
import argparse
import pathlib
import tomllib

import OpenImageIO as oiio

import limpid

CHANNELS = {role["name"]: role["channels"] for role in limpid.roles()}


def read(name, role):
    """The role's channels in the type of the file, half or float, and the file's metadata."""
    path, _, channel = str(name).partition(":")
    picture = oiio.ImageInput.open(path)
    if picture is None:
        raise SystemExit(oiio.geterror())
    spec = picture.spec()
    first = spec.channelindex(channel) if channel else 0
    if first < 0:
        raise SystemExit(f"{path}: no channel {channel}, expected one of {', '.join(spec.channelnames)}")
    pixels = picture.read_image(0, 0, first, min(first + CHANNELS[role], spec.nchannels), spec.format)
    if pixels is None:
        raise SystemExit(picture.geterror())
    return pixels, spec


def read_map(path):
    """R G B as float, from any format."""
    picture = oiio.ImageBuf(str(path))
    if not picture.read(convert=oiio.FLOAT):
        raise SystemExit(picture.geterror())
    return picture.get_pixels(oiio.FLOAT)[..., :3]


def write(path, wet):
    height, width, channels = wet.shape
    spec = oiio.ImageSpec(width, height, channels, oiio.HALF)
    spec.attribute("compression", "zip")
    picture = oiio.ImageOutput.create(path)
    if not (picture and picture.open(path, spec) and picture.write_image(wet) and picture.close()):
        raise SystemExit(picture.geterror() if picture else oiio.geterror())


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("scene", type=pathlib.Path, help="scene file (*.toml)")
    parser.add_argument("--frames", default="1-1", metavar="FIRST-LAST")
    parser.add_argument("--fps", type=float, default=24)
    parser.add_argument("--look", default="physical", help="name, or look file")
    parser.add_argument("-o", "--output", required=True, help="wet.%%04d.exr")
    arguments = parser.parse_args()
    first, last = map(int, arguments.frames.split("-"))

    scene = tomllib.loads(arguments.scene.read_text())
    camera, look = scene["camera"], limpid.load_look(arguments.look)
    plates = {role: arguments.scene.parent / name for role, name in scene["plates"].items()}
    environment = plates.pop("environment", None)
    wave_map = look["wave_normals"]["map"]
    compositor = limpid.Compositor(  # once: its threads and its memory serve all frames
        look=look, clip=camera.get("clip", "gl"), depth_kind=camera.get("depth", "eye"),
        near=camera.get("near", 0.0), far=camera.get("far", 0.0),
        wave_map=read_map(wave_map) if wave_map else None,
        environment=read_map(environment) if environment else None)

    wet = None  # made by the first frame, used by all
    for frame in range(first, last + 1):
        planes = {}
        for role, name in plates.items():
            planes[role], spec = read(str(name).replace("%04d", f"{frame:04d}"), role)
            if role == "color":  # what lies beyond the display window is overscan
                x, y = spec.full_x - spec.x, spec.full_y - spec.y
                display = (x, y, x + spec.full_width, y + spec.full_height)
        wet = compositor.run(**planes, display=display, out=wet, water=scene.get("water", {}),
                             camera=limpid.Camera(camera["view"], camera["projection"]), sun=scene.get("sun"),
                             time=scene.get("scene", {}).get("time", 0.0) + frame / arguments.fps)
        write(arguments.output.replace("%04d", f"{frame:04d}"), wet)
    print(compositor.plan)


if __name__ == "__main__":
    main()
