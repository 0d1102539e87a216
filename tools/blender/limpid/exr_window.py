"""Writes the place of a picture in its overscan into the EXR that Blender rendered.

Blender renders a larger picture and cannot name its middle as the display window. Here the data window of the EXR
begins left of and above the display window. No pixel is decoded; only the number of the first row changes in each
block of rows."""
import os
import struct

from .words import Failure

MAGIC, SIMPLE = 20000630, 2  # of one part, scan lines, flat
LONG_NAMES = 0x400
ROWS = {0: 1, 1: 1, 2: 1, 3: 16, 4: 32, 5: 16, 6: 32, 7: 32, 8: 32, 9: 256}  # in a block, by compression


def _text(file):
    read = bytearray()
    while (byte := file.read(1)) != b"\0":
        if not byte:
            raise ValueError("it is truncated")
        read += byte
    return bytes(read)


def _numbers(file, kinds):
    size = struct.calcsize("<" + kinds)
    read = file.read(size)
    if len(read) != size:
        raise ValueError("it is truncated")
    return struct.unpack("<" + kinds, read)


def _attributes(file):
    """The offset of each attribute's value: name, offset."""
    places = {}
    while name := _text(file):
        _text(file)  # its type
        (size,) = _numbers(file, "i")
        places[name.decode("latin-1")] = file.tell()
        file.seek(size, os.SEEK_CUR)
    return places


def _place(file, overscan):
    magic, version = _numbers(file, "ii")
    if magic != MAGIC or version & ~LONG_NAMES != SIMPLE:
        raise ValueError("expected an EXR of one part with scan lines")
    places = _attributes(file)
    table = file.tell()
    file.seek(places["dataWindow"])
    x0, y0, x1, y1 = _numbers(file, "4i")
    file.seek(places["compression"])
    rows = ROWS[_numbers(file, "B")[0]]
    file.seek(table)
    blocks = _numbers(file, f"{(y1 - y0) // rows + 1}Q")
    left, top = -overscan.left, -overscan.top
    right, bottom = left + x1 - x0, top + y1 - y0
    if right - overscan.right < 0 or bottom - overscan.bottom < 0:
        raise ValueError(f"its {x1 - x0 + 1}x{y1 - y0 + 1} pixels are fewer than the overscan")
    for block in blocks:
        file.seek(block)
        (y,) = _numbers(file, "i")
        file.seek(block)
        file.write(struct.pack("<i", y - y0 + top))
    for name, window in (("dataWindow", (left, top, right, bottom)),
                         ("displayWindow", (0, 0, right - overscan.right, bottom - overscan.bottom))):
        file.seek(places[name])
        file.write(struct.pack("<4i", *window))


def place(path, overscan):
    """Makes the picture the display window of the file, from (0, 0) on, and all of its pixels the data
    window. Throws Failure, possibly after changes to the file, for an EXR of another layout than Blender's."""
    try:
        with open(path, "r+b") as file:
            _place(file, overscan)
    except (ValueError, KeyError) as fault:
        raise Failure(f"{path}: cannot be given its overscan: {fault}") from fault
