#!/usr/bin/env python3
"""How long the page of `limpid view` takes in a headless Chromium: to the first picture, and from a slider that moves to the
picture on the screen, of half size while it is dragged and of full size when it is released.

  desk_times.py LIMPID CHROMIUM [--times N] VIEW'S ARGUMENTS
"""
import argparse
import contextlib
import os
import pathlib
import statistics
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests/tools"))
from browser import Browser  # noqa: E402
from desk_page import MURKINESS, Desk  # noqa: E402

# The time from the event until the screen has been drawn with the next picture.
WATCH = """
window.watched = (kind) => new Promise((done) => document.addEventListener(kind, ({timeStamp}) => {
  desk.next().then(({half}) => requestAnimationFrame(() => setTimeout(() =>
      done({half, ms: performance.now() - timeStamp}))));
}, {capture: true, once: true}));
"""


def processor_ms(pid):
    """Of a process so far, all threads together: independent of what else runs."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return 1e3 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def median_and_best(numbers):
    return f"median {statistics.median(numbers):.0f} ms, best {min(numbers):.0f}, worst {max(numbers):.0f}"


def dragged(desk, times):
    half, full, spent = [], [], {True: 0.0, False: 0.0}
    x, y = desk.center(MURKINESS + " input[type=range]")
    for i in range(times):
        step = 1 + i % 2
        desk.browser.mouse("Pressed", x, y)
        begun = processor_ms(desk.server.pid)
        desk.run("window.moved = watched('input'); 0")
        desk.browser.mouse("Moved", x + 12 * step, y)
        shown = desk.run("moved")
        if shown["half"]:
            half.append(shown["ms"])
        between = processor_ms(desk.server.pid)
        spent[True] += between - begun
        desk.run("window.released = watched('change'); 0")
        desk.browser.mouse("Released", x + 20 * step, y)
        for_full = desk.run("released")
        while for_full["half"]:  # a half picture may come before it
            for_full = desk.run("(async () => { const begun = performance.now(); const {half} = await desk.next(); "
                                f"return {{half, ms: {for_full['ms']} + performance.now() - begun}}; }})()")
        full.append(for_full["ms"])
        spent[False] += processor_ms(desk.server.pid) - between
        desk.run("desk.idle()")
    return half, full, {kind: ms / times for kind, ms in spent.items()}


def main():
    words = argparse.ArgumentParser()
    words.add_argument("limpid")
    words.add_argument("chromium")
    words.add_argument("--times", type=int, default=20)
    asked, view = words.parse_known_args()
    print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder, Browser(asked.chromium) as browser:
        begun = time.monotonic()
        with contextlib.closing(Desk(asked.limpid, browser, folder, *view)) as desk:
            print(f"start of the tool to its first full picture: {1e3 * (time.monotonic() - begun):.0f} ms; "
                  f"of these in the page {desk.run('performance.now()'):.0f} ms")
            print("picture of", "x".join(map(str, desk.run("[desk.pixels().width, desk.pixels().height]"))))
            desk.run(WATCH)
            half, full, spent = dragged(desk, asked.times)
            if half:
                print("from drag to picture of half size:", median_and_best(half))
            print("from release to picture of full size:", median_and_best(full))
            print(f"processor time of the server, all threads: {spent[True]:.0f} ms until the picture of half size, "
                  f"{spent[False]:.0f} ms from there to that of full size")


if __name__ == "__main__":
    main()
