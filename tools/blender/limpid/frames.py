"""Frame ranges in limpid's syntax: 12, 1-48, 1-48x2; several separated by commas."""
import re

from .words import Failure

MOST = 100000


def frames_of(text):
    """The numbers of a range, in its order, each once."""
    frames = {}
    for part in text.split(","):
        found = re.fullmatch(r"\s*(-?\d+)(?:-(-?\d+)(?:x(\d+))?)?\s*", part)
        if not found:
            raise Failure(f"frames '{text}': expected numbers and ranges, as in 1-48 or 1-48x2,60")
        first, last, step = int(found[1]), int(found[2] or found[1]), int(found[3] or 1)
        if last < first or step < 1:
            raise Failure(f"frames '{text}': expected ascending ranges, with steps of 1 or more")
        if len(range(first, last + 1, step)) > MOST:
            raise Failure(f"frames '{text}': expected at most {MOST} frames")
        frames.update(dict.fromkeys(range(first, last + 1, step)))
    if min(frames) < 0:
        raise Failure(f"frames '{text}': expected no frame below 0")
    return list(frames)


def numbered(name, frame):
    """`dry` at frame 7 is `dry.0007`, the name that limpid's `dry.####` has."""
    return f"{name}.{frame:04d}"


def counted(frames):
    return "1 frame" if frames == 1 else f"{frames} frames"


def neighbor_of(frame, motion):
    """The frame that motion vectors lead to: the `next` or the `previous` one."""
    return frame + 1 if motion == "next" else frame - 1


def camera_at(frame, bound):
    """The camera of the last marker up to the frame, else of the first; markers are (frame, camera), as
    bound to the timeline. None if no marker binds a camera."""
    bound = sorted(bound, key=lambda marker: marker[0])
    before = [camera for at, camera in bound if at <= frame]
    return before[-1] if before else bound[0][1] if bound else None
