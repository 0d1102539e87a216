"""Triangle shapes as arrays: Y up, counter-clockwise seen from outside, metres."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Shape:
    positions: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray = None
    uvs: np.ndarray = None

    def check(self):
        """Fails for triangles without area, and for normals that point behind their triangle."""
        corners = self.positions[self.triangles]
        front = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.linalg.norm(front, axis=1) > 1e-9).all()
        if self.normals is not None:
            mean = self.normals[self.triangles].sum(axis=1)
            assert (np.einsum("ij,ij->i", front, mean) > 0).all()

    def part(self, which):
        """Some of its triangles, with the vertices that they need."""
        used, triangles = np.unique(self.triangles[which], return_inverse=True)
        def kept(values):
            return None if values is None else values[used]
        return Shape(self.positions[used], triangles.reshape(-1, 3), kept(self.normals),
                     kept(self.uvs))

    def moved(self, by):
        return Shape(self.positions + np.asarray(by, float), self.triangles, self.normals, self.uvs)

    def rotated(self, degrees, axis):
        angle, k = np.radians(degrees), np.asarray(axis, float) / np.linalg.norm(axis)
        cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
        m = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        normals = None if self.normals is None else self.normals @ m.T
        return Shape(self.positions @ m.T, self.triangles, normals, self.uvs)

    def smooth(self):
        """With normals that are the mean over the triangles around, by area."""
        corners = self.positions[self.triangles]
        area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals = np.zeros_like(self.positions)
        for k in range(3):
            np.add.at(normals, self.triangles[:, k], area)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        return Shape(self.positions, self.triangles, normals, self.uvs)

    def faceted(self):
        """With corners of its own for each triangle, and the triangle's normal."""
        positions = self.positions[self.triangles].reshape(-1, 3)
        uvs = None if self.uvs is None else self.uvs[self.triangles].reshape(-1, 2)
        return Shape(positions, np.arange(len(positions)).reshape(-1, 3), None, uvs).smooth()


def merged(*shapes):
    offsets = np.cumsum([0] + [len(shape.positions) for shape in shapes])
    def all_of(name):
        return np.concatenate([getattr(shape, name) for shape in shapes])
    return Shape(all_of("positions"),
                 np.concatenate([s.triangles + o for s, o in zip(shapes, offsets)]),
                 None if shapes[0].normals is None else all_of("normals"),
                 None if shapes[0].uvs is None else all_of("uvs"))


def _grid_triangles(rows, columns):
    """Of vertices row by row; the front is where columns run right and rows run down."""
    a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    return np.concatenate([np.stack([a, a + columns, a + columns + 1], 1),
                           np.stack([a, a + columns + 1, a + 1], 1)])


def height_field(xs, zs, height, uv_size=1.0):
    """Over rows z and columns x; a texture spans `uv_size` metres."""
    x, z = np.meshgrid(xs, zs)
    positions = np.stack([x, height(x, z), z], -1).reshape(-1, 3)
    uvs = np.stack([x, z], -1).reshape(-1, 2) / uv_size
    return Shape(positions, _grid_triangles(len(zs), len(xs)), None, uvs).smooth()


def flat_grid(xs, zs):
    """Positions alone, at y = 0."""
    x, z = np.meshgrid(xs, zs)
    positions = np.stack([x, 0 * x, z], -1).reshape(-1, 3)
    return Shape(positions, _grid_triangles(len(zs), len(xs)))


def fan_grid(distances, angles, eye=(0, 0)):
    """Positions alone, at y = 0: rings of these distances around x, z = eye; angles in degrees from
    -Z to +X."""
    angle, distance = np.meshgrid(np.radians(angles), np.asarray(distances)[::-1])
    positions = np.stack([eye[0] + distance * np.sin(angle), 0 * angle,
                          eye[1] - distance * np.cos(angle)], -1).reshape(-1, 3)
    return Shape(positions, _grid_triangles(len(distances), len(angles)))


def quad(corner, across, down, uv_across=1.0, uv_down=1.0):
    """From the upper left corner; seen from the side where `across` is right and `down` is down."""
    corner, across, down = (np.asarray(v, float) for v in (corner, across, down))
    positions = np.array([corner, corner + across, corner + down, corner + across + down])
    uvs = np.array([[0, 0], [uv_across, 0], [0, uv_down], [uv_across, uv_down]], float)
    return Shape(positions, np.array([[0, 2, 3], [0, 3, 1]]), None, uvs).smooth()


def sized_quad(corner, across, down, uv_size):
    """A quad whose texture spans `uv_size` metres."""
    return quad(corner, across, down, np.linalg.norm(across) / uv_size,
                np.linalg.norm(down) / uv_size)


def box(low, high, uv_size=None):
    """The texture spans `uv_size` metres, or each side."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    x, y, z = np.diag(high - low)
    sides = [(low + y + z, x, -y), (high - z, -x, -y), (low + y, z, -y), (high, -z, -y),
             (low + y, x, z), (low + z, x, -z)]
    make = quad if uv_size is None else lambda *side: sized_quad(*side, uv_size)
    return merged(*(make(*side) for side in sides))


def tube(path, radii, sides=8, uv_length=1.0):
    """Along the points of a path, closed by a point at both ends."""
    path, radii = np.asarray(path, float), np.broadcast_to(radii, len(path))
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    apart = np.eye(3)[np.argmin(abs(along).max(axis=0))]  # from every direction of the path
    side = np.cross(along, apart)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    other = np.cross(along, side)
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    ring = (np.cos(turn)[:, None, None] * side + np.sin(turn)[:, None, None] * other)
    wall = path + ring * radii[:, None]
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    uvs = np.stack(np.broadcast_arrays(turn[:, None] / (2 * np.pi), length / uv_length), -1)
    rows, columns = sides + 1, len(path)
    body = Shape(wall.reshape(-1, 3), _grid_triangles(rows, columns),
                 ring.reshape(-1, 3), uvs.reshape(-1, 2))
    caps = []
    for end, normal in ((0, -along[0]), (-1, along[-1])):
        rim = wall[:-1, end]
        fan = np.stack([np.full(sides, sides), np.arange(sides), np.roll(np.arange(sides), -1)], 1)
        caps.append(Shape(np.vstack([rim, path[end]]), fan if end else fan[:, ::-1],
                          np.tile(normal, (sides + 1, 1)), np.full((sides + 1, 2), 0.5)))
    return merged(body, *caps)


def ball(radius, columns=24, rows=12):
    """A sphere of latitudes and longitudes; the texture goes around once."""
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    theta, phi = np.pi * v, 2 * np.pi * u
    normals = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta),
                        np.sin(theta) * np.cos(phi)], -1).reshape(-1, 3)
    triangles = _grid_triangles(rows + 1, columns + 1)
    corners = normals[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                          axis=1)
    return Shape(radius * normals, triangles[area > 1e-9], normals,
                 np.stack([u, v], -1).reshape(-1, 2))


def icosphere(level):
    """A unit sphere of 20 * 4^level triangles, without normals."""
    g = (1 + 5**0.5) / 2
    points = [np.array(p, float) for p in (
        (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
        (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    points = [p / np.linalg.norm(p) for p in points]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(level):
        middles, split = {}, []
        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                point = points[a] + points[b]
                middles[key] = len(points)
                points.append(point / np.linalg.norm(point))
            return middles[key]
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = split
    return Shape(np.array(points), np.array(faces))


def lump(level, roughness, seed, squash=(1, 1, 1)):
    """A stone or a crown of leaves: a sphere pushed in and out by a few smooth waves."""
    shape = icosphere(level)
    waves = np.random.default_rng(seed)
    size = np.ones(len(shape.positions))
    for frequency in (1.3, 2.1, 3.7, 6.1):
        for _ in range(3):
            axis = waves.normal(size=3)
            axis *= frequency / np.linalg.norm(axis)
            size += roughness / frequency * np.sin(shape.positions @ axis + waves.uniform(0, 6.28))
    positions = shape.positions * size[:, None] * np.asarray(squash, float)
    uvs = np.stack([positions[:, 0] + positions[:, 2], positions[:, 1]], 1) / 2
    return Shape(positions, shape.triangles, None, uvs).smooth()
