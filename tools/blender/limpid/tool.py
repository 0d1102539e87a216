"""The tool limpid: its path, its looks, and its output."""
import os
import pathlib
import re
import shutil
import subprocess

from .words import Failure


def find_tool(path=""):
    """The program: the path in the preferences, else limpid on PATH."""
    if path:
        if not os.path.isfile(path) or not os.access(path, os.X_OK):
            raise Failure(f"no program at '{path}': expected limpid (Preferences > Add-ons > limpid)")
        return os.path.abspath(path)
    found = shutil.which("limpid")
    if not found:
        raise Failure("limpid is not on PATH: install limpid, or give its path in Preferences > Add-ons > limpid")
    return found


def _listed(tool):
    """The looks as the verb `looks` lists them: a name, two spaces or more, a sentence. Empty for a tool without
    that verb."""
    try:
        ran = subprocess.run([tool, "looks"], capture_output=True, text=True, timeout=20, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.TimeoutExpired):
        return []
    if ran.returncode != 0:
        return []
    return re.findall(r"^ *([a-z][a-z0-9_-]*)(?: {2,}.*)?$", ran.stdout, re.M)


def _in_folders(tool):
    folders = [pathlib.Path(tool).resolve().parent.parent / "share/limpid/looks"]
    if data := os.environ.get("LIMPID_DATA"):
        folders.insert(0, pathlib.Path(data) / "looks")
    return sorted({file.stem for folder in folders for file in folder.glob("*.toml")})


def look_names(tool):
    """The looks that come with the tool, by name; `physical`, its default, first."""
    names = _listed(tool) or _in_folders(tool)
    return sorted(dict.fromkeys(names), key=lambda name: name != "physical")


def last_sentence(said):
    """The tool's last sentence, without its name; "" if there is none."""
    lines = [line for line in said.splitlines() if line.strip()]
    return re.sub(r"^limpid( ERROR)?: ", "", lines[-1]) if lines else ""


def run_tool(words, log):
    """Runs the tool and returns its standard output. Throws Failure with the tool's sentence. All of its
    output goes into the log, too."""
    try:
        ran = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    except OSError as fault:
        raise Failure(f"{words[0]}: {fault.strerror}") from fault
    log(f"{' '.join(words)}\n{ran.stdout}{ran.stderr}")
    if ran.returncode != 0:
        raise Failure(last_sentence(ran.stderr) or f"limpid ended with status {ran.returncode} and no message")
    return ran.stdout, [line.partition("warning: ")[2] for line in ran.stderr.splitlines() if "warning: " in line]
