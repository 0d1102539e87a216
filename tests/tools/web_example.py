#!/usr/bin/env python3
"""Runs the page of the web example in a headless browser, and compares its picture with the tool's.

  web_example.py PYTHON MAKE_PAGE LIMPID SCENE CHROMIUM
"""
import pathlib
import re
import subprocess
import sys
import tempfile

# Limits on the mean difference, and on the share of values that are off by more than .001: where waves or the edges of
# shadows decide by a rounding, `physical` is.
MOST_MEAN, MOST_FAR = {"realistic": 2e-6, "physical": 6e-6}, 1e-3


def main():
    python, make_page, limpid, scene, chromium = sys.argv[1:]
    if not pathlib.Path(chromium).is_file():
        sys.exit("no browser: install chromium (tools/dev setup) and configure anew")
    for look in ("realistic", "physical"):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.html"
            subprocess.run([python, make_page, scene, page, "--look", look, "--limpid", limpid, "--check"], check=True)
            shown = subprocess.run(
                [chromium, "--headless", "--no-sandbox", f"--user-data-dir={folder}/profile", "--use-gl=angle",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=120000", "--dump-dom",
                 page.as_uri()], capture_output=True, text=True, check=True)
        found = re.search(r"mean difference (\S+), off by more than 0.001: (\d+) of (\d+)", shown.stdout)
        if not found:
            sys.exit(f"{look}: the page says nothing\n{shown.stderr}")
        mean, far, values = float(found[1]), int(found[2]), int(found[3])
        print(f"{look}: {found[0]}")
        if not (mean <= MOST_MEAN[look] and far <= MOST_FAR * values):
            sys.exit(f"{look}: expected a mean of {MOST_MEAN[look]} and a share of {MOST_FAR} at most")


if __name__ == "__main__":
    main()
