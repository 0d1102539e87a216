"""Puts water into pictures that were rendered without it.

    import limpid

    wet = limpid.composite(
        color=rgba, depth=z,                        # numpy arrays: (rows, columns, 4), (rows, columns)
        camera=limpid.Camera(view, projection),     # 4x4, for column vectors
        water={"up": (0, 0, 1), "height": 0.0},
        look={"depth_fog": {"water_type": "II"}},
    )

Arrays are float32 or float16, of any strides: flipped, sliced, interleaved and broadcast ones are
read in place. Other types are refused, nothing is converted. Row 0 is the top of the picture.
Color is scene-linear and premultiplied. Lengths are scene units, times seconds, angles of looks
degrees. For many frames make one Compositor; `composite` makes one for each call.

Looks are dicts of dicts; omitted parameters have their default. `operators()` lists all parameters,
`roles()` the buffers that a frame may have, `aovs()` the AOVs that may be written besides the
picture. The library refuses an input by limpid.Error, a ValueError, with a sentence that says what
was expected; arguments of a wrong type other than arrays raise TypeError.
"""
from __future__ import annotations

import dataclasses
import os
import pathlib
import tomllib
from types import MappingProxyType
from typing import Any, Mapping, NamedTuple, Sequence

import numpy as np

from . import _limpid
from ._limpid import Error, __version__

__all__ = ["Camera", "Compositor", "Error", "Plan", "PlannedOperator", "Shader", "ShaderNumber", "ShaderOutput",
           "ShaderTexture", "aovs", "composite", "full_look", "load_look", "look_at", "look_to_toml", "operators",
           "orthographic", "perspective", "roles"]

Error.__module__ = "limpid"
Error.__doc__ = "A refusal by the library: one sentence that says what was expected."


class Camera(NamedTuple):
    """Two 4x4 matrices for column vectors, [row][column], as arrays or lists of rows."""
    view: Any  #: view from world, rigid; view space looks down -Z, +Y up
    projection: Any  #: clip from view; see perspective() and orthographic()


class PlannedOperator(NamedTuple):
    """The planner's verdict on an operator of the chain."""
    name: str
    verdict: str  #: kept, neutral, absent (an input is missing), or unread
    reason: str  #: one phrase, "" for a plain "kept"
    rule: str  #: the planner's rule that decided, or ""


class Plan(tuple):
    """Which operators of the chain run, and why the others do not: a tuple of PlannedOperator.

    str(plan) has a line for each. `reads` lists the roles that are read.
    """
    reads: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        return self.text


class ShaderNumber(NamedTuple):
    """A float of a shader's uniform block."""
    name: str  #: "refraction.strength"; in the text with _ for . and [
    offset: int  #: in bytes
    value: float  #: of the frame
    range: tuple[float, float] | None  #: of a parameter that is itself in the block


class ShaderTexture(NamedTuple):
    """A sampler2D of a shader, read only by texelFetch, without a filter."""
    name: str  #: "limpid_depth"
    binding: int
    source: str  #: planes: the frame's, for the host to bind; rows: of each row; made: a map, or made for the frame
    role: str | None  #: of planes, made ones included: "depth", "color"
    channels: int  #: number of channels that are read, 1 ... 4
    width: int
    height: int
    texels: np.ndarray | None  #: (rows, columns[, channels]) float32, read-only; None for planes


class ShaderOutput(NamedTuple):
    """An image (compute) or output (fragment) that main() writes. The first is the picture."""
    name: str  #: "color", "path": of the AOV
    channels: int
    binding: int  #: or location


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Shader:
    """A look as one shader, and its values for a frame; see Compositor.shader.

    Textures of source "planes" must have eye depth, unit normals and row 0 at the top, for any
    conventions of the compositor's arrays.
    """
    text: str  #: GLSL 4.50 for Vulkan
    id: str  #: 16 hexadecimal digits of the text: equal for equal texts
    stage: str
    function: str
    set: int
    block_binding: int
    block: bytes  #: the uniform block, std140, with the values of the frame
    numbers: tuple[ShaderNumber, ...]  #: of the block
    textures: tuple[ShaderTexture, ...]
    outputs: tuple[ShaderOutput, ...]
    work: tuple[int, int, int, int]  #: pixels that the shader makes: x0, y0, x1, y1


class Compositor:
    """Puts water into many frames, with one pool of threads; the settings apply to all frames.

    look: dict of dicts, as {"refraction": {"steps": 2}}; other parameters have their defaults
    wave_map: (rows, columns, 3) float32, tiling normal map, values 0 ... 1, blue is up
    environment: (rows, columns, 3) float32, the surroundings as a lat-long map of radiance, in
        the layout of picture files: the top row is straight up, the middle looks along the water plane's
        x axis (world x projected on it), columns run clockwise as seen from above
    depth_kind: the kind of all depth arrays: "eye" (distance along the view axis), "ray" (distance
        from the eye), "inverse" (1 / eye depth), "normalised" (0 at near ... 1 at far), "device"
        (clip z after the division)
    near, far: scene units, for "normalised" only
    clip: the projections' range of clip z: "gl", "d3d" (Vulkan) or "reversed"
    looks_along_plus_z: view space looks down +Z
    clip_y_down: clip y = +1 is the lowest row, as in Vulkan
    colorspace: the color space of frames, environments and looks: the name of a linear space ("ACEScg"), or eight
        numbers, x and y of red, green, blue and white
    trusted: you vouch for the arrays (no NaN, shadows within 0 ... 1, unit normals): nothing is checked
    threads: 0 is one for each core
    simd: "" is the best of this machine; "avx512", "avx2", "sse4", "neon", "scalar"
    max_error: leave out what together changes no channel by more than this (white = 1); not on a GPU
    runner: "fused" (the CPU) or "gpu" (by Vulkan 1.2)
    gpu: a part of the device's name; "": the first of the fastest kind
    gpu_cache: a folder for compiled shaders, reused by the next start; "": none

    Maps are not copied: do not change them while they are set. Only one thread at a time may use a
    compositor, else limpid.Error; several compositors may run at once, as the interpreter's lock is
    released.
    """

    def __init__(self, *, look: Mapping | None = None, wave_map: np.ndarray | None = None,
                 environment: np.ndarray | None = None, depth_kind: str = "eye", near: float = 0.0,
                 far: float = 0.0, clip: str = "gl", looks_along_plus_z: bool = False,
                 clip_y_down: bool = False, colorspace: str | Sequence[float] = "Rec.709",
                 trusted: bool = False, threads: int = 0, simd: str = "", max_error: float = 0.0,
                 runner: str = "fused", gpu: str = "", gpu_cache: str = ""):
        conventions = {"depth_kind": depth_kind, "near": near, "far": far, "clip": clip,
                       "looks_along_plus_z": looks_along_plus_z, "clip_y_down": clip_y_down,
                       "colorspace": colorspace, "trusted": trusted}
        self._core = _limpid.Compositor(conventions, _plain(look), threads, simd, max_error,
                                        {"runner": runner, "gpu": gpu, "gpu_cache": gpu_cache})
        self._core.set_wave_map(wave_map)
        self._core.set_environment(environment)

    @property
    def look(self) -> Mapping[str, Mapping[str, Any]]:
        """All parameters, read-only. Assign a dict of dicts to change the parameters in it."""
        return MappingProxyType({name: MappingProxyType(table) for name, table in self._core.look().items()})

    @look.setter
    def look(self, changes: Mapping) -> None:
        self._core.change_look(_plain(changes))

    def set_wave_map(self, wave_map: np.ndarray | None) -> None:
        """Replaces the tiling normal map from the next frame on; None removes it."""
        self._core.set_wave_map(wave_map)

    def set_environment(self, environment: np.ndarray | None) -> None:
        """Replaces the surroundings from the next frame on; None removes them."""
        self._core.set_environment(environment)

    def run(self, *, color: np.ndarray, depth: np.ndarray, camera: Camera, water: Mapping,
            sun: Mapping | None = None, time: float = 0.0, shadow: np.ndarray | None = None,
            reflection: np.ndarray | None = None, surface_depth: np.ndarray | None = None,
            surface_normal: np.ndarray | None = None, reflection_valid: np.ndarray | None = None,
            reflection_depth: np.ndarray | None = None, below_color: np.ndarray | None = None,
            below_depth: np.ndarray | None = None, surface_shadow: np.ndarray | None = None,
            sky: np.ndarray | None = None, albedo: np.ndarray | None = None,
            sun_color: np.ndarray | None = None, basin: np.ndarray | None = None,
            sky_radiance: Sequence[float] | None = None,
            display: Sequence[int] | None = None, out: np.ndarray | None = None, dtype: str = "float32",
            aovs: Sequence[str] | Mapping[str, np.ndarray | None] | None = None) -> Any:
        """The frame with water: an array with the channels of color. With aovs: (array, dict).

        color: (rows, columns, 3 or 4), the dry picture
        depth: (rows, columns), of the dry scene; inf where nothing was hit
        camera: Camera, or (view, projection)
        water: {"up": (x, y, z), "height": h, "waves": rows}: the points p with dot(up, p) = h, up
            (0, 1, 0) and height 0 unless given. Waves are rows of amplitude (scene units), k_x, k_y
            (rad / scene unit), phase (rad), and omega (rad / s; that of deep water, if left out)
        sun: {"direction": towards it, "color": (r, g, b), "diameter": degrees}, color (1, 1, 1) and
            diameter 0.533 unless given
        sky_radiance: (r, g, b), of an even sky, which lights the water if there is no environment
        time: seconds, for drift and waves
        shadow: (rows, columns), visibility of the sun: 1 lit, 0 in shadow
        reflection: (rows, columns, 3), the picture of a flat mirror in the water plane at each pixel
        surface_depth: (rows, columns), depth of the water, inf where a pixel has none
        surface_normal: (rows, columns, 3), world normal of the water
        reflection_valid: (rows, columns), 1 where the reflection is real
        reflection_depth: (rows, columns), of the mirrored scene along the mirrored ray
        below_color, below_depth: the dry scene without the objects above the water
        surface_shadow: (rows, columns), shadow at the water surface
        sky: (rows, columns, 3), the sky without the objects in front of it
        albedo: (rows, columns, 3), share of the light that the bottom reflects, around each pixel
        sun_color: (rows, columns, 3), the part of color from the sun's direct light: 0 in shadow
        basin: (rows, columns), albedo of an endless floor as bright, over albedo: below 1 by walls
            and in shade
        display: (x0, y0, x1, y1), the pixels of color in the camera's picture; the others are
            overscan, which is looked up, but not computed
        out: the target array, float32 or float16, 3 or 4 channels, any strides; may be color itself
        dtype: "float32" or "float16", of the array that is made without out
        aovs: names of aovs() ("stmap" for its three), or a dict from names to target arrays
            (rows, columns[, channels]) or None
        """
        planes = {"color": color, "depth": depth, "shadow": shadow, "reflection": reflection,
                  "surface_depth": surface_depth, "surface_normal": surface_normal,
                  "reflection_valid": reflection_valid, "reflection_depth": reflection_depth,
                  "below_color": below_color, "below_depth": below_depth, "surface_shadow": surface_shadow,
                  "sky": sky, "albedo": albedo, "sun_color": sun_color, "basin": basin}
        scene = _scene(camera, water, sun, sky_radiance, time)
        dtype = dtype if isinstance(dtype, str) else np.dtype(dtype).name
        wet, made = self._core.run(_present(planes), scene, display, out, dtype, _aov_arrays(aovs))
        return wet if aovs is None else (wet, made)

    def shader(self, *, color: np.ndarray, depth: np.ndarray, camera: Camera, water: Mapping,
               sun: Mapping | None = None, time: float = 0.0, sky_radiance: Sequence[float] | None = None,
               display: Sequence[int] | None = None, stage: str = "function", function: str = "limpid_water",
               set: int = 0, first_binding: int = 0, aovs: Sequence[str] | None = None,
               **planes: np.ndarray | None) -> Shader:
        """The look, with its maps, as one shader for frames like this one, and its values for this frame.

        The text is the same for any size, time and camera, as long as the frame has the same arrays, the
        water as many waves, and the camera does not pass between air and water. max_error is ignored,
        and edges are not composited. The results of run, plan and replaced do not change. Other languages
        than GLSL: `limpid shader --lang`.

        color ... display: as in run, with its other arrays as `planes`
        stage: "function" (declarations and the function only), "compute" (also a main() for groups of
            16 x 8 pixels, which writes images) or "fragment" (also a main() for a pixel of a full-screen
            triangle)
        function: its name, a word of letters, digits and _
        set: descriptor set of all declarations, 0 ... 31
        first_binding: the lowest binding, 0 ... 1000
        aovs: names of aovs() that the function returns besides the picture
        """
        for name in planes.keys() - {role["name"] for role in roles()}:
            raise TypeError(f"shader() got an unexpected keyword argument '{name}'")
        scene = _scene(camera, water, sun, sky_radiance, time)
        options = {"stage": stage, "function": function, "set": set, "first_binding": first_binding,
                   "aovs": list(_aov_arrays(aovs))}
        made = self._core.shader(_present({"color": color, "depth": depth, **planes}), scene, display, options)
        for name, kind in (("numbers", ShaderNumber), ("textures", ShaderTexture), ("outputs", ShaderOutput)):
            made[name] = tuple(kind(*values) for values in made[name])
        return Shader(**made)

    @property
    def plan(self) -> Plan:
        """The plan of the last frame; limpid.Error if no frame was run with this look and these maps."""
        operators, reads, text = self._core.plan()
        plan = Plan(PlannedOperator(*entry) for entry in operators)
        plan.reads, plan.text = tuple(reads), text
        return plan

    @property
    def replaced(self) -> dict[str, dict[str, int]]:
        """For the last frame: number of invalid values that were replaced, by role, "nan" and "inf" separately."""
        return self._core.replaced()

    @property
    def device(self) -> str:
        """The GPU in use, and its driver; "" for the CPU."""
        return self._core.device()


def composite(*, look: Mapping | None = None, wave_map: np.ndarray | None = None,
              environment: np.ndarray | None = None, depth_kind: str = "eye", near: float = 0.0,
              far: float = 0.0, clip: str = "gl", looks_along_plus_z: bool = False,
              clip_y_down: bool = False, colorspace: str | Sequence[float] = "Rec.709",
              trusted: bool = False, threads: int = 0, simd: str = "", max_error: float = 0.0,
              runner: str = "fused", gpu: str = "", gpu_cache: str = "", **frame: Any) -> Any:
    """One frame with water in it: these keywords as in Compositor, all others as in Compositor.run.

    wet = composite(color=rgba, depth=z, camera=camera, water={}, look=load_look("realistic"))
    wet, parts = composite(..., aovs=["path", "stmap"])
    """
    compositor = Compositor(look=look, wave_map=wave_map, environment=environment, depth_kind=depth_kind,
                            near=near, far=far, clip=clip, looks_along_plus_z=looks_along_plus_z,
                            clip_y_down=clip_y_down, colorspace=colorspace, trusted=trusted,
                            threads=threads, simd=simd, max_error=max_error, runner=runner, gpu=gpu,
                            gpu_cache=gpu_cache)
    return compositor.run(**frame)


def operators() -> list[dict[str, Any]]:
    """The operators in the order in which they run, and last the parameters of the water as a whole.

    Each is {"name", "about", "reads", "parameters"}; a parameter {"name", "kind", "unit", "range",
    "choices", "columns", "default", "about"}, range None for words.
    """
    return _limpid.operators()


def roles() -> list[dict[str, Any]]:
    """The buffers that a frame may have: {"name", "channels", "missing", "about"}."""
    return _limpid.roles()


def aovs() -> list[dict[str, Any]]:
    """The AOVs that may be written besides the picture: {"name", "channels", "dry", "about"}.

    "channels" has a letter for each channel, "dry" is the value on dry pixels.
    """
    return _limpid.aovs()


def full_look(look: Mapping | None = None) -> dict[str, dict[str, Any]]:
    """All parameters as a dict of dicts: the defaults, overridden by `look`."""
    return _limpid.full_look(_plain(look))


def look_to_toml(look: Mapping | None = None) -> str:
    """full_look() as the text of a look file."""
    return _limpid.look_toml(_plain(look))


def load_look(look: str | os.PathLike) -> dict[str, dict[str, Any]]:
    """full_look() of a look file (*.toml), or of one of limpid's own looks and presets, by name.

    Omitted parameters are as in the look that the file's `base` names, or have their default. The
    file of the normal map, ["wave_normals"]["map"], becomes an absolute path. It is not read: the
    caller reads it and passes it as wave_map.
    """
    return _read_look(_look_path(os.fspath(look), pathlib.Path()), [])


def perspective(fov_y: float, aspect: float, near: float = 0.01, far: float = float("inf"),
                clip: str = "gl", shift: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """A projection: fov_y in radians, aspect = width / height, shift in picture halves."""
    return _limpid.perspective(fov_y, aspect, near, far, clip, shift)


def orthographic(width: float, height: float, near: float = 0.0, far: float = 1e4,
                 clip: str = "gl") -> np.ndarray:
    """A projection of width x height scene units."""
    return _limpid.orthographic(width, height, near, far, clip)


def look_at(eye: Sequence[float], target: Sequence[float],
            up: Sequence[float] = (0.0, 1.0, 0.0)) -> np.ndarray:
    """The view from eye towards target."""
    return _limpid.look_at(eye, target, up)


def _plain(look: Any) -> dict:
    """The look as dicts, from any mappings."""
    if look is None:
        return {}
    if not isinstance(look, Mapping):
        raise Error(f"look is a {type(look).__name__}, expected a dict of dicts")
    return {name: dict(table) if isinstance(table, Mapping) else table for name, table in look.items()}


def _present(planes: dict[str, Any]) -> dict[str, Any]:
    """Without optional planes that are None."""
    return {name: array for name, array in planes.items() if array is not None or name in ("color", "depth")}


def _scene(camera: Any, water: Any, sun: Any, sky_radiance: Any, time: Any) -> dict[str, Any]:
    try:
        view, projection = camera
    except (TypeError, ValueError):
        raise Error(f"camera is a {type(camera).__name__}, expected view and projection") from None
    return {"view": view, "projection": projection,
            "water": dict(water) if isinstance(water, Mapping) else water,
            "sun": dict(sun) if isinstance(sun, Mapping) else sun,
            "sky_radiance": sky_radiance, "time": time}


def _aov_arrays(wanted: Any) -> dict[str, np.ndarray | None]:
    if wanted is None:
        return {}
    if isinstance(wanted, str):
        raise Error(f"aovs is the str '{wanted}', expected a list of names")
    arrays = {}
    for name in wanted:
        parts = ["stmap.r", "stmap.g", "stmap.b"] if name == "stmap" else [name]
        array = wanted[name] if isinstance(wanted, Mapping) else None
        if name == "stmap" and array is not None:
            raise Error("aovs: stmap stands for three, expected arrays for stmap.r, stmap.g, stmap.b")
        arrays.update(dict.fromkeys(parts, array))
    return arrays


def _read_look(path: pathlib.Path, above: list[pathlib.Path]) -> dict[str, dict[str, Any]]:
    """`above` are the files of the looks that are based on this one."""
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        about, base = tables.pop("about", ""), tables.pop("base", None)
        if not isinstance(about, str):
            raise Error("about: expected a sentence")
        own = full_look(tables)  # refuses what it does not know, before a base is read
        if base is not None:
            own = full_look(_upon(_base_of(path, base, [*above, path]), tables, own))
    except (ValueError, OSError) as error:
        raise Error(f"{path}: {error}") from error
    if own["wave_normals"]["map"]:
        own["wave_normals"]["map"] = os.path.normpath(path.absolute().parent / own["wave_normals"]["map"])
    return own


def _base_of(path: pathlib.Path, base: Any, above: list[pathlib.Path]) -> dict[str, dict[str, Any]]:
    if not isinstance(base, str):
        raise Error("base: expected the name or the path of a look")
    file = _look_path(base, path.parent)
    if any(file.exists() and file.samefile(one) for one in above):
        raise Error(f"base = '{base}': expected a look that is not based on this one")
    return _read_look(file, above)


def _upon(base: dict, changes: dict, order: dict) -> dict:
    """The changes come last, as one parameter may set another; each table's in the order of its parameters."""
    tables = {}
    for name, keys in base.items():
        changed = {key: changes[name][key] for key in order[name] if key in changes.get(name, {})}
        tables[name] = {key: value for key, value in keys.items() if key not in changed} | changed
    return tables


def _look_path(name: str, origin: pathlib.Path) -> pathlib.Path:
    """`origin` is the base of relative paths."""
    if name.endswith(".toml") or os.sep in name:
        return origin / name
    installed = pathlib.Path(__file__).absolute().parents[4] / "share/limpid"
    folders = [pathlib.Path(folder) / kind for folder in (os.environ.get("LIMPID_DATA"), installed) if folder
               for kind in ("looks", "presets")]
    for folder in folders:
        if (folder / f"{name}.toml").is_file():
            return folder / f"{name}.toml"
    known = sorted({path.stem for folder in folders for path in folder.glob("*.toml")})
    raise Error(f"no look is named '{name}': expected " +
                (f"one of {', '.join(known)}" if known else "the path of a look file"))
