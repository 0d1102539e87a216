#!/usr/bin/env python3
"""Drives the page of `limpid view` in a headless browser, by mouse and keys, like a user. Pictures and files of the page
are compared with those of the command line, byte by byte.

  desk_page.py LIMPID DATA CHROMIUM
"""
import base64
import contextlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

from browser import BYTES_OF, Browser

# Functions that the checks need in the page.
HELPERS = r"""
window.differing = (a, b) => {
  if (a.width !== b.width || a.height !== b.height) return `${a.width}x${a.height}, not ${b.width}x${b.height}`;
  let count = 0;
  for (let i = 0; i < a.data.length; ++i) count += a.data[i] !== b.data[i];
  return count;
};
window.boxOf = (selector) => {
  const node = document.querySelector(selector);
  node.scrollIntoView({block: "nearest"});
  const {left, top, width, height} = node.getBoundingClientRect();
  return {left, top, width, height};
};
window.textOf = (id) => document.getElementById(id).textContent;
window.choose = (id, value) => {
  const node = document.getElementById(id);
  node.value = value;
  if (node.value !== value) throw new Error(`${id} has no ${value}`);
  node.dispatchEvent(new Event("change", {bubbles: true}));
  return desk.idle();
};
// The next message in the element; clearing the old message does not count.
window.told = (id) => new Promise((done) =>
    new MutationObserver((_, observer) => {
      if (textOf(id) === "") return;
      observer.disconnect();
      done(textOf(id));
    }).observe(document.getElementById(id), {childList: true, characterData: true, subtree: true}));
"""

# Half of the light, with red and blue swapped.
OCIO_CONFIG = """ocio_profile_version: 1
roles: {default: lin_rec709, scene_linear: lin_rec709}
displays:
  screen:
    - !<View> {name: half, colorspace: half}
    - !<View> {name: swapped, colorspace: swapped}
colorspaces:
  - !<ColorSpace> {name: lin_rec709}
  - !<ColorSpace>
    name: half
    from_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: swapped
    from_reference: !<MatrixTransform> {matrix: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}
"""

MURKINESS = '.field[data-key="depth_fog.murkiness"]'
CTRL, SHIFT = 2, 8


def expect(found, expected, what):
    if found != expected:
        sys.exit(f"{what}: expected {expected!r}, found {found!r}")
    print("ok:", what)


def expect_in(part, text, what):
    if part not in text:
        sys.exit(f"{what}: expected {part!r} in {text!r}")
    print("ok:", what)


class Desk:
    """A running `limpid view`, and its page in a browser."""

    def __init__(self, limpid, browser, folder, *arguments):
        limpid = os.path.abspath(limpid)  # it also runs in the folder
        self.limpid, self.browser, self.folder = limpid, browser, pathlib.Path(folder)
        self.server = subprocess.Popen([limpid, "view", "--no-browser", "--folder", folder, *arguments],
                                       stdout=subprocess.PIPE, text=True)
        browser.open(self.server.stdout.readline().strip())
        browser.run("import(document.querySelector('script[type=module]').src).then(() => desk.idle())")
        browser.run(BYTES_OF + HELPERS)

    def close(self):
        self.server.kill()
        self.server.wait()
        self.server.stdout.close()

    def run(self, script):
        return self.browser.run(script)

    def keep(self, name):
        self.run(f"window.{name} = desk.pixels(); 0")

    def differing(self, name):
        """The number of values of the picture that differ from the picture kept under this name."""
        return self.run(f"differing(desk.pixels(), {name})")

    def center(self, selector, across=0.5):
        box = self.run(f"boxOf({json.dumps(selector)})")
        return box["left"] + across * box["width"], box["top"] + box["height"] / 2

    def click(self, selector):
        self.browser.click(*self.center(selector))

    def enter(self, selector, text):
        """Replaces the text of a field by typing, with Enter at the end."""
        self.click(selector)
        self.run(f"document.querySelector({json.dumps(selector)}).select()")
        self.browser.type(text)
        self.browser.key("Enter", 13)
        self.run("desk.idle()")

    def tools_picture(self, command, *options):
        """Makes the preview of a command line with these options, and keeps it in the page as `tools`."""
        preview = self.folder / "preview.png"
        words = shlex.split(command)
        words[words.index("-o") + 1] = str(self.folder / "wet.exr")
        subprocess.run([self.limpid, *words[1:], "--preview", preview, *options], check=True, cwd=self.folder,
                       capture_output=True)
        text = base64.b64encode(preview.read_bytes()).decode()
        self.run(f"bytesOf('{text}').then((bytes) => {{ window.tools = bytes; }})")

    def copied_command(self):
        self.run("window.copied = told('command_told'); 0")
        self.click("#command")
        self.run("copied")
        command = self.run("document.getElementById('command_text').value")
        self.click("#command_close")
        return command


def slider_by_the_mouse(desk):
    desk.keep("first")
    before = desk.run("desk.state.set")
    expect(before, {}, "the page begins without settings")
    x, y = desk.center(MURKINESS + " input[type=range]")
    desk.run("window.shown = desk.next(); 0")
    desk.browser.mouse("Pressed", x, y)
    for step in range(1, 6):
        desk.browser.mouse("Moved", x + 8 * step, y)
    expect(desk.run("shown.then(({half}) => half)"), True, "half pictures come while a slider is dragged")
    desk.browser.mouse("Released", x + 40, y)
    desk.run("desk.idle()")
    murkiness = desk.run("desk.state.set['depth_fog.murkiness']")
    if not 0.55 < murkiness < 0.8:
        sys.exit(f"a slider dragged from its middle to the right: murkiness {murkiness}")
    if desk.differing("first") == 0:
        sys.exit("a slider was dragged, and the picture is the same")
    expect(desk.run("document.getElementById('draft').hidden"), True, "a full picture is shown when all is still")
    shown = "document.getElementById('first:depth_fog.water_type').value"
    expect(desk.run(shown), "case_1", "the page shows what murkiness brings with it")
    desk.keep("dragged")
    command = desk.copied_command()
    expect_in(f"depth_fog.murkiness={murkiness:g}", command, "the command line has what was dragged")
    desk.tools_picture(command)
    expect(desk.differing("tools"), 0, "the canvas has the bytes of the tool's preview")


def undo_and_redo(desk):
    desk.browser.key("z", 90, CTRL)
    desk.run("desk.idle()")
    expect(desk.run("desk.state.set"), {}, "a drag is one step of undo")
    expect(desk.differing("first"), 0, "undo brings the picture back")
    expect(desk.run("document.getElementById('first:depth_fog.water_type').value"), "II", "and the type of water")
    desk.browser.key("Z", 90, CTRL + SHIFT)
    desk.run("desk.idle()")
    expect(desk.differing("dragged"), 0, "redo brings it again")


def presets(desk):
    for control in ("look", "against"):
        groups = desk.run(f"""Object.fromEntries([...document.querySelectorAll("#{control} optgroup")].map((group) =>
            [group.label, [...group.children].map((option) => option.textContent)]))""")
        expect(groups["presets"], ["basin", "creek", "harbour", "lake_at_dusk", "open_sea", "pool"],
               f"{control} lists the presets")
        expect_in("physical", groups["looks"], f"{control} lists the looks beside them")
    expect_in("murky", desk.run("document.querySelector('#look option[value=harbour]').title"), "a preset says what it is")
    first = desk.run("[...document.querySelectorAll('[data-group=First] .field')].map((field) => field.dataset.key)")
    expect(first[:3], ["depth_fog.murkiness", "wave_normals.wind", "depth_fog.sediment"],
           "murkiness, wind and brightness are the first sliders")
    desk.run("choose('look', 'harbour')")
    slider = "document.getElementById('first:depth_fog.sediment')"
    expect(desk.run(f"Number({slider}.closest('.field').querySelector('input.number').value)"), 10,
           "a slider stands where the preset has it")
    desk.tools_picture(desk.copied_command())
    expect(desk.differing("tools"), 0, "a preset is shown as the tool has it, to the byte")
    desk.keep("harbour")
    desk.run("desk.set('depth_fog.sediment', 40)")
    desk.run("desk.idle()")
    if desk.differing("harbour") == 0:
        sys.exit("four times the sediment changes nothing")
    desk.run("choose('look', 'physical')")


def parameters_without_effect(desk):
    """The plate has normals of its own, which no parameter of the look's waves changes."""
    why = "document.getElementById('first:wave_normals.strength').closest('.field').querySelector('.why').textContent"
    expect(desk.run(why), "no effect: model plate: the frame has surface normals", "a parameter that the plate overrules says so")
    expect(desk.run(why.replace("wave_normals.strength", "caustics.strength")), "", "others say nothing")


def wipe(desk):
    desk.run("choose('show', 'dry')")
    desk.keep("dry")
    desk.run("choose('show', 'picture')")
    desk.run("choose('against', 'dry')")
    desk.run("document.activeElement.blur()")
    desk.browser.key("1", 49)  # one pixel of the picture per pixel of the screen
    x, y = desk.center("#wipe_line")
    desk.browser.mouse("Pressed", x, y)
    desk.browser.mouse("Moved", x - 61, y)
    desk.browser.mouse("Released", x - 61, y)
    line = desk.center("#wipe_line")[0]
    expect(abs(line - (x - 61)) < 1, True, "the line of a wipe is dragged")
    shot = desk.browser.call("Page.captureScreenshot", format="png")["data"]
    desk.run(f"bytesOf('{shot}').then((bytes) => {{ window.shot = bytes; }})")
    # The tested pixels lie below the labels beside the line, above the lower end of the stage, and not on the line.
    counts = desk.run("""(() => {
      const stage = boxOf("#stage"), sheet = document.getElementById("picture").getBoundingClientRect();
      const line = boxOf("#wipe_line"), middle = line.left + line.width / 2;
      const counts = {left: 0, right: 0, wrong: 0, differs: 0};
      const wet = desk.pixels();
      for (let y = Math.ceil(stage.top) + 40; y < stage.top + stage.height - 10; ++y) {
        for (let x = Math.ceil(stage.left); x < stage.left + stage.width; ++x) {
          const px = x - Math.round(sheet.left), py = y - Math.round(sheet.top);
          if (px < 0 || py < 0 || px >= wet.width || py >= wet.height || Math.abs(x - middle) < 14) continue;
          const isLeft = x < middle, from = isLeft ? dry : wet, at = 4 * (py * wet.width + px);
          ++counts[isLeft ? "left" : "right"];
          for (let c = 0; c < 3; ++c) {
            counts.wrong += shot.data[4 * (y * shot.width + x) + c] !== from.data[at + c];
            counts.differs += dry.data[at + c] !== wet.data[at + c];
          }
        }
      }
      return counts;
    })()""")
    if min(counts["left"], counts["right"]) < 50000 or counts["differs"] < 50000:
        sys.exit(f"a wipe shows too little to tell: {counts}")
    expect(counts["wrong"], 0, "the screen has dry left of a wipe's line and wet right of it, to the byte")
    desk.run("choose('against', '')")
    desk.browser.key("f", 70)


def pinch(desk):
    desk.browser.key("1", 49)
    x, y = desk.center("#stage")
    sheet = "document.getElementById('picture').getBoundingClientRect()"

    def touch(kind, *places):
        points = [{"x": x + dx, "y": y + dy, "id": id} for id, (dx, dy) in enumerate(places)]
        desk.browser.call("Input.dispatchTouchEvent", type="touch" + kind, touchPoints=points)

    # The point between the fingers, in coordinates of the picture.
    between = desk.run(f"[({x} + 20 - {sheet}.left), ({y} - {sheet}.top)]")
    touch("Start", (-30, 0), (70, 0))
    touch("Move", (-80, 0), (120, 0))
    touch("End")
    expect(desk.run("textOf('zoom')"), "200 %", "two fingers twice as far apart show it twice as large")
    after = desk.run(f"[({x} + 20 - {sheet}.left) / 2, ({y} - {sheet}.top) / 2]")
    expect(max(abs(a - b) for a, b in zip(between, after)) <= 1, True, "what lies between them stays there")
    left = desk.run(f"{sheet}.left")
    touch("Start", (0, 0))
    touch("Move", (-40, 0))
    touch("End")
    expect(desk.run(f"{sheet}.left") - left, -40, "one finger moves it")
    desk.browser.key("f", 70)


def aov_and_numbers(desk):
    desk.keep("wet")
    desk.run("choose('show', 'transmittance')")
    if desk.differing("wet") == 0:
        sys.exit("transmittance looks as the picture does")
    desk.run("document.getElementById('numbers').click()")
    desk.run("window.numbers = told('pixel_box'); 0")
    desk.browser.mouse("Moved", *desk.center("#stage", 0.3))
    # The numbers in the table's row, rounded; a share of 0 ... 1 is shown as 0 ... 255.
    found = desk.run("""numbers.then(() => {
      const cells = [...document.querySelectorAll("#pixel_box tr")].find((row) =>
          row.cells[0].textContent === "transmittance").cells;
      const [x, y] = document.querySelector("#pixel_box caption").textContent.match(/\\d+/g).map(Number);
      const pixels = desk.pixels(), at = 4 * (y * pixels.width + x);
      return {numbers: [1, 2, 3].map((i) => Number(cells[i].textContent)), bytes: [...pixels.data.slice(at, at + 3)]};
    })""")
    off = [abs(255 * number - byte) for number, byte in zip(found["numbers"], found["bytes"])]
    if max(off) > 0.6 or max(found["numbers"]) in (0, 1):  # half a step, and the rounding of the numbers
        sys.exit(f"transmittance at a wet pixel: {found}")
    print("ok: an AOV shows the numbers that are told of its pixel")
    desk.run("document.getElementById('numbers').click()")
    desk.run("choose('show', 'picture')")
    expect(desk.differing("wet"), 0, "the picture comes back after an AOV")


def bad_values(desk):
    number = MURKINESS + " input.number"
    before = desk.run(f"document.querySelector('{number}').value")
    for text, sentence in (("4", "depth_fog.murkiness = 4: expected 0 ... 1"),
                           ("murky", "depth_fog.murkiness = 'murky': expected a number")):
        desk.enter(number, text)
        expect_in(sentence, desk.run("textOf('note')"), f"'{text}' is refused in words")
        expect(desk.run(f"document.querySelector('{number}').value"), before, f"what was there before '{text}' is back")
    expect(desk.differing("wet"), 0, "bad values change no picture")
    desk.run("desk.set('depth_fog.murkiness', 0.25)")
    desk.run("desk.idle()")
    expect(desk.run("document.getElementById('notes').hasAttribute('data-bad')"), False, "a good value ends the complaint")


def saving(desk):
    desk.keep("wet")
    desk.click("#save")
    for button, sentence in (("#save_form button[type=submit]", "Saved: "), ("#save_form button[type=submit]", "my_look.toml"),
                             ("#save_replace", "Saved: ")):
        desk.run("window.answer = told('save_told'); 0")
        desk.click(button)
        expect_in(sentence, desk.run("answer"), f"{button} tells")
        isThere = desk.run("!document.getElementById('save_replace').hidden")
        expect(isThere, sentence == "my_look.toml", "it asks before a file is replaced")
    desk.click("#save_close")
    words = shlex.split(desk.copied_command())
    for option in ("--set", "--look"):
        while option in words:
            at = words.index(option)
            del words[at:at + 2]
    desk.tools_picture(shlex.join([*words, "--look", str(desk.folder / "my_look.toml")]))
    expect(desk.differing("tools"), 0, "the saved look makes the same picture")


def views_of_a_config(desk, config):
    expect(desk.run("[...document.getElementById('display').options].map((option) => option.value)"),
           ["screen/half", "screen/swapped", "sRGB"], "the page offers the views of a config, and sRGB")
    expect(desk.run("document.getElementById('display').offsetWidth > 0"), True, "they are seen")
    for view in ("screen/half", "screen/swapped", "sRGB"):
        desk.run(f"choose('display', '{view}')")
        options = ["--display", view] if view == "sRGB" else ["--ocio", config, "--display", view]
        desk.tools_picture(desk.copied_command(), *options)
        expect(desk.differing("tools"), 0, f"{view} is shown as the tool has it, to the byte")


def large_plate(desk):
    desk.run("window.askedBefore = desk.asked; 0")
    desk.run("for (let i = 1; i <= 50; ++i) desk.set('depth_fog.murkiness', i / 100)")
    desk.run("desk.idle()")
    asked = desk.run("desk.asked - askedBefore")
    expect(1 <= asked <= 3, True, f"50 changes of a 4K plate come to {asked} requests")
    expect(desk.run("[desk.pixels().width, desk.pixels().height]"), [3840, 2160], "the picture is full")
    desk.tools_picture(desk.copied_command())
    expect(desk.differing("tools"), 0, "the last of 50 changes is shown, to the byte")


def broken_off(desk):
    """Changes a parameter while the full-size picture is computed: a half-size picture follows, never the old one."""
    shown = desk.run("""(async () => {
      const before = desk.broken;
      desk.set('depth_fog.murkiness', 0.7);
      const first = await desk.next();  // half; the whole one has been asked for
      desk.set('depth_fog.murkiness', 0.2);
      const second = await desk.next();
      return [first.half, second.half, desk.broken - before];
    })()""")
    expect(shown, [True, True, 1], "a whole picture is broken off for a newer half one")
    desk.run("desk.idle()")
    desk.tools_picture(desk.copied_command())
    expect(desk.differing("tools"), 0, "the picture after one that was broken off is the tool's, to the byte")


def server_gone(desk):
    desk.server.kill()
    desk.server.wait()
    expect(desk.run("document.getElementById('gone').hidden"), True, "nothing is told before")
    desk.run("desk.set('depth_fog.murkiness', 0.9)")
    desk.run("desk.idle()")
    expect(desk.run("document.getElementById('gone').hidden"), False, "that the tool has ended is told")
    desk.click("#try_again")
    desk.run("desk.idle()")
    expect(desk.run("document.getElementById('gone').hidden"), False, "and told again when asked again")
    expect(desk.run("desk.state.set['depth_fog.murkiness']"), 0.9, "what was set stays")


def main():
    limpid, data, chromium = sys.argv[1:]
    if not pathlib.Path(chromium).is_file():
        sys.exit("no browser: install chromium (tools/dev setup) and configure anew")
    with tempfile.TemporaryDirectory() as folder, Browser(chromium) as browser:
        with contextlib.closing(Desk(limpid, browser, folder, "--scene", f"{data}/plates/lagoon/lagoon.toml")) as desk:
            expect(desk.run("document.getElementById('display').offsetWidth"), 0, "without a config there is no view")
            for check in (slider_by_the_mouse, undo_and_redo, presets, parameters_without_effect, wipe, pinch, aov_and_numbers, bad_values, saving, server_gone):
                check(desk)
        config = f"{folder}/tiny.ocio"
        pathlib.Path(config).write_text(OCIO_CONFIG)
        with contextlib.closing(Desk(limpid, browser, folder, "--scene", f"{data}/plates/lagoon/lagoon.toml", "--ocio",
                                     config)) as desk:
            views_of_a_config(desk, config)
        plate = f"{folder}/pool.exr"
        subprocess.run([limpid, "render", f"{data}/scenes/pool.toml", "--size", "3840x2160", "-o", plate], check=True,
                       capture_output=True)
        with contextlib.closing(Desk(limpid, browser, folder, plate)) as desk:
            large_plate(desk)
            broken_off(desk)
        if browser.errors:
            sys.exit("the page's script threw: " + "\n".join(map(str, browser.errors)))


if __name__ == "__main__":
    main()
