"""A murky river between banks; the shadow of a stone bridge lies on the water."""
import numpy as np

from . import shapes, textures
from .gltf import Scene, turned

AMBIENT = [0.36, 0.41, 0.48]


def middle(z):
    """Where the river runs."""
    return 0.9 * np.sin(0.13 * z + 0.3) - 0.011 * np.maximum(-z - 9, 0)**2


def ground(x, z):
    off = np.abs(x - middle(z) + 0.35 * np.sin(0.5 * z)) - 5.2
    bank = np.where(off < 0, np.maximum(0.34 * off, -1.6), 1.35 * (1 - np.exp(-0.75 * off)))
    return bank + 0.03 * np.maximum(off, 0) + 0.08 * np.sin(0.8 * x) * np.sin(0.7 * z)


def bridge():
    """Three arches along x, 3 m wide; stone faces and a coping."""
    half, spans, width, pier = 11.0, (-6.4, 0.0, 6.4), 1.6, 0.8
    xs = np.unique(np.concatenate([np.linspace(-half, half, 67)]
                                  + [[c - 3.2 + pier, c + 3.2 - pier] for c in spans]))
    top = 3.0 + 0.5 * np.cos(np.pi * xs / (2 * half)) - 0.35
    low = np.full(len(xs), -2.0)
    for centre in spans:
        inside = abs(xs - centre) < 3.2 - pier - 1e-9
        low[inside] = 0.35 + 1.75 * np.sqrt(
            np.clip(1 - ((xs[inside] - centre) / (3.2 - pier))**2, 0, 1))
    parts = []
    for x0, x1, t0, t1, l0, l1 in zip(xs[:-1], xs[1:], top[:-1], top[1:], low[:-1], low[1:]):
        for z, flip in ((width, False), (-width, True)):
            p = np.array([(x0, t0, z), (x1, t1, z), (x0, l0, z), (x1, l1, z)])
            faces = np.array([[0, 2, 3], [0, 3, 1]])
            parts.append(shapes.Shape(p, faces[:, ::-1] if flip else faces, None,
                                      p[:, :2] * [1, -1] / 1.6).smooth())
        if l0 > -2 or l1 > -2:  # under the arch; a wall where it stands on a pier
            p = np.array([(x0, l0, -width), (x0, l0, width), (x1, l1, -width), (x1, l1, width)])
            length = np.hypot(x1 - x0, l1 - l0)
            uvs = np.array([[0, 0], [2, 0], [0, length / 1.6], [2, length / 1.6]])
            parts.append(shapes.Shape(p, np.array([[0, 2, 3], [0, 3, 1]]), None, uvs).smooth())
        along = np.array([x1 - x0, t1 - t0, 0])
        parts.append(shapes.sized_quad((x0, t0, -width), along, (0, 0, 2 * width), 1.6))
    rails = []
    for z in (-width - 0.06, width - 0.22):
        for x0, x1, t0, t1 in zip(xs[:-1:3], xs[3::3], top[:-1:3], top[3::3]):
            low0, low1 = t0 - 0.1, t1 - 0.1
            p = np.array([(x, y, zz) for zz in (z, z + 0.28)
                          for x, y in ((x0, low0), (x1, low1), (x1, t1 + 0.55), (x0, t0 + 0.55))])
            f = [(4, 5, 6), (4, 6, 7), (1, 0, 3), (1, 3, 2), (7, 6, 2), (7, 2, 3), (0, 1, 5),
                 (0, 5, 4)]
            rails.append(shapes.Shape(p, np.array(f), None, p[:, [0, 1]] / 1.6).faceted())
    return shapes.merged(*parts), shapes.merged(*rails)


def tree(seed, level):
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, 6)
    trunk = shapes.tube(np.stack([0.2 * np.sin(2 * t), 2.8 * t, 0.15 * t], 1), 0.2 - 0.1 * t, 8)
    crowns = [shapes.lump(level, 0.2, seed + k, 0.95 + 0.3 * rng.uniform(size=3)).moved(
        (rng.uniform(-0.9, 0.9), 3.1 + 0.55 * k, rng.uniform(-0.9, 0.9))) for k in range(4)]
    return trunk, shapes.merged(*crowns)


def reeds(seed):
    """A tuft of thin blades."""
    rng = np.random.default_rng(seed)
    blades = []
    for _ in range(26):
        x, z, angle = rng.normal(0, 0.22), rng.normal(0, 0.22), rng.uniform(0, 6.28)
        height, lean = rng.uniform(0.6, 1.25), rng.uniform(0.05, 0.35)
        side = 0.022 * np.array([np.cos(angle), 0, np.sin(angle)])
        out = np.array([-np.sin(angle), 0, np.cos(angle)]) * lean
        base, mid = np.array([x, -0.5, z]), np.array([x, 0.45 * height, z]) + 0.3 * out
        tip = np.array([x, height, z]) + out
        p = np.array([base - side, base + side, mid - side, mid + side, tip])
        blades.append(shapes.Shape(p, np.array([[0, 1, 3], [0, 3, 2], [2, 3, 4]])).smooth())
    return shapes.merged(*blades)


def boat():
    """A rowing boat of two skins, its bow at -Z, the waterline at y = 0."""
    s, a = np.linspace(-1, 1, 13), np.linspace(-np.pi / 2, np.pi / 2, 9)
    width = 0.62 * np.sqrt(np.clip(1 - np.clip(-s, 0, 1)**2.2, 0, 1)) * (1 - 0.12 * (s > 0) * s)
    width = np.maximum(width, 0.02)
    keel = -0.22 + 0.25 * np.clip(-s, 0, 1)**3
    rim = 0.34 + 0.14 * s**2
    def skin(inset):
        x = (width - inset)[:, None].clip(0.01) * np.sin(a)
        y = (rim + (keel + inset - rim) * 1)[:, None] * np.cos(a)**0.6 + rim[:, None] * (
            1 - np.cos(a)**0.6)
        z = np.broadcast_to(1.75 * s[:, None], x.shape)
        return np.stack([x, y, z], -1)
    outside, inside = skin(0.0), skin(0.05)
    triangles = shapes._grid_triangles(13, 9)
    hull = shapes.Shape(outside.reshape(-1, 3), triangles[:, ::-1]).smooth()
    lining = shapes.Shape(inside.reshape(-1, 3), triangles).smooth()
    stern = shapes.Shape(outside[-1], np.array([[0, k, k + 1] for k in range(1, 8)])).faceted()
    benches = [shapes.box((-0.5, 0.14, z), (0.5, 0.19, z + 0.26)) for z in (-0.5, 0.6)]
    benches = [shapes.Shape(b.positions, b.triangles, b.normals) for b in benches]
    return shapes.merged(hull, stern), shapes.merged(lining, *benches)


def make():
    scene = Scene("a murky river and the shadow of a bridge on it", [0.55, 0.68, 0.82])
    grass = scene.texture("grass", textures.speckled(128, (0.30, 0.40, 0.13), (0.56, 0.62, 0.28),
                                                     0.6, 11))
    stone = scene.texture("stone", textures.bricks(128, 8, (0.74, 0.68, 0.58), (0.50, 0.46, 0.40)))
    mud = scene.texture("mud", textures.speckled(64, (0.30, 0.24, 0.16), (0.48, 0.40, 0.28), 0.8,
                                                 14))
    mud = scene.material("mud", texture=mud, ambient=AMBIENT)
    grass = scene.material("grass", texture=grass, ambient=AMBIENT)
    stone = scene.material("stone", texture=stone, ambient=AMBIENT)
    bark = scene.material("bark", (0.12, 0.08, 0.05), ambient=AMBIENT)
    leaf = scene.material("leaf", (0.17, 0.28, 0.06), ambient=AMBIENT)
    blade = scene.material("reed", (0.24, 0.30, 0.09), double_sided=True, ambient=AMBIENT)
    paint = scene.material("paint", (0.10, 0.22, 0.30), double_sided=True, ambient=AMBIENT)
    inner = scene.material("planks", (0.45, 0.30, 0.17), double_sided=True, ambient=AMBIENT)

    xs = np.concatenate([np.linspace(-26, -9, 10), np.linspace(-8.2, 8.2, 38),
                         np.linspace(9, 26, 10)])
    zs = 12 - 52 * np.linspace(0, 1, 62)[::-1]**1.35
    land = shapes.height_field(xs, zs, ground, 2.0)
    wet = land.positions[land.triangles, 1].max(axis=1) < 0
    scene.node("ground", scene.mesh("ground", (land.part(wet), mud), (land.part(~wet), grass)))

    faces, rails = bridge()
    at = (middle(-9.0), 0, -9.0)
    scene.node("bridge", scene.mesh("bridge", (faces, stone), (rails, stone)), at)
    hull, lining = boat()
    scene.node("boat", scene.mesh("boat", (hull, paint), (lining, inner)), (-2.6, 0, 0.3),
               turned(24))
    post = shapes.tube([(0, -1.6, 0), (0, 0.75, 0)], 0.08, 10)
    scene.node("post", scene.mesh("post", (post, bark)), (-3.6, 0, -1.3))

    tufts = [scene.mesh(f"reeds {i}", (reeds(51 + i), blade)) for i in range(2)]
    rng = np.random.default_rng(9)
    for i in range(34):
        z = rng.uniform(-30, 5.5)
        side = -1 if i % 2 else 1
        x = middle(z) + side * rng.uniform(4.4, 5.3) - 0.35 * np.sin(0.5 * z)
        scene.node(f"reeds at {z:.1f}", tufts[i % 2], (x, max(0.0, ground(x, z)), z),
                   turned(97 * i), rng.uniform(0.7, 1.15))
    trees = [scene.mesh(f"tree {i}", *zip(tree(61 + 10 * i, 2 - i // 2), (bark, leaf)))
             for i in range(4)]
    for i, (x, z, size) in enumerate([
            (-9.5, -3.5, 1.1), (-12, -15, 1.4), (-8.5, -21, 1.2), (-12, -29, 1.5), (13, -19, 1.2),
            (11, -27, 1.4), (6, -31, 1.3), (-3, -36, 1.5), (1, -33, 1.4), (5, -38, 1.7),
            (16, -13, 1.2), (-17, -8, 1.5), (19, -22, 1.6), (-19, -24, 1.6), (15, -34, 1.6)]):
        scene.node(f"tree at {x}, {z}", trees[i % 2 + 2 * (z < -22)], (x, ground(x, z) - 0.1, z), turned(83 * i),
                   size)

    scene.water(shapes.fan_grid(np.geomspace(1.2, 52, 62), np.linspace(-50, 50, 50), (0.2, 9.5)))
    scene.camera((0.9, 2.5, 8.6), (-0.25, 0.55, -6.5), 42, 0.1, 150)
    scene.sun((0.40, 0.68, -0.58), (1, 0.92, 0.78), 1.6)
    return scene
