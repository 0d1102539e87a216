"""A job, passed from the panel to the process that runs it: a JSON file."""
import dataclasses
import json
import pathlib
from dataclasses import dataclass, field

# Prefix of lines for the process that started the job: MARK KIND: TEXT.
MARK = "limpid job "


@dataclass
class Job:
    tool: str             # the program limpid
    look: str             # name, or look file
    folder: str           # of all outputs
    scene: str
    view_layer: str
    frames: list
    settings: list = field(default_factory=list)  # operator.parameter=value
    water: str = ""       # an object, or "" for a level plane everywhere
    height: float = 0.0   # of that plane
    waves: str = "LIMPID"  # or OBJECT: the waves of the object's mesh
    sun: str = ""         # a lamp, or "" for none
    reflection: bool = True
    below: bool = True
    shadow: bool = True
    surroundings: bool = True
    aovs: bool = True
    motion: str = ""      # vectors to the "next" or the "previous" frame, or none
    overscan: int = -1    # pixels on each side, or -1: the overscan of the plan
    samples: int = 0      # per pixel, or 0: the scene's sample count
    unfinished: str = ""  # a folder in `folder` for files that are not finished; the process that started the job removes it

    def write(self, path):
        pathlib.Path(path).write_text(json.dumps(dataclasses.asdict(self), indent=1))

    @staticmethod
    def read(path):
        return Job(**json.loads(pathlib.Path(path).read_text()))
