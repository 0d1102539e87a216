"""A copy of the project in which each of the picked sites can be changed while it runs, and its test programs."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess

import sites

HERE = pathlib.Path(__file__).resolve().parent
POLITE = ["nice", "-n", "10"]  # building; the tests run last of all


class Refused(Exception):
    """An error whose text is printed unchanged."""


class Tree:
    """`project` has what differs between projects: see mutants.py. `folder` keeps the copy, its build and what is known of it."""

    def __init__(self, project, folder, jobs):
        self.project, self.jobs = project, jobs
        self.folder = pathlib.Path(folder).resolve()
        self.source, self.build = self.folder / "tree", self.folder / "build"
        self.left_out_file = self.folder / "left_out.json"
        self.left_out = set(json.loads(self.left_out_file.read_text())) if self.left_out_file.exists() else set()

    # ---- the copy

    def files(self):
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                                cwd=self.project.root, capture_output=True, text=True)
        if listed.returncode != 0:
            raise Refused(f"{self.project.root}: git lists no files: {listed.stderr.strip()}")
        return [name for name in listed.stdout.split("\0") if name and (self.project.root / name).is_file()]

    def write(self, picked):
        """`picked` maps numbers to sites. Writes only changed files, since the build goes by times."""
        self.picked = dict(picked)
        self.is_new = False  # whether a mutant is there that has never been compiled
        by_path = {}
        for number, site in picked.items():
            by_path.setdefault(site.path, []).append((number, site))
        self.sources = {path: sites.Source(path, (self.project.root / path).read_text()) for path in by_path}
        kept = set()
        for name in self.files():
            kept.add(name)
            target = self.source / name
            if name in by_path:
                self.is_new |= put(target, in_force(self.sources[name].with_changes(by_path[name])))
            elif name in self.project.rewritten:
                old, new = self.project.rewritten[name]
                text = (self.project.root / name).read_text()
                if old not in text:
                    raise Refused(f"{name}: expected '{old}', which is written anew for mutants")
                put(target, text.replace(old, new).encode())
            else:
                put(target, (self.project.root / name).read_bytes())
                shutil.copymode(self.project.root / name, target)
        for name in (self.project.support, "mutant.h"):
            kept.add(name)
            put(self.source / name, (HERE / pathlib.Path(name).name).read_bytes())
        for path in [path for path in self.source.rglob("*") if path.is_file()]:
            if str(path.relative_to(self.source)) not in kept:
                path.unlink()

    def write_again(self, dropped):
        """Leaves out the sites that do not compile."""
        for number in dropped:
            site = self.picked.pop(number)
            self.left_out.add(identity(site))
            rest = [(other, s) for other, s in self.picked.items() if s.path == site.path]
            put(self.source / site.path, in_force(self.sources[site.path].with_changes(rest)))
        self.left_out_file.write_text(json.dumps(sorted(self.left_out), indent=1))

    # ---- its build

    def configure(self):
        command = ["cmake", "--log-level=WARNING", "-S", self.source, "-B", self.build, "-G", "Ninja",
                   "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1",
                   "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                   f"-DCMAKE_CXX_FLAGS=-I{self.source} -w -Wno-narrowing -D_GLIBCXX_ASSERTIONS",
                   *self.project.cmake]
        run = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if run.returncode != 0:
            raise Refused(f"the copy cannot be configured:\n{(run.stdout + run.stderr)[-2000:]}")

    def compile(self, say):
        """Builds until all files compile: sites that break the build are left out."""
        environment = {**os.environ, "CCACHE_DISABLE": "1"}  # no two copies are alike
        if self.is_new:
            self.check_syntax(say)
        targets = list(self.project.programs)
        while True:
            run = subprocess.run([*POLITE, "cmake", "--build", str(self.build), "--parallel", str(self.jobs), "--target",
                                  *targets, "--", "-k", "0"], capture_output=True, text=True, env=environment)
            if run.returncode == 0:
                return
            self.leave_out(run.stdout + run.stderr, say)

    def check_syntax(self, say):
        """Compiles the fast files first, alone: a faulty header would otherwise be compiled a hundred times."""
        commands = [entry for entry in json.loads((self.build / "compile_commands.json").read_text())
                    if self.project.checked.search(os.path.relpath(entry["file"], self.source))
                    and "LIMPID_LANES_TARGET" not in entry["command"].replace("LIMPID_LANES_TARGET=scalar", "")]
        while commands:
            running, failed, output = [], [], ""
            waiting = list(commands)
            while waiting or running:
                while waiting and len(running) < self.jobs:
                    entry = waiting.pop()
                    words = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
                    words = words[:words.index("-o")] + words[words.index("-o") + 2:] + ["-fsyntax-only"]
                    running.append((entry, subprocess.Popen([*POLITE, *words], cwd=entry["directory"], text=True,
                                                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)))
                entry, process = running.pop(0)
                said = process.communicate()[1]
                if process.returncode != 0:
                    failed.append(entry)
                    output += said
            if failed:
                self.leave_out(output, say)
            commands = failed

    def leave_out(self, output, say):
        dropped = self.blamed(output)
        if not dropped:
            raise Refused(f"the copy does not compile, and no mutant is to blame:\n{output[-6000:]}")
        for number in sorted(dropped):
            say(f"does not compile: {self.picked[number].name}: {self.picked[number].changed_line().strip()}")
        self.write_again(dropped)

    def blamed(self, output):
        """The mutants that cause the compiler's errors: for each error the nearest line with a mutant."""
        lines = {}
        for number, site in self.picked.items():
            first, last = site.span()
            text = self.sources[site.path].text
            for line in range(text.count("\n", 0, first) + 1, text.count("\n", 0, last) + 2):
                lines.setdefault((site.path, line), set()).add(number)
        thawed = [(number, site.thawed) for number, site in self.picked.items() if site.thawed]
        dropped, context, unexplained = set(), [], False
        for row in output.splitlines():
            match = re.match(r"(?:In file included from |\s+from )?(\S+?):(\d+)(?::\d+)?[:,]? *(.*)", row)
            if match:
                path = pathlib.Path(os.path.normpath(self.build / match[1]))
                place = (str(path.relative_to(self.source)) if path.is_relative_to(self.source) else "", int(match[2]))
            if match and "error:" in match[3]:
                found = next((lines[p] for p in [place, *context] if p in lines), set())
                dropped |= found
                unexplained, context = not found, []
            elif match and ("required from" in match[3] or "required by" in match[3]):
                context.append(place)
            elif match and unexplained and "note:" in match[3] and place in lines:
                dropped |= lines[place]
                unexplained = False
            if unexplained:  # a constant that is none any more is told of by its name
                named = {number for number, name in thawed if re.search(rf"\b{name}\b", row)}
                dropped |= named
                unexplained = not named
        return dropped


def in_force(text):
    return f'#include "mutant.h"\n#line 1\n{text}'.encode()


def put(path, content):
    """Writes a file; returns whether its content changed."""
    if path.is_file() and path.read_bytes() == content:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return True


def identity(site):
    """A key of the site that stays the same when lines are inserted before it."""
    return f"{site.path}|{site.text.strip()}|{site.column}|{site.old}"
