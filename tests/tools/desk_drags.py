#!/usr/bin/env python3
"""Drags sliders of the page of `limpid view` at random, with undo, other looks and other pictures in between, like an
impatient user. The server may not grow, nothing may be refused, and in the end the picture has the bytes of the tool's own.

  desk_drags.py LIMPID DATA CHROMIUM [--drags N] [--minutes M] [--seed S] [VIEW'S ARGUMENTS]

Prints the server's resident memory as it goes. With --minutes it drags for so long instead of N times. The second half begins
again with the random numbers of the first: other settings may need more memory, the same settings may not.
"""
import argparse
import contextlib
import json
import pathlib
import random
import re
import sys
import tempfile
import time

from browser import Browser
from desk_page import CTRL, SHIFT, Desk, expect

HALF = 0.5    # of the drags
LEAK = 1.05   # of the most memory that the server had before
SLACK = 8     # MB, that an allocator may keep for itself


def memory(pid):
    """Of a process, resident, in MB."""
    return int(re.search(r"VmRSS:\s+(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text())[1]) / 1024


class Dragger:
    def __init__(self, desk, seed):
        self.desk, self.seed, self.dragged = desk, seed, {}
        desk.run("document.querySelectorAll('#fields details').forEach((group) => { group.open = true; }); 0")
        desk.run("window.refusals = []; new MutationObserver(() => refusals.push(textOf('note')))"
                 ".observe(document.getElementById('notes'), {attributes: true, attributeFilter: ['data-bad']}); 0")
        self.sliders = desk.run("""[...document.querySelectorAll("#fields input[type=range]")].map((bar) => bar.id)""")
        self.looks = desk.run("[...document.getElementById('look').options].map((option) => option.value)")
        self.shows = desk.run("[...document.getElementById('show').options].map((option) => option.value)")

    def begin(self):
        self.chance = random.Random(self.seed)
        self.desk.run(f"choose('look', '{self.looks[0]}')")
        self.desk.run(f"choose('show', '{self.shows[0]}')")

    def warm_up(self):
        """Shows all that there is: what the server keeps for it is no leak."""
        for control, words in (("look", self.looks), ("show", self.shows)):
            for word in [*words[1:], words[0]]:
                self.desk.run(f"choose('{control}', '{word}')")
        self.settle()

    def drag(self):
        desk, chance = self.desk, self.chance
        slider = chance.choice(self.sliders)
        selector = f'[id="{slider}"]'
        box = desk.run(f"boxOf({json.dumps(selector)})")
        y = box["top"] + box["height"] / 2

        def place():
            return box["left"] + chance.uniform(0.02, 0.98) * box["width"]

        desk.browser.mouse("Pressed", place(), y)
        for _ in range(chance.randint(2, 12)):
            desk.browser.mouse("Moved", place(), y + chance.uniform(-9, 9))
        desk.browser.mouse("Released", place(), y)
        self.dragged[slider] = self.dragged.get(slider, 0) + 1

    def do_something_else(self):
        desk, chance = self.desk, self.chance
        what = chance.randrange(6)
        if what == 0:
            desk.browser.key("z", 90, CTRL)
        elif what == 1:
            desk.browser.key("Z", 90, CTRL + SHIFT)
        elif what == 2:
            desk.run(f"choose('look', '{chance.choice(self.looks)}')")
        elif what == 3:
            desk.run(f"choose('show', '{chance.choice(self.shows)}')")
        elif what == 4:
            desk.run(f"choose('against', '{chance.choice(('', 'dry', 'look fast'))}')")
        else:
            desk.browser.key(chance.choice("f1+-"), 70)

    def settle(self):
        self.desk.run("desk.idle()")
        said = self.desk.run("refusals.splice(0).filter((sentence) => document.getElementById('notes').hasAttribute('data-bad'))")
        if said or not self.desk.run("document.getElementById('gone').hidden"):
            sys.exit(f"after {sum(self.dragged.values())} drags, with {self.desk.run('desk.state')}: {said or 'the tool has ended'}")


def main():
    words = argparse.ArgumentParser()
    for name in ("limpid", "data", "chromium"):
        words.add_argument(name)
    words.add_argument("--drags", type=int, default=200)
    words.add_argument("--minutes", type=float)
    words.add_argument("--seed", type=int, default=1)
    asked, view = words.parse_known_args()
    view = view or ["--scene", f"{asked.data}/plates/lagoon/lagoon.toml"]
    if not pathlib.Path(asked.chromium).is_file():
        sys.exit("no browser: install chromium (tools/dev setup) and configure anew")
    with tempfile.TemporaryDirectory() as folder, Browser(asked.chromium) as browser, \
            contextlib.closing(Desk(asked.limpid, browser, folder, *view)) as desk:
        dragger = Dragger(desk, asked.seed)
        dragger.warm_up()
        begun, done, samples, halves = time.monotonic(), 0, [], 0

        def share():
            return (time.monotonic() - begun) / 60 / asked.minutes if asked.minutes else done / asked.drags

        while share() < 1:
            if halves == 0 or (halves == 1 and share() >= HALF):
                dragger.begin()
                halves += 1
            dragger.drag()
            if dragger.chance.random() < 0.15:
                dragger.do_something_else()
            if dragger.chance.random() < 0.3:
                dragger.settle()
            done += 1
            samples.append((share(), memory(desk.server.pid)))
            if done % 100 == 0:
                print(f"{done} drags, {desk.run('desk.asked')} pictures asked for, {desk.run('desk.broken')} broken off, "
                      f"the server has {samples[-1][1]:.0f} MB", flush=True)
        dragger.settle()
        desk.run("choose('show', 'picture')")
        warm = max(mb for at, mb in samples if at <= HALF)
        end = max(mb for at, mb in samples if at > HALF)
        print(f"{done} drags of {len(dragger.dragged)} sliders: {desk.run('desk.asked')} pictures asked for; "
              f"at most {warm:.0f} MB in the first half, {end:.0f} MB in the second")
        expect(end <= LEAK * warm + SLACK, True, "the server does not grow")
        desk.tools_picture(desk.copied_command())
        expect(desk.differing("tools"), 0, "the picture in the end is the tool's, to the byte")
        if browser.errors:
            sys.exit("the page's script threw: " + "\n".join(map(str, browser.errors)))


if __name__ == "__main__":
    main()
