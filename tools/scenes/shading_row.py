"""Five balls, one a shading, over a little basin: flat, textured, lambert, phong, toon."""
import numpy as np

from . import shapes, textures
from .gltf import Scene, turned

AMBIENT = [0.25, 0.28, 0.34]


def basin(x, z, floor, rim):
    top = rim - 0.1
    inner = [
        shapes.sized_quad((-x, floor, -z), (2 * x, 0, 0), (0, 0, 2 * z), 1.2),
        shapes.sized_quad((-x, top, -z), (2 * x, 0, 0), (0, floor - top, 0), 1.2),
        shapes.sized_quad((x, top, z), (-2 * x, 0, 0), (0, floor - top, 0), 1.2),
        shapes.sized_quad((-x, top, z), (0, 0, -2 * z), (0, floor - top, 0), 1.2),
        shapes.sized_quad((x, top, -z), (0, 0, 2 * z), (0, floor - top, 0), 1.2),
    ]
    w, i, j = 0.3, x - 0.03, z - 0.03  # the edge stands over a little
    edge = [shapes.box((-x - w, top, -z - w), (x + w, rim, -j), 1.2),
            shapes.box((-x - w, top, j), (x + w, rim, z + w), 1.2),
            shapes.box((-x - w, top, -j), (-i, rim, j), 1.2),
            shapes.box((i, top, -j), (x + w, rim, j), 1.2)]
    return shapes.merged(*inner), shapes.merged(*edge)


def make():
    scene = Scene("the five shadings side by side over a basin", [0.60, 0.72, 0.88])
    checks = scene.texture("checks", textures.checks(64, 8, (0.92, 0.80, 0.50), (0.70, 0.25, 0.20)))
    gloss = scene.texture("gloss", textures.checks(64, 8, (0.10, 0.10, 0.10), (1, 1, 1)))
    tile = scene.texture("tile", textures.tiles(64, 4, (0.74, 0.80, 0.80), (0.45, 0.52, 0.54), 1))
    stone = scene.texture("stone", textures.speckled(128, (0.52, 0.49, 0.45), (0.72, 0.69, 0.64),
                                                     0.8, 13))
    tile = scene.material("tile", texture=tile, ambient=AMBIENT)
    stone = scene.material("stone", texture=stone, ambient=AMBIENT)
    red = (0.72, 0.12, 0.06)
    balls = [
        ("flat", scene.material("flat", red, shading="flat")),
        ("textured", scene.material("textured", texture=checks, shading="textured")),
        ("lambert", scene.material("lambert", red, shading="lambert", ambient=AMBIENT)),
        ("phong", scene.material("phong", texture=checks, shading="phong", ambient=AMBIENT,
                                 power=20, specular=[0.9, 0.9, 0.9], specular_texture=gloss)),
        ("toon", scene.material("toon", red, shading="toon", ambient=AMBIENT)),
    ]

    x, z = 4.6, 1.7
    inner, edge = basin(x, z, -1.0, 0.22)
    scene.node("basin", scene.mesh("basin", (inner, tile), (edge, stone)))
    ring = []
    for x0, x1, z0, z1 in ((-16, 16, -16, -z - 0.3), (-16, 16, z + 0.3, 10),
                           (-16, -x - 0.3, -z - 0.3, z + 0.3), (x + 0.3, 16, -z - 0.3, z + 0.3)):
        ring.append(shapes.sized_quad((x0, 0.13, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0), 2.4))
    scene.node("terrace", scene.mesh("terrace", (shapes.merged(*ring), stone)))
    foot = shapes.merged(shapes.tube([(0, -1.0, 0), (0, -0.1, 0)], [0.32, 0.20], 20),
                         shapes.tube([(0, -0.1, 0), (0, 0.14, 0)], [0.20, 0.34], 20))
    foot = scene.mesh("foot", (foot, stone))
    sphere = shapes.ball(0.68, 40, 24)
    for i, (name, material) in enumerate(balls):
        at = 1.72 * (i - 2)
        scene.node(f"foot {name}", foot, (at, 0, -0.25))
        scene.node(name, scene.mesh(name, (sphere, material)), (at, 0.76, -0.25), turned(25))
    wall = [shapes.box((-9, 0.1, -6.4), (9, 2.0, -6.0), 2.4)]
    scene.node("wall", scene.mesh("wall", (shapes.merged(*wall), stone)))

    scene.water(shapes.flat_grid(np.linspace(-x, x, 111), np.linspace(-z, z, 42)))
    scene.camera((0, 3.0, 7.6), (0, 0.5, -0.25), 35, 0.1, 100)
    scene.sun((0.55, 0.62, 0.56), (1, 0.95, 0.88), 1.1)
    return scene
