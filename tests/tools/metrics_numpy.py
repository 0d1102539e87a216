#!/usr/bin/env python3
"""SSIM, FLIP and HDR-FLIP in numpy float64: a second implementation, which checks limpid's.

Written from the papers only, never from the C++ code, and as plainly as possible: with whole
two-dimensional kernels where the C++ code has separable ones, one picture at a time.

    metrics_numpy.py fixture OUT.bin     two synthetic pictures and their expected maps
    metrics_numpy.py facts               numbers that the tests have as constants

SSIM: Wang, Bovik, Sheikh & Simoncelli 2004 "Image Quality Assessment: From Error Visibility to
Structural Similarity". FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom & Fairchild 2020
"FLIP: A Difference Evaluator for Alternating Images". HDR-FLIP: Andersson, Nilsson, Shirley &
Akenine-Moller 2021 "Visualizing Errors in Rendered High Dynamic Range Images".

The fixture is little-endian: the magic text "limpid-m", int32 width and height, float64 exposures
start and stop, int32 their number; then float32 planes, rows from the top: RGB of A and of B; then
the maps SSIM, FLIP, HDR-FLIP.
"""
import struct
import sys

import numpy as np

PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * np.pi / 180

RGB_TO_XYZ = np.array([[10135552, 8788810, 4435075],
                       [2613072 * 2, 8788810 * 2, 887015 * 2],
                       [1425312 / 3, 8788810 / 3, 70074185 / 3]]) / 24577794
WHITE = RGB_TO_XYZ @ np.ones(3)


def convolved(image, kernel):
    """Correlation with a whole kernel; the edge of the picture is repeated."""
    radius = kernel.shape[0] // 2
    padded = np.pad(image, radius, mode="edge")
    out = np.zeros_like(image)
    for y in range(kernel.shape[0]):
        for x in range(kernel.shape[1]):
            out += kernel[y, x] * padded[y:y + image.shape[0], x:x + image.shape[1]]
    return out


def grid(radius):
    return np.meshgrid(np.arange(-radius, radius + 1.0), np.arange(-radius, radius + 1.0))


# --- SSIM ---------------------------------------------------------------------------------------


def srgb_of(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def ssim_map(a, b):
    """SSIM of two planes with the peak value 1."""
    x, y = grid(5)
    window = np.exp(-(x * x + y * y) / (2 * 1.5**2))
    window /= window.sum()
    mean_a, mean_b = convolved(a, window), convolved(b, window)
    var_a = convolved(a * a, window) - mean_a**2
    var_b = convolved(b * b, window) - mean_b**2
    cov = convolved(a * b, window) - mean_a * mean_b
    c1, c2 = 0.01**2, 0.03**2
    return ((2 * mean_a * mean_b + c1) * (2 * cov + c2) /
            ((mean_a**2 + mean_b**2 + c1) * (var_a + var_b + c2)))


def luminance(rgb):
    return rgb @ np.array([0.2126, 0.7152, 0.0722])


# --- FLIP ---------------------------------------------------------------------------------------


def ycxcz_of(rgb):
    x, y, z = np.moveaxis(rgb @ RGB_TO_XYZ.T / WHITE, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def rgb_of_ycxcz(opponent):
    y = (opponent[..., 0] + 16) / 116
    x = y + opponent[..., 1] / 500
    z = y - opponent[..., 2] / 200
    return (np.stack([x, y, z], -1) * WHITE) @ np.linalg.inv(RGB_TO_XYZ).T


def hunt_lab_of(rgb):
    def f(t):
        d = 6 / 29
        return np.where(t > d**3, np.cbrt(t), t / (3 * d * d) + 4 / 29)

    x, y, z = np.moveaxis(f(rgb @ RGB_TO_XYZ.T / WHITE), -1, 0)
    lightness = 116 * y - 16
    return np.stack([lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)],
                    -1)


def hyab(a, b):
    d = a - b
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


CONTRAST = [((1, 0.0047), (0, 1e-5)), ((1, 0.0053), (0, 1e-5)), ((34.1, 0.04), (13.5, 0.025))]


def seen(opponent, ppd):
    """The picture filtered by the contrast sensitivity of a standard observer."""
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * ppd))
    x, y = grid(radius)
    squared = (x * x + y * y) / ppd**2
    out = np.empty_like(opponent)
    for channel, gaussians in enumerate(CONTRAST):
        kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * squared / b) for a, b in gaussians)
        out[..., channel] = convolved(opponent[..., channel], kernel / kernel.sum())
    return np.clip(rgb_of_ycxcz(out), 0, 1)


def features(opponent, ppd):
    """The strength of edges and of points at each pixel."""
    gray = (opponent[..., 0] + 16) / 116
    sigma = 0.5 * 0.082 * ppd
    x, y = grid(int(np.ceil(3 * sigma)))
    bell = np.exp(-(x * x + y * y) / (2 * sigma**2))

    def strength(across):
        across = np.where(across > 0, across / across[across > 0].sum(),
                          across / -across[across < 0].sum())
        return np.hypot(convolved(gray, across), convolved(gray, across.T))

    return strength(-x * bell), strength((x * x / sigma**2 - 1) * bell)


def redistributed(error):
    most = hyab(hunt_lab_of(np.array([0.0, 1, 0])), hunt_lab_of(np.array([0.0, 0, 1])))**0.7
    knee = 0.4 * most
    error = error**0.7
    return np.where(error < knee, 0.95 / knee * error,
                    0.95 + (error - knee) / (most - knee) * 0.05)


def flip_map(a, b, ppd=PIXELS_PER_DEGREE):
    """The FLIP of two linear pictures, 0 ... 1."""
    a, b = ycxcz_of(np.clip(a, 0, 1)), ycxcz_of(np.clip(b, 0, 1))
    color = redistributed(hyab(hunt_lab_of(seen(a, ppd)), hunt_lab_of(seen(b, ppd))))
    edge, point = (np.abs(u - v) for u, v in zip(features(a, ppd), features(b, ppd)))
    feature = np.sqrt(np.maximum(edge, point) / np.sqrt(2))
    return color**(1 - feature)


# --- HDR-FLIP -----------------------------------------------------------------------------------

# Narkowicz 2015 "ACES Filmic Tone Mapping Curve", at 0.6 x.
TONE = (0.6 * 0.6 * 2.51, 0.6 * 0.03, 0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14)


def toned(x):
    k = TONE
    return np.clip((k[0] * x * x + k[1] * x + k[2]) / (k[3] * x * x + k[4] * x + k[5]), 0, 1)


def exposures_of(reference):
    k, t = TONE, 0.85
    brightest = np.roots([k[0] - t * k[3], k[1] - t * k[4], k[2] - t * k[5]]).max()
    y = luminance(reference)
    start, stop = np.log2(brightest / y.max()), np.log2(brightest / np.median(y))
    return start, stop, max(2, int(np.ceil(stop - start)))


def hdr_flip_map(a, b, ppd=PIXELS_PER_DEGREE):
    """The HDR-FLIP of two linear pictures without negative values; b is the reference."""
    start, stop, count = exposures_of(b)
    return np.max([flip_map(toned(2**e * a), toned(2**e * b), ppd)
                   for e in np.linspace(start, stop, count)], axis=0)


# --- the fixture of the tests -------------------------------------------------------------------


def made_pictures(width, height):
    """A bright window in a dim room, with lines and points; A is B with many kinds of errors."""
    rng = np.random.default_rng(6)
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    b = np.stack([0.05 + 0.3 * x, 0.08 + 0.2 * y, 0.2 - 0.1 * x * y], -1)
    b[4:14, 5:16] = (6, 9, 14)
    b[18:20, :] = (0.4, 0.05, 0.02)
    b[:, 26] = (0.01, 0.3, 0.5)
    b[22:30:3, 4:24:4] = 40
    b *= rng.uniform(0.9, 1.1, b.shape)
    a = b.copy()
    a[:16, 20:] = np.roll(b, 2, axis=1)[:16, 20:]
    a[21:, :14] *= 1.3
    a[4:8, 5:16] *= (1.5, 1, 0.7)
    a[20:, 14:] += rng.normal(0, 0.03, a[20:, 14:].shape)
    return np.maximum(a, 0).astype("<f4"), b.astype("<f4")


def write_fixture(path):
    width, height = 36, 32
    a, b = made_pictures(width, height)
    wide_a, wide_b = a.astype(float), b.astype(float)
    start, stop, count = exposures_of(wide_b)
    maps = [ssim_map(srgb_of(luminance(wide_a)), srgb_of(luminance(wide_b))),
            flip_map(wide_a, wide_b), hdr_flip_map(wide_a, wide_b)]
    with open(path, "wb") as out:
        out.write(b"limpid-m" + struct.pack("<iiddi", width, height, start, stop, count))
        for plane in [*np.moveaxis(a, -1, 0), *np.moveaxis(b, -1, 0), *maps]:
            out.write(np.ascontiguousarray(plane, "<f4").tobytes())
    print("means", [m.mean() for m in maps], "exposures", start, stop, count)


def print_facts():
    colors = {"black": (0, 0, 0), "white": (1, 1, 1), "red": (1, 0, 0), "green": (0, 1, 0),
              "blue": (0, 0, 1), "gray .5": (.5, .5, .5), "gray .18": (.18, .18, .18)}
    labs = {name: hunt_lab_of(np.array(c, float)) for name, c in colors.items()}
    print("pixels a degree", PIXELS_PER_DEGREE)
    print("largest color error", hyab(labs["green"], labs["blue"])**0.7)
    for p, q in [("black", "white"), ("green", "blue"), ("red", "green"), ("gray .5", "gray .18"),
                 ("black", "blue")]:
        print("FLIP of uniform", p, "and", q, float(redistributed(hyab(labs[p], labs[q]))))


if __name__ == "__main__":
    if sys.argv[1:2] == ["fixture"]:
        write_fixture(sys.argv[2])
    elif sys.argv[1:2] == ["facts"]:
        print_facts()
    else:
        sys.exit(__doc__)
