"""A tiled swimming pool in the sun: straight lines under water, a ladder, a ball, a wall behind."""
import numpy as np

from . import shapes, textures
from .gltf import Scene, turned

AMBIENT = [0.34, 0.38, 0.45]
X, Z = 3.0, 4.5       # half sizes
RIM = 0.28            # height of the edge over the water
SHALLOW, DEEP = -1.1, -2.2


def basin(tile):
    """The walls and the sloping floor."""
    size = 1.0
    near, far = SHALLOW, DEEP
    floor = shapes.height_field(np.linspace(-X, X, 7), np.linspace(-Z, Z, 10),
                                lambda x, z: near + (far - near) * (Z - z) / (2 * Z), size)
    top = RIM - 0.1
    walls = [
        shapes.sized_quad((-X, top, -Z), (2 * X, 0, 0), (0, far - top, 0), size),
        shapes.sized_quad((X, top, Z), (-2 * X, 0, 0), (0, near - top, 0), size),
        shapes.sized_quad((-X, top, Z), (0, 0, -2 * Z), (0, far - top, 0), size),
        shapes.sized_quad((X, top, -Z), (0, 0, 2 * Z), (0, far - top, 0), size),
    ]
    return shapes.merged(floor, *walls)


def strip(x0, x1, z0, z1):
    """A dark line that lies a little over the floor."""
    def y(z):
        return SHALLOW + (DEEP - SHALLOW) * (Z - z) / (2 * Z) + 0.004
    across, down = (x1 - x0, 0, 0), (0, y(z1) - y(z0), z1 - z0)
    return shapes.quad((x0, y(z0), z0), across, down)


def ladder():
    rails = []
    for z in (-0.25, 0.25):
        angle = np.linspace(0, np.pi, 9)
        bow = np.stack([-0.22 * np.cos(angle) + 0.14, 0.62 + 0.22 * np.sin(angle),
                        np.full(9, z)], 1)
        path = np.vstack([[(-0.08, -1.05, z)], bow, [(0.36, RIM, z)]])
        rails.append(shapes.tube(path, 0.022, 10))
    steps = [shapes.box((-0.14, y, -0.25), (-0.03, y + 0.03, 0.25)) for y in (-0.9, -0.6, -0.3, 0)]
    return shapes.merged(*rails, *steps)


def lounger():
    legs = [shapes.box((x, 0, z), (x + 0.05, 0.32, z + 0.05))
            for x in (0.05, 0.55) for z in (0.1, 1.2)]
    seat = shapes.box((0, 0.32, 0), (0.65, 0.40, 1.3))
    back = shapes.box((0, 0, -0.75), (0.65, 0.07, 0)).rotated(38, (1, 0, 0)).moved((0, 0.33, 0))
    return shapes.merged(seat, back), shapes.merged(*legs)


def make():
    scene = Scene("a tiled pool: straight lines under water", [0.45, 0.66, 0.92])
    tile = scene.texture("tile", textures.tiles(64, 4, (0.72, 0.88, 0.92), (0.46, 0.66, 0.72), 1))
    slab = scene.texture("slab", textures.tiles(64, 2, (0.82, 0.75, 0.66), (0.60, 0.54, 0.46), 1,
                                                0.03))
    wall = scene.texture("wall", textures.bricks(64, 4, (0.80, 0.47, 0.33), (0.83, 0.76, 0.68)))
    ball = scene.texture("ball", textures.stripes(
        64, [(0.95, 0.95, 0.95), (0.85, 0.12, 0.10), (0.95, 0.95, 0.95), (0.10, 0.30, 0.75),
             (0.95, 0.95, 0.95), (0.98, 0.78, 0.10), (0.95, 0.95, 0.95), (0.10, 0.55, 0.28)]))
    tile = scene.material("tile", texture=tile, ambient=AMBIENT)
    slab = scene.material("slab", texture=slab, ambient=AMBIENT)
    brick = scene.material("brick", texture=wall, ambient=AMBIENT)
    ball = scene.material("ball", texture=ball, shading="phong", ambient=AMBIENT, power=40,
                          specular=[0.5, 0.5, 0.5])
    line = scene.material("line", (0.015, 0.06, 0.20), ambient=AMBIENT)
    edge = scene.material("edge", (0.86, 0.84, 0.80), ambient=AMBIENT)
    steel = scene.material("steel", (0.42, 0.44, 0.46), shading="phong", ambient=AMBIENT, power=60,
                           specular=[1, 1, 1])
    cloth = scene.material("cloth", (0.85, 0.80, 0.70), ambient=AMBIENT)
    red = scene.material("float", (0.75, 0.10, 0.05), shading="phong", ambient=AMBIENT, power=30,
                         specular=[0.4, 0.4, 0.4])
    green = scene.material("hedge", (0.07, 0.17, 0.04), ambient=AMBIENT)
    clay = scene.material("clay", (0.45, 0.16, 0.08), ambient=AMBIENT)

    scene.node("basin", scene.mesh("basin", (basin(tile), tile)))
    lanes = [strip(x - 0.12, x + 0.12, -Z + 0.8, Z - 0.8) for x in (-1.5, 0, 1.5)]
    marks = [strip(x - 0.45, x + 0.45, -Z + 0.8, -Z + 1.04) for x in (-1.5, 0, 1.5)]
    scene.node("lines", scene.mesh("lines", (shapes.merged(*lanes, *marks), line)))

    out, low = 0.35, RIM - 0.1
    x, z = X - 0.03, Z - 0.03  # it stands over a little
    coping = [shapes.box((-X - out, low, -Z - out), (X + out, RIM, -z)),
              shapes.box((-X - out, low, z), (X + out, RIM, Z + out)),
              shapes.box((-X - out, low, -z), (-x, RIM, z)),
              shapes.box((x, low, -z), (X + out, RIM, z))]
    scene.node("edge", scene.mesh("edge", (shapes.merged(*coping), edge)))
    y, wide, long = RIM - 0.02, 9.0, 9.0
    deck = [shapes.sized_quad((-wide, y, -long), (2 * wide, 0, 0), (0, 0, long - Z - out), 1.2),
            shapes.sized_quad((-wide, y, Z + out), (2 * wide, 0, 0), (0, 0, long - Z - out), 1.2),
            shapes.sized_quad((-wide, y, -Z - out), (wide - X - out, 0, 0),
                              (0, 0, 2 * (Z + out)), 1.2),
            shapes.sized_quad((X + out, y, -Z - out), (wide - X - out, 0, 0),
                              (0, 0, 2 * (Z + out)), 1.2)]
    scene.node("deck", scene.mesh("deck", (shapes.merged(*deck), slab)))

    wall = [shapes.box((-wide, RIM, -8.4), (wide, 2.5, -8.0), 1.0),
            shapes.box((-8.4, RIM, -8.0), (-8.0, 2.5, wide), 1.0)]
    cap = [shapes.box((-wide, 2.5, -8.5), (wide, 2.6, -7.9)),
           shapes.box((-8.5, 2.5, -7.9), (-7.9, 2.6, wide))]
    scene.node("wall", scene.mesh("wall", (shapes.merged(*wall), brick),
                                  (shapes.merged(*cap), edge)))
    scene.node("ladder", scene.mesh("ladder", (ladder(), steel)), (X, 0, -1.2), turned(0))
    scene.node("ball", scene.mesh("ball", (shapes.ball(0.3, 24, 16), ball)), (0.75, 0.17, 0.9),
               turned(58, (0.8, 0.3, -1)))
    ring = np.linspace(0, 2 * np.pi, 25)
    ring = shapes.tube(np.stack([0.38 * np.cos(ring), 0 * ring, 0.38 * np.sin(ring)], 1), 0.12, 12)
    scene.node("float", scene.mesh("float", (ring, red)), (-1.25, 0.04, -0.9),
               turned(5, (1, 0, 0.5)))
    seat, legs = lounger()
    lounge = scene.mesh("lounger", (seat, cloth), (legs, steel))
    for x, turn in ((-6.6, 86), (-6.5, 94)):
        scene.node(f"lounger {turn}", lounge, (x, RIM, -1.6 + (turn - 86) * 0.25), turned(turn))
    pot = shapes.tube([(0, 0, 0), (0, 0.45, 0)], [0.18, 0.27], 14)
    bush = shapes.lump(3, 0.25, 41, (0.5, 0.55, 0.5)).moved((0, 0.9, 0))
    plant = scene.mesh("plant", (pot, clay), (bush, green))
    for i, x in enumerate((-5.6, -2.8, 0.0, 2.8, 5.6)):
        scene.node(f"plant {i}", plant, (x, RIM, -7.2), turned(77 * i), 1.0 + 0.12 * (i % 2))

    scene.water(shapes.flat_grid(np.linspace(-X, X, 67), np.linspace(-Z, Z, 100)))
    scene.camera((2.0, 2.35, 7.4), (-0.35, -0.35, -0.6), 44, 0.1, 100)
    scene.sun((0.50, 0.72, -0.30), (1, 0.95, 0.86), 1.25)
    return scene
