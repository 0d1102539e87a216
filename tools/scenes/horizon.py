"""Open sea to a horizon 100 km off, with things near and far: near / far is 1e-5."""
import numpy as np

from . import shapes, textures
from .gltf import Scene, turned

AMBIENT = [0.36, 0.40, 0.46]


def island(radius, height, seed, points=28):
    """A round hill with ridges, that goes on under water."""
    rng = np.random.default_rng(seed)
    r, a = np.linspace(0, 1, points), np.linspace(0, 2 * np.pi, points + 1)
    a, r = np.meshgrid(a, r)
    ridges = sum(rng.uniform(0.5, 1) * np.sin(k * a + rng.uniform(0, 6.28)) / k for k in (2, 3, 5, 8))
    y = (1 - r)**1.25 * (1 + 0.55 * ridges * np.minimum(1, 3 * r)) - 0.22 * r
    reach = r * (1 + 0.16 * ridges * r)
    p = np.stack([radius * reach * np.sin(a), height * y, radius * reach * np.cos(a)], -1)
    shape = shapes.Shape(p.reshape(-1, 3), shapes._grid_triangles(points, points + 1), None,
                         p[..., [0, 2]].reshape(-1, 2) / radius * 4)
    corners = shape.positions[shape.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                          axis=1)
    shape.triangles = shape.triangles[area > 1e-9 * radius**2]
    return shape.smooth()


def buoy():
    """A cone on a drum; the waterline at y = 0."""
    drum = shapes.tube([(0, -0.55, 0), (0, 0.35, 0)], 0.6, 20)
    cone = shapes.tube([(0, 0.35, 0), (0, 1.6, 0)], [0.42, 0.12], 16)
    top = shapes.ball(0.17, 14, 8).moved((0, 1.75, 0))
    band = shapes.tube([(0, 0.75, 0), (0, 1.1, 0)], [0.345, 0.26], 16)
    return shapes.merged(drum, cone, top), band


def sail_boat():
    hull_s = np.linspace(-1, 1, 13)
    width = 1.15 * np.sqrt(np.clip(1 - np.clip(-hull_s, 0, 1)**2, 0.0004, 1))
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    depth = -0.7 + 0.6 * np.clip(-hull_s, 0, 1)**3
    x = width[:, None] * np.sin(a)
    y = 0.95 + (depth - 0.95)[:, None] * np.cos(a)**0.7
    p = np.stack([x, y, np.broadcast_to(4.2 * hull_s[:, None], x.shape)], -1)
    skin = shapes.Shape(p.reshape(-1, 3), shapes._grid_triangles(13, 9)[:, ::-1]).smooth()
    deck = shapes.Shape(np.stack([p[:, 0], p[:, -1]], 1).reshape(-1, 3),
                        shapes._grid_triangles(13, 2)[:, ::-1]).smooth()
    stern = shapes.Shape(p[-1], np.array([[0, k, k + 1] for k in range(1, 8)])).faceted()
    cabin = shapes.box((-0.55, 0.9, -0.9), (0.55, 1.5, 1.5))
    cabin = shapes.Shape(cabin.positions, cabin.triangles, cabin.normals)
    mast = shapes.tube([(0, 0.9, -0.8), (0, 10.5, -0.8)], [0.09, 0.05], 8)
    mast = shapes.Shape(mast.positions, mast.triangles, mast.normals)
    def sail(foot, clew, head, belly):
        foot, clew, head = (np.asarray(v, float) for v in (foot, clew, head))
        rows = []
        for v in np.linspace(0, 0.985, 9):
            left, right = foot + v * (head - foot), clew + v * (head - clew)
            u = np.linspace(0, 1, 7)[:, None]
            rows.append(left + u * (right - left)
                        + belly * np.sin(np.pi * u) * (1 - v) * np.array([1, 0, 0]))
        return shapes.Shape(np.stack(rows).reshape(-1, 3), shapes._grid_triangles(9, 7)).smooth()
    sails = shapes.merged(sail((0, 1.9, -0.7), (0.5, 1.9, 3.6), (0, 10.2, -0.75), 0.5),
                          sail((0, 1.4, -4.1), (0.6, 1.5, -1.0), (0, 8.8, -0.95), 0.5))
    return shapes.merged(skin, deck, stern), shapes.merged(cabin, mast), sails


def lighthouse():
    tower = shapes.tube([(0, -2, 0), (0, 18, 0)], [2.6, 1.7], 20)
    lamp = shapes.tube([(0, 18.6, 0), (0, 21, 0)], 1.1, 14)
    bands = [shapes.tube([(0, y, 0), (0, y + 3, 0)], [2.64 - 0.045 * (y + 2), 2.64 - 0.045 * (y + 5)],
                         20) for y in (4, 11)]
    gallery = shapes.tube([(0, 18, 0), (0, 18.6, 0)], 2.3, 20)
    roof = shapes.tube([(0, 21, 0), (0, 22.8, 0)], [1.5, 0.1], 14)
    return shapes.merged(tower, lamp), shapes.merged(*bands, gallery, roof)


def make():
    scene = Scene("open sea to the horizon, near / far 1e-5", [0.62, 0.74, 0.86])
    rock = scene.texture("rock", textures.speckled(128, (0.30, 0.33, 0.20), (0.58, 0.54, 0.40),
                                                   1.1, 12))
    rock = scene.material("rock", texture=rock, ambient=AMBIENT)
    haze = scene.material("haze", (0.30, 0.40, 0.50), ambient=AMBIENT)
    mist = scene.material("mist", (0.46, 0.57, 0.68), ambient=[0.75, 0.78, 0.82])
    red = scene.material("red", (0.70, 0.06, 0.03), shading="phong", ambient=AMBIENT, power=40,
                         specular=[0.5, 0.5, 0.5])
    green = scene.material("green", (0.03, 0.35, 0.14), shading="phong", ambient=AMBIENT, power=40,
                           specular=[0.5, 0.5, 0.5])
    white = scene.material("white", (0.86, 0.86, 0.84), ambient=AMBIENT)
    cloth = scene.material("cloth", (0.92, 0.90, 0.84), double_sided=True, ambient=AMBIENT)
    navy = scene.material("navy", (0.04, 0.08, 0.20), double_sided=True, ambient=AMBIENT)

    body, band = buoy()
    red_buoy = scene.mesh("red buoy", (body, red), (band, white))
    green_buoy = scene.mesh("green buoy", (body, green), (band, white))
    for i, (x, z) in enumerate([(-3.2, -9), (1.6, -27), (-9, -52), (22, -120), (-28, -260),
                                (80, -620)]):
        scene.node(f"buoy at {-z} m", green_buoy if i % 2 else red_buoy, (x, 0, z),
                   turned(6, (1, 0, 0.6 * (-1)**i)))
    hull, cabin, sails = sail_boat()
    boat = scene.mesh("sail boat", (hull, navy), (cabin, white), (sails, cloth))
    scene.node("sail boat", boat, (12.5, 0, -46), turned(-58))
    scene.node("far sail boat", boat, (-165, 0, -900), turned(70), 1.6)

    near = island(150, 46, 71)
    scene.node("near island", scene.mesh("near island", (near, rock)), (-190, 0, -420))
    tower, bands = lighthouse()
    scene.node("lighthouse", scene.mesh("lighthouse", (tower, white), (bands, red)),
               (-188, 44, -419))
    scene.node("skerry", scene.mesh("skerry", (island(16, 5, 72), rock)), (48, 0, -135))
    scene.node("middle island", scene.mesh("middle island", (island(900, 190, 73), haze)),
               (1500, 0, -4200))
    far = scene.mesh("far island", (island(6000, 1000, 74), mist))
    scene.node("far island", far, (-9000, 0, -33000))
    scene.node("farthest island", far, (23000, 0, -62000), turned(140), (1.5, 1.2, 1.5))

    scene.water(shapes.fan_grid(np.geomspace(1.5, 9.9e4, 110), np.linspace(-50, 50, 76)))
    scene.camera((0, 3.4, 1.5), (0.4, 2.2, -20), 40, 1.0, 1e5)
    scene.sun((-0.52, 0.50, 0.22), (1, 0.90, 0.74), 1.25)
    return scene
