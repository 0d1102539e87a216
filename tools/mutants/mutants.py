#!/usr/bin/env python3
"""Changes one operator, constant, bound or comparison of the code at a time and lists the changes that no test notices.

Called by `tools/dev mutants`; docs/mutants.md says when, and what it prints.
"""
import argparse
import collections
import dataclasses
import json
import os
import pathlib
import re
import sys
import time

import sites
import tree
import trial

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ["optics", "enter", "ops", "complete", "plan", "run", "embed", "articles", "shade", "raster", "allocations"]
SURVIVED = ("survived", "unreached")


@dataclasses.dataclass
class Project:
    root: pathlib.Path
    folders: list  # whose sources and headers are changed
    programs: list  # targets, which are GoogleTest programs
    programs_folder: str  # in the build
    cmake: list  # how it is configured
    support: str  # where mutant.cpp is put, so that every program has it
    checked: re.Pattern  # the sources that are compiled first, for syntax alone
    rewritten: dict  # file: (old, new)
    known: str  # the page with the survivors that are no fault, and why
    kept: str = ""  # the file with the places that are judged unless others are asked for, a tree.identity() a line


def limpid(programs=PROGRAMS):
    names = ["optics", "op", "ops", "plan", "run", "enter"]
    return Project(
        root=ROOT, folders=[f"{top}/{name}" for name in names for top in ("src", "include/limpid")
                            if (ROOT / top / name).is_dir()],
        programs=[f"test_{name}" for name in programs], programs_folder="tests",
        cmake=["-DLIMPID_SETS=none", "-DLIMPID_BENCH=OFF", "-DLIMPID_PYTHON=OFF"], support="src/core/mutant.cpp",
        checked=re.compile(r"^src/(optics|op|ops|plan|run|enter|shade)/"),
        rewritten={"src/CMakeLists.txt": ("set(LANES_OPTIMISED -O3)", "set(LANES_OPTIMISED -O1)")},
        known="docs/mutants.md", kept="tools/mutants/places.txt")


# ---- which

def all_sites(project):
    """All sites in order of kind and place; the number of a site is its index."""
    found = []
    for folder in project.folders:
        for path in sorted((project.root / folder).glob("*")):
            if path.suffix in (".h", ".cpp"):
                found += sites.Source(str(path.relative_to(project.root)), path.read_text()).sites()
    return sorted(found, key=lambda site: (site.kind, site.path, site.start))


def pick(everything, wanted, limit, seed):
    """Each n-th site for which `wanted` holds, so that each file and kind has its share."""
    candidates = [number for number, site in enumerate(everything) if wanted(site)]
    picked, by_path = {}, collections.defaultdict(list)
    step, offset = max(1.0, len(candidates) / limit), (seed * 0.618034) % 1
    for i in range(min(limit, len(candidates))):
        for number in candidates[int((i + offset) * step):int((i + 1 + offset) * step)]:
            site = everything[number]
            if not any(sites.overlaps(site, other) for other in by_path[site.path]):
                picked[number] = site
                by_path[site.path].append(site)
                break
    return picked


def kept(project, everything, say):
    """The sites of the project's list that still exist."""
    lines = (project.root / project.kept).read_text().splitlines()
    numbers = {tree.identity(site): number for number, site in enumerate(everything)}
    there = sorted(numbers[line] for line in lines if line in numbers)
    if len(there) < len(lines):
        say(f"{len(lines) - len(there)} places of {project.kept} are no longer in the code")
    return {number: everything[number] for number in there}


# ---- what the page says

def in_cell(text):
    """A text as a cell of a Markdown table."""
    return re.sub(r"\s+", " ", text.strip()).replace("|", "\\|")


def known_survivors(project):
    page = project.root / project.known
    rows = re.findall(r"^\| (\S+) \| `(.+?)` \| `(.*?)` \| (.+) \|$", page.read_text(), re.M) if page.exists() else []
    return {(path, was, becomes): reason for path, was, becomes, reason in rows}


def key_of(site, change):
    return (site.path, in_cell(site.text), in_cell(site.changed_line(change)))


# ---- the run

def show(site, verdict):
    reach = f"{verdict.tests} tests reach it" if verdict.tests else "no test reaches it"
    return f"{site.name}: {site.kind}, {reach}\n  - {site.text.strip()}\n  + {site.changed_line(verdict.change).strip()}"


def run(project, arguments, say=print):
    folder = project.root / "build" / "mutants"
    folder.mkdir(parents=True, exist_ok=True)
    results_file = folder / "results.json"
    everything = all_sites(project)
    beginnings = [os.path.relpath(pathlib.Path(path).resolve(), project.root) for path in arguments.paths]
    for path in beginnings:
        if not any(site.path == path or site.path.startswith(path + "/") for site in everything):
            raise tree.Refused(f"mutants {path}: expected a file or folder of {', '.join(project.folders)}")
    its_own = tree.Tree(project, folder, arguments.jobs)
    if arguments.seed is None and arguments.limit is None and not beginnings:
        picked = kept(project, everything, say)
    else:
        picked = pick(everything, lambda site: not beginnings or any(site.path == p or site.path.startswith(p + "/") for p in beginnings),
                      arguments.limit or 320, 1 if arguments.seed is None else arguments.seed)
    kinds = collections.Counter(site.kind for site in picked.values())
    say(f"{len(picked)} of {len(everything)} places in {len({site.path for site in picked.values()})} files: "
        + ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    begin = time.monotonic()
    its_own.write({number: site for number, site in picked.items() if tree.identity(site) not in its_own.left_out})
    its_own.configure()
    its_own.compile(say)
    say(f"built in {time.monotonic() - begin:.0f} s; {len(picked) - len(its_own.picked)} do not compile")
    judge = trial.Trial(its_own, arguments.seconds)
    judge.record(say)
    results = json.loads(results_file.read_text()) if results_file.exists() else {}
    identities = {number: tree.identity(everything[number]) for number in sorted(its_own.picked)}
    if arguments.again:
        identities = {number: identity for number, identity in identities.items() if results.get(identity, {}).get("state") in SURVIVED}
    elif not arguments.rest:
        results = {identity: last for identity, last in results.items() if identity not in identities.values()}
    begin = time.monotonic()
    numbers = [number for number, identity in identities.items() if arguments.again or identity not in results]
    for verdict in judge.judge_all(numbers, arguments.minutes):
        results[identities[verdict.number]] = dataclasses.asdict(verdict)
        results_file.write_text(json.dumps(results, indent=1))
        if arguments.verbose:
            say(f"{everything[verdict.number].name}: {verdict.state} {verdict.by}")
    say(f"judged in {time.monotonic() - begin:.0f} s")
    judged = [(everything[number], trial.Verdict(**results[identity])) for number, identity in identities.items() if identity in results]
    all_told = tell(project, judged, say)
    if len(judged) < len(identities):
        say(f"{len(identities) - len(judged)} are not judged yet: --rest")
    return 0 if all_told and len(judged) == len(identities) else 1


def tell(project, judged, say):
    """Lists the survivors, and returns whether the page explains all of them."""
    known, counts = known_survivors(project), collections.defaultdict(collections.Counter)
    for site, verdict in judged:
        state = "survive" if verdict.state in SURVIVED else verdict.state
        explained = state == "survive" and key_of(site, verdict.change) in known
        for name in (site.path.split("/")[-2], "all"):
            counts[name].update([state, "explained"] if explained else [state])
        if state == "survive" and not explained:
            say(show(site, verdict))
    for name, count in sorted(counts.items(), key=lambda item: (item[0] == "all", item[0])):
        say(f"{name}: {count['killed'] + count['survive']} mutants, {count['killed']} killed, {count['survive']} survive, "
            f"of which {project.known} explains {count['explained']}"
            + (f"; {count['unchangeable']} places whose types have no other operator" if count["unchangeable"] else ""))
    return counts["all"]["survive"] == counts["all"]["explained"]


def main(words):
    parser = argparse.ArgumentParser(prog="tools/dev mutants", description=__doc__.split("\n")[0])
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file or folder; all that mutants are made of, if none")
    parser.add_argument("--limit", type=int, metavar="N", help="of at most N places out of all, instead of those of tools/mutants/places.txt (320)")
    parser.add_argument("--seed", type=int, metavar="N", help="which of all, the same for the same N (1)")
    parser.add_argument("--again", action="store_true", help="only those that survived when last tried")
    parser.add_argument("--rest", action="store_true", help="only those that have not been tried, and tell of all")
    parser.add_argument("--minutes", type=float, metavar="N", help="judge for so long; --rest goes on")
    parser.add_argument("--seconds", type=float, metavar="N", help="of each mutant only the fastest tests that take N in all")
    parser.add_argument("--tests", type=lambda text: text.split(","), metavar="NAME,..",
                        help=f"with these test programs alone, of {' '.join(PROGRAMS)}")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="so many at once (all cores)")
    parser.add_argument("--verbose", action="store_true", help="say which test noticed which")
    arguments = parser.parse_args(words)
    if (arguments.limit is not None and arguments.limit < 1) or arguments.jobs < 1:
        parser.error("--limit and --jobs: expected 1 or more")
    unknown = set(arguments.tests or []) - set(PROGRAMS)
    if unknown:
        parser.error(f"--tests {','.join(sorted(unknown))}: expected some of {' '.join(PROGRAMS)}")
    try:
        return run(limpid(arguments.tests or PROGRAMS), arguments, lambda text: print(text, flush=True))
    except tree.Refused as refused:
        print(f"tools/dev mutants: {refused}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    sys.exit(main(sys.argv[1:]))
