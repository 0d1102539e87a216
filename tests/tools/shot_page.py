#!/usr/bin/env python3
"""Opens the page that `limpid report PLATE...` writes in a headless browser, from its file, and uses it like a user, by
wipe, choices and keys. The screen is compared with the pictures beside the page.

  shot_page.py LIMPID DATA CHROMIUM
"""
import base64
import json
import pathlib
import subprocess
import sys
import tempfile

from browser import BYTES_OF, Browser

HELPERS = r"""
window.boxOf = (selector) => {
  const node = document.querySelector(selector);
  node.scrollIntoView({block: "center"});
  const {left, top, width, height} = node.getBoundingClientRect();
  return {left, top, width, height};
};
window.choose = async (side, file) => {
  const node = document.getElementById(side);
  node.value = file;
  if (node.value !== file) throw new Error(`${side} has no ${file}`);
  node.dispatchEvent(new Event("change", {bubbles: true}));
  await document.getElementById(side === "left" ? "other" : "picture").decode();
};
"""


def expect(found, expected, what):
    if found != expected:
        sys.exit(f"{what}: expected {expected!r}, found {found!r}")
    print("ok:", what)


class Page:
    def __init__(self, browser, folder):
        self.browser, self.folder = browser, folder
        self.report = json.loads((folder / "report.json").read_text())
        browser.open((folder / "index.html").as_uri())
        browser.run(BYTES_OF + HELPERS)

    def run(self, script):
        return self.browser.run(script)

    def keep(self, name, png):
        """The bytes of the picture of this name in the page."""
        self.run(f"bytesOf('{base64.b64encode(png).decode()}').then((bytes) => {{ window.{name} = bytes; }})")

    def keep_file(self, name, file):
        self.keep(name, (self.folder / file).read_bytes())

    def keep_screen(self):
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.keep("shot", base64.b64decode(self.browser.call("Page.captureScreenshot", format="png")["data"]))

    def center(self, selector):
        box = self.run(f"boxOf({json.dumps(selector)})")
        return box["left"] + box["width"] / 2, box["top"] + box["height"] / 2


def layout(page, width):
    page.browser.resize(width, 900)
    seen = page.run("""(() => {
      const name = (node) => `${node.tagName} ${node.id} '${node.textContent.trim().slice(0, 30)}'`;
      const wide = [...document.body.querySelectorAll("*")].filter((node) =>
          !node.parentElement.closest(".scroll, #stage, option, select") &&
          node.getBoundingClientRect().right > window.innerWidth + 1);
      return {wide: wide.map(name), page: document.documentElement.scrollWidth,
              stage: document.getElementById("stage").getBoundingClientRect().height,
              slots: [...document.querySelectorAll("[data-slot]")].filter((slot) => slot.childNodes.length === 0)
                  .map((slot) => slot.dataset.slot)};
    })()""")
    expect(seen["wide"], [], f"nothing is wider than a window of {width} pixels")
    expect(seen["page"] <= width, True, "nor is the page")
    expect(seen["stage"] > 150, True, "the stage has room")
    expect([slot for slot in seen["slots"] if slot != "differs"], [], "no place of the page is empty")


def tables(page):
    report = page.report
    rows = page.run("""Object.fromEntries(["looks", "operators"].map((id) =>
        [id, [...document.querySelectorAll(`#${id} tbody tr`)].map((row) => [...row.cells].map((cell) => cell.textContent))]))""")
    expect([row[0] for row in rows["looks"]], [row["look"] for row in report["looks"]] + ["dry"], "a row a look, and the dry plate")
    expect([row[0] for row in rows["operators"]], [row["operator"] for row in report["operators"]], "a row an operator")
    numbers = page.run("""[...document.querySelectorAll("#operators tbody tr")].map((row) => Number(row.cells[5].dataset.v))""")
    expected = [row["without_beside_shot"]["error"]["mean"] for row in report["operators"] if row["runs"]]
    expect([n for n in numbers if n is not None and n == n], expected, "what leaving each out changes is report.json's")
    first = page.run("document.querySelector('header ul').textContent")
    expect(f"{report['looks'][0]['look']}" in first and "ms" in first, True, "the summary names the look and its time")


def pictures(page):
    page.run("document.querySelectorAll('img').forEach((image) => { image.loading = 'eager'; })")
    broken = page.run("""Promise.all([...document.images].map((image) =>
        image.decode().then(() => null, () => image.getAttribute("src")))).then((all) => all.filter((one) => one))""")
    expect(broken, [], "all pictures are there")
    count = page.run("document.querySelectorAll('#aovs img').length")
    expect(count, sum(picture["group"] == "aovs" for picture in page.report["pictures"]), "a picture an AOV")


def wipe(page, left, right):
    """Shows one pixel of the picture per pixel of the screen, and drags the line by the mouse."""
    page.run(f"choose('left', '{left}').then(() => choose('right', '{right}'))")
    page.keep_file("leftBytes", left)
    page.keep_file("rightBytes", right)
    page.run("document.getElementById('full').click()")
    x, y = page.center("#wipe_line")
    page.browser.mouse("Pressed", x, y)
    page.browser.mouse("Moved", x - 53, y)
    page.browser.mouse("Released", x - 53, y)
    expect(abs(page.center("#wipe_line")[0] - (x - 53)) < 1, True, "the line of a wipe is dragged")
    page.keep_screen()
    counts = page.run("""(() => {
      const stage = document.getElementById("stage").getBoundingClientRect();
      const sheet = document.getElementById("picture").getBoundingClientRect();
      const line = document.getElementById("wipe_line").getBoundingClientRect(), middle = line.left + line.width / 2;
      const counts = {left: 0, right: 0, wrong: 0, differs: 0};
      for (let y = Math.ceil(stage.top) + 40; y < stage.bottom - 10; ++y) {
        for (let x = Math.ceil(stage.left); x < stage.right - 1; ++x) {
          const px = x - Math.round(sheet.left), py = y - Math.round(sheet.top);
          if (px < 0 || py < 0 || px >= leftBytes.width || py >= leftBytes.height || Math.abs(x - middle) < 14) continue;
          const isLeft = x < middle, from = isLeft ? leftBytes : rightBytes, at = 4 * (py * leftBytes.width + px);
          ++counts[isLeft ? "left" : "right"];
          for (let c = 0; c < 3; ++c) {
            counts.wrong += shot.data[4 * (y * shot.width + x) + c] !== from.data[at + c];
            counts.differs += leftBytes.data[at + c] !== rightBytes.data[at + c];
          }
        }
      }
      return counts;
    })()""")
    if min(counts["left"], counts["right"], counts["differs"]) < 20000:
        sys.exit(f"a wipe shows too little to tell: {counts}")
    expect(counts["wrong"], 0, f"the screen has {left} left of the line and {right} right of it, to the byte")


def keys_and_clicks(page):
    zoom = "Number(document.getElementById('zoom').textContent.split(' ')[0])"
    page.run("document.getElementById('stage').focus()")
    page.browser.key("1", 49)
    expect(page.run(zoom), 100, "1 shows a pixel on each of the screen")
    page.browser.key("+", 187)
    expect(page.run(zoom), 200, "+ makes it larger")
    for _ in range(3):
        page.browser.key("-", 189)
    expect(page.run(zoom), 25, "- makes it smaller")
    page.browser.key("f", 70)
    expect(page.run(zoom) > 100, True, "F fits")
    page.browser.click(*page.center("#aovs figure:nth-child(2) button"))
    name = page.run("document.querySelector('#aovs figure:nth-child(2) img').getAttribute('src')")
    expect(page.run("document.getElementById('right').value"), name, "a click takes a picture to the right of the wipe")
    expect(page.run("document.getElementById('picture').getAttribute('src')"), name, "and shows it")
    page.run("document.querySelector('#operators a.see').click()")
    expect(page.run("document.getElementById('right').value.startsWith('without_')"), True, "so does an operator's name")


def main():
    limpid, data, chromium = sys.argv[1:]
    if not pathlib.Path(chromium).is_file():
        sys.exit("no browser: install chromium (tools/dev setup) and configure anew")
    with tempfile.TemporaryDirectory() as folder, Browser(chromium) as browser:
        plate, truth, page = f"{folder}/pool.exr", f"{folder}/wet.exr", pathlib.Path(folder) / "page"
        pool = f"{data}/scenes/pool.toml"
        subprocess.run([limpid, "render", pool, "--size", "480x270", "-o", plate, "-q"], check=True)
        subprocess.run([limpid, "truth", pool, "--size", "480x270", "--light", "once", "-o", truth, "-q"], check=True)
        subprocess.run([limpid, "report", plate, "--truth", truth, "--rounds", "1", "-o", str(page), "-q"], check=True)
        opened = Page(browser, page)
        for width in (1400, 420):
            layout(opened, width)
        browser.resize(1400, 900)
        tables(opened)
        pictures(opened)
        wipe(opened, "dry.png", "wet.png")
        keys_and_clicks(opened)
        if browser.errors:
            sys.exit("the page's script threw: " + "\n".join(map(str, browser.errors)))


if __name__ == "__main__":
    main()
