"""A sandy lagoon: beach in front, hills behind; rocks, an old jetty and a crate stand in it."""
import numpy as np

from . import shapes, textures
from .gltf import Scene, turned

AMBIENT = [0.28, 0.33, 0.42]


def ground(x, z):
    """Height of the sand: a bay that opens to the right, with a far shore."""
    shore = -1.5 + 0.12 * x + 0.9 * np.sin(0.33 * x + 0.6)
    out = shore - z  # metres from the near waterline
    near = np.where(out > 0, -0.16 * out - 0.012 * out**2, -0.12 * out - 0.01 * out**2)
    near = np.maximum(near, -3.0)
    far = 0.16 * (-z - 30 - 0.30 * x + 2.5 * np.sin(0.21 * x))
    side = 0.22 * (-x - 17 + 1.5 * np.sin(0.4 * z)) + 0.0 * z
    right = 0.14 * (x - 25 + 2 * np.sin(0.3 * z))
    rise = np.maximum(np.maximum(far, side), right)
    rise = np.where(rise > 0, np.minimum(rise * 2.2, 1.2 + 0.55 * rise), rise)
    height = np.maximum(near, rise)
    ripples = 0.03 * np.sin(2.1 * x + 0.7 * z) * np.sin(1.3 * z - 0.4 * x)
    return height + ripples + 0.10 * np.sin(0.55 * x + 1) * np.sin(0.43 * z)


def palm(height, lean, seed):
    """Trunk and fronds, at the origin."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, 8)
    path = np.stack([lean * t**1.7, height * t, 0.15 * np.sin(3 * t)], 1)
    trunk = shapes.tube(path, 0.16 - 0.08 * t, 8, 0.6)
    fronds = []
    for i in range(11):
        angle = 2 * np.pi * (i + 0.3 * rng.uniform(-1, 1)) / 11
        length, lift = rng.uniform(1.7, 2.3), rng.uniform(0.5, 1.0)
        s = np.linspace(0, 1, 8)
        reach, drop = length * s, lift * s - 1.9 * s**2
        width = 0.34 * np.maximum(np.sin(np.pi * (0.12 + 0.88 * s)), 0.01)**0.7
        out = np.array([np.cos(angle), 0, np.sin(angle)])
        side = np.array([-out[2], 0, out[0]])
        spine = path[-1] + reach[:, None] * out + drop[:, None] * [0, 1, 0]
        droop = width[:, None] * [0, -0.55, 0]
        rows = np.stack([spine - width[:, None] * side + droop, spine,
                         spine + width[:, None] * side + droop])
        uvs = np.stack(np.broadcast_arrays(np.array([[0], [0.5], [1]]), s), -1)
        fronds.append(shapes.Shape(rows.reshape(-1, 3), shapes._grid_triangles(3, 8), None,
                                   uvs.reshape(-1, 2)).smooth())
    return trunk, shapes.merged(*fronds)


def make():
    scene = Scene("a sandy lagoon with rocks, an old jetty and palms", [0.42, 0.62, 0.88])
    sand = scene.texture("sand", textures.speckled(128, (0.80, 0.70, 0.52), (0.93, 0.86, 0.70),
                                                   0.7, 1))
    wood = scene.texture("wood", textures.planks(64, 4, (0.55, 0.42, 0.30), (0.20, 0.15, 0.10)))
    stone = scene.texture("stone", textures.speckled(64, (0.30, 0.29, 0.28), (0.58, 0.56, 0.52),
                                                     0.9, 5))
    leaf = scene.texture("leaf", textures.planks(32, 8, (0.25, 0.45, 0.16), (0.12, 0.27, 0.08), 6))
    sand = scene.material("sand", texture=sand, ambient=AMBIENT)
    wood = scene.material("wood", texture=wood, ambient=AMBIENT)
    stone = scene.material("stone", texture=stone, ambient=AMBIENT)
    leaf = scene.material("leaf", texture=leaf, double_sided=True, ambient=AMBIENT)
    bush = scene.material("bush", (0.10, 0.20, 0.06), ambient=AMBIENT)

    spread = np.linspace(-1, 1, 64)
    xs = 3 + 36 * np.sign(spread) * (0.45 * abs(spread) + 0.55 * abs(spread)**2)
    zs = 7 - 61 * np.linspace(0, 1, 70)[::-1]**1.6
    scene.node("ground", scene.mesh("ground", (shapes.height_field(xs, zs, ground, 1.7), sand)))

    rocks = [scene.mesh(f"rock {i}", (shapes.lump(2, 0.22, 10 + i, (1, 0.75, 1)), stone))
             for i in range(3)]
    for i, (x, z, size) in enumerate([
            (2.6, -3.6, 0.55), (3.5, -4.3, 0.95), (4.6, -3.9, 0.40), (1.9, -4.5, 0.28),
            (7.5, -7.5, 0.8), (-4.4, -2.2, 0.35), (-8.5, -11, 1.3), (-9.6, -9.5, 0.8),
            (12, -15, 1.6), (10.4, -16, 0.9), (-3, -19, 0.6), (5.4, -6.4, 0.3)]):
        y = max(ground(x, z), -0.75 * size) + 0.15 * size
        scene.node(f"rock at {x}, {z}", rocks[i % 3], (x, y, z), turned(67 * i), size)

    post = scene.mesh("post", (shapes.tube([(0, -2.2, 0), (0.02, 0, 0), (0, 0.95, 0)],
                                           [0.11, 0.11, 0.10], 10), wood))
    board = scene.mesh("board", (shapes.box((-0.75, -0.03, -0.12), (0.75, 0.03, 0.12), 0.9), wood))
    beam = scene.mesh("beam", (shapes.box((-0.06, -0.07, -5.4), (0.06, 0.07, 0.2), 0.9), wood))
    rng = np.random.default_rng(7)
    for k in range(5):
        for side in (-0.62, 0.62):
            at = (-3.4 + side - 0.22 * 1.35 * k, -0.1 + 0.06 * rng.normal(), -3.2 - 1.35 * k)
            scene.node(f"post {k} {side}", post, at, turned(4 * rng.normal(), (1, 0, 0.4)))
    for side in (-0.45, 0.45):
        scene.node(f"beam {side}", beam, (-3.4 + side, 0.56, -3.1), turned(12.4))
    for k in range(19):
        if k in (6, 13, 14):
            continue
        z = -3.2 - 0.285 * k
        scene.node(f"board {k}", board, (-3.4 + 0.22 * (z + 3.2), 0.66, z),
                   turned(12.4 + 3 * rng.normal()))

    crate = scene.mesh("crate", (shapes.box((-0.4, -0.4, -0.4), (0.4, 0.4, 0.4)), wood))
    scene.node("crate adrift", crate, (0.1, 0.0, -5.2), turned(24, (0.4, 1, 0.7)))
    scene.node("crate ashore", crate, (-5.2, ground(-5.2, -0.6) + 0.36, -0.6), turned(31))

    palms = [(4.6, 1.1, 21), (3.9, -0.8, 22), (5.2, 1.6, 23)]
    palms = [scene.mesh(f"palm {i}", *zip(palm(*form), (wood, leaf)))
             for i, form in enumerate(palms)]
    for i, (x, z, size) in enumerate([
            (-7.2, -0.6, 0.95), (-9.5, -2.4, 1.1), (-17.5, -13, 1.3), (-15, -31, 1.3),
            (-9, -34, 1.4), (-2, -37, 1.2), (4, -40, 1.5), (13, -43, 1.3), (21, -34, 1.2),
            (25, -27, 1.3), (9, -41.5, 1.1), (-20, -22, 1.2)]):
        scene.node(f"palm at {x}, {z}", palms[i % 3], (x, ground(x, z) - 0.1, z),
                   turned(131 * i + 40), size)
    bushes = scene.mesh("bush", (shapes.lump(1, 0.3, 31, (1, 0.7, 1)), bush))
    for i in range(46):
        x, z = rng.uniform(-26, 30), rng.uniform(-50, -16)
        if ground(x, z) > 0.9:
            scene.node(f"bush {i}", bushes, (x, ground(x, z), z), turned(50 * i),
                       rng.uniform(0.7, 1.9))

    scene.water(shapes.fan_grid(np.geomspace(1.2, 56, 66), np.linspace(-52, 52, 54), (0.4, 5.4)))
    scene.camera((0.4, 2.0, 3.9), (-0.1, 0.0, -6), 47, 0.1, 200)
    scene.sun((-0.55, 0.62, -0.36), (1, 0.93, 0.80), 1.3)
    return scene
