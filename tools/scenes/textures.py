"""Small pictures that tile, as sRGB, height x width x 3."""
import numpy as np


def noise(size, roughness, seed):
    """Tiling noise about 0 with deviation 1; the power falls with frequency^-roughness."""
    white = np.fft.fft2(np.random.default_rng(seed).normal(size=(size, size)))
    f = np.fft.fftfreq(size) * size
    frequency = np.hypot(*np.meshgrid(f, f))
    frequency[0, 0] = np.inf
    values = np.real(np.fft.ifft2(white / frequency**roughness))
    return values / values.std()


def _mixed(color, other, weight):
    weight = np.clip(weight, 0, 1)[..., None]
    return np.asarray(color) * (1 - weight) + np.asarray(other) * weight


def _stepped(picture, steps=48):
    """Fewer shades: a third of the file."""
    return np.rint(picture * steps) / steps


def speckled(size, dark, light, roughness=1.0, seed=1, contrast=0.25):
    return _stepped(_mixed(dark, light, 0.5 + contrast * noise(size, roughness, seed)))


def tiles(size, count, tile, grout, width=2, spread=0.04, seed=2):
    """count x count square tiles between lines `width` pixels wide, each of its own shade."""
    step = size // count
    shades = 1 + spread * np.random.default_rng(seed).normal(size=(count, count))
    picture = np.kron(shades, np.ones((step, step)))[..., None] * np.asarray(tile)
    line = np.arange(size) % step < width
    picture[line[:, None] | line[None, :]] = grout
    return np.clip(picture, 0, 1)


def bricks(size, rows, stone, mortar, seed=3):
    step, width = size // rows, 2 * size // rows
    y, x = np.mgrid[0:size, 0:size]
    row = y // step
    along = (x + (row % 2) * width // 2) % size
    shades = 1 + 0.1 * np.random.default_rng(seed).normal(size=(rows, rows))
    shade = shades[row, along // width] + 0.05 * noise(size, 0.8, seed + 1)
    picture = np.clip(shade, 0, 1.3)[..., None] * np.asarray(stone)
    picture[(y % step < 2) | (along % width < 2)] = mortar
    return _stepped(np.clip(picture, 0, 1))


def planks(size, count, wood, gap, seed=4):
    """Boards along x."""
    y, x = np.mgrid[0:size, 0:size]
    board = y * count // size
    rng = np.random.default_rng(seed)
    grain = noise(size, 1.0, seed)
    grain = np.repeat(grain[:, :1], size, 1) * 0.10 + 0.05 * np.roll(grain, size // 3, 1)
    shade = 1 + 0.12 * rng.normal(size=count)[board] + grain
    picture = np.clip(shade, 0, 1.5)[..., None] * np.asarray(wood)
    picture[(y * count % size) < count * 2] = gap
    return _stepped(np.clip(picture, 0, 1))


def checks(size, count, one, other):
    y, x = np.mgrid[0:size, 0:size] * count // size
    return _mixed(one, other, ((x + y) % 2).astype(float))


def stripes(size, colors):
    """Bands around a ball, from pole to pole."""
    band = np.arange(size) * len(colors) // size
    return np.tile(np.asarray(colors, float)[band][None], (size // 4, 1, 1))
