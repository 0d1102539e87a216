#!/usr/bin/env python3
"""Tries tools/mutants on a project with a header and a test program: it must notice changes of checked results, and list
changes of code that tests run without a check, and of code that no test runs.

  mutants_test.py
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/mutants"))
import mutants  # noqa: E402
import sites  # noqa: E402
import trial  # noqa: E402
import tree  # noqa: E402

HEADER = """#pragma once
#include <algorithm>
#include <array>

constexpr int kSize = 2;
constexpr double kGain = 0.5;

constexpr double with_gain(double x) { return x * kGain; }
static_assert(with_gain(2) < 2);

inline double looked_at(double x, bool wet) {
  constexpr double kLeast = 0.25;
  const std::array<double, kSize> table{kLeast, 4};
  // A comment changes nothing: 1 + 1 < 2.
  return wet && !(x < 0) ? std::max(x - table[1], table[0]) : -x;
}
inline double run_alone(double x) { return x + 3; }
inline double never_run(double x) { return x * 5; }

inline unsigned count_to(unsigned end) {
  unsigned steps = 0;
  for (unsigned i = 0; i != end; i += 1) steps = steps + 1;
  return steps;
}
"""

TEST = """#include <gtest/gtest.h>
#include "optics/tiny.h"

TEST(Tiny, IsLookedAt) {
  EXPECT_EQ(looked_at(6, true), 2);
  EXPECT_EQ(looked_at(0.5, true), 0.25);
  EXPECT_EQ(looked_at(1, false), -1);
  EXPECT_EQ(looked_at(-1, true), 1);
  EXPECT_EQ(looked_at(6, true) * 2, with_gain(8));
  EXPECT_EQ(count_to(3), 3u);
}
TEST(Tiny, IsRunAlone) { run_alone(1); }
TEST(Tiny, FailsAsItIs) { FAIL() << "and is not used"; }
"""

CMAKE = """cmake_minimum_required(VERSION 3.25)
project(tiny LANGUAGES CXX)
find_package(GTest REQUIRED)
set(CMAKE_CXX_STANDARD 20)
file(GLOB sources src/*/*.cpp tests/*.cpp)
add_executable(test_tiny ${sources})
target_include_directories(test_tiny PRIVATE src)
target_link_libraries(test_tiny GTest::gtest_main)
"""


def expect(what, is_so):
    if not is_so:
        raise SystemExit(f"mutants_test: not so: {what}")


def check_sites():
    source = sites.Source("src/optics/tiny.h", HEADER)
    found = {(site.line, site.old): site for site in source.sites()}
    expect("operators, constants and bounds are found",
           {(15, "&&"), (15, "!"), (15, "<"), (15, "-"), (15, "std::max"), (17, "+"), (17, "3"), (22, "!="), (22, "+=")} <= set(found))
    expect("comments, conditions of the compiler and what is between brackets stay",
           not {line for line, _ in found} & {9, 14} and (15, "1") not in found)
    expect("a constant that is changed is none", found[6, "0.5"].unfreeze[2] == "const" and found[6, "0.5"].thawed == "kGain")
    expect("a constant function stays one", found[8, "*"].constant and not found[15, "<"].constant)
    expect("another number of the same type",
           [sites.other_number(text) for text in ("0", "7", "0.5f", "0.0", "1e3")] == ["1", "8", "0.75f", "1.0", "1500.0"])
    expect("numbers that only guard others stay", [sites.is_guard(text) for text in ("1e-30", "1e30f", "0", "1e-5", "99999")]
           == [True, True, False, False, False])
    whole = source.with_changes(list(enumerate(source.sites())))
    expect("lines keep their places", whole.count("\n") == HEADER.count("\n"))
    expect("a change within a change is written twice", len(re.findall(r"number<\d+, false>\(0,", whole.split("\n")[14])) == 2)
    expect("brackets of templates are none",
           not [s for s in sites.Source("x.h", "auto a = std::get<1>(f<A, 2>(b)) ;\ntemplate <class T, int N = 3>\nT g(T&& x);\n").sites()])
    expect("an operand ends where a looser operator begins",
           "(a || (limpid_mutants::on<0, false>() ? (b || c) : (b && c)))" in re.sub(" +", " ", one_change("if (a || b && c) d();", "&&")))


def one_change(text, old):
    source = sites.Source("x.cpp", "void f() {\n" + text + "\n}\n")
    return source.with_changes([(0, next(site for site in source.sites() if site.old == old))])


def check_run(root):
    for name, text in {"src/optics/tiny.h": HEADER, "src/optics/tiny.cpp": '#include "optics/tiny.h"\n', "tests/tiny_test.cpp": TEST, "CMakeLists.txt": CMAKE, ".gitignore": "/build/\n"}.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    subprocess.run(["git", "init", "-q", root], check=True)
    project = mutants.Project(root=root, folders=["src/optics"], programs=["test_tiny"], programs_folder="", cmake=[],
                              support="src/core/mutant.cpp", checked=re.compile("^src/optics/"), rewritten={}, known="docs/known.md")
    options = {"paths": [], "limit": 100, "seed": 1, "again": False, "rest": False, "minutes": None, "seconds": None, "jobs": 2, "verbose": False}
    trial.LEAST_SECONDS = 1  # the unchanged program takes far less

    def run(**changed):
        said = []
        verdict = mutants.run(project, argparse.Namespace(**{**options, **changed}), said.append)
        return verdict, "\n".join(said)

    verdict, said = run()
    expect(f"there are survivors, and the verdict says it:\n{said}", verdict == 1)
    survivors = set(re.findall(r"^src/optics/tiny\.h:(\d+):\d+: (\w+), (\w+)", said, re.M))
    expect(f"what is run or never run survives, and nothing else:\n{said}",
           survivors == {("17", "arithmetic", "1"), ("17", "constant", "1"), ("18", "arithmetic", "no"), ("18", "constant", "no")})
    expect("old and new are shown", "- inline double run_alone(double x) { return x + 3; }\n"
           "  + inline double run_alone(double x) { return x - 3; }" in said)
    expect(f"a size of an array cannot be changed:\n{said}", "does not compile: src/optics/tiny.h:5:23: constexpr int kSize = 3;" in said)
    expect("a test that fails as it is tells nothing", "not used, it fails without a mutant: test_tiny Tiny.FailsAsItIs" in said)
    results = json.loads((root / "build/mutants/results.json").read_text())
    expect("the others were noticed, one that has no end among them",
           sum(result["state"] == "killed" for result in results.values()) == len(results) - 4
           and any(name.endswith("|+=") and result["state"] == "killed" for name, result in results.items()))

    page = root / "docs/known.md"
    page.parent.mkdir()
    row = "| src/optics/tiny.h | `inline double run_alone(double x) { return x + 3; }` | `inline double run_alone(double x) { return x %s; }` | because |\n"
    page.write_text("| file | is | becomes | why no test can notice |\n|---|---|---|---|\n" + row % "- 3" + row % "+ 4")
    verdict, said = run(again=True)
    expect(f"what the page explains is not listed again:\n{said}",
           "run_alone" not in said and verdict == 1 and "4 survive, of which docs/known.md explains 2" in said)
    (root / "tests/tiny_test.cpp").write_text(TEST + "TEST(Tiny, IsRunAtLast) { EXPECT_EQ(never_run(2), 10); }\n")
    verdict, said = run(again=True)
    expect(f"a sharper test notices:\n{said}", verdict == 0 and "4 mutants" in said and "2 killed, 2 survive" in said)
    everything = mutants.all_sites(project)
    picks = [list(mutants.pick(everything, lambda site: True, 5, seed)) for seed in (1, 1, 2)]
    expect("as many as are asked for, always the same, others of another seed",
           len(picks[0]) == 5 and picks[0] == picks[1] != picks[2])
    expect("of several kinds", len({everything[number].kind for number in picks[0]}) > 2)
    project.kept = "tests/places.txt"
    gone = "src/optics/tiny.h|return x - y;|10|-"
    (root / project.kept).write_text("".join(f"{place}\n" for place in [*(tree.identity(everything[n]) for n in picks[0]), gone]))
    header = root / "src/optics/tiny.h"
    header.write_text("// One more line.\n" + header.read_text())
    said, moved = [], mutants.all_sites(project)
    there = mutants.kept(project, moved, said.append)
    expect("kept places are found wherever their lines have gone",
           [(moved[n].line - 1, moved[n].old) for n in there] == [(everything[n].line, everything[n].old) for n in sorted(picks[0])])
    expect("and what is gone is told", said == ["1 places of tests/places.txt are no longer in the code"])
    try:
        run(paths=[str(root / "tests")])
        expect("a path without mutants is refused", False)
    except tree.Refused as refused:
        expect("and the folders are named", str(refused).endswith("expected a file or folder of src/optics"))


def check_project():
    project = mutants.limpid()
    for name, (old, new) in project.rewritten.items():
        expect(f"{name} still has what is written anew for mutants", old in (project.root / name).read_text())


check_sites()
check_project()
with tempfile.TemporaryDirectory() as folder:
    check_run(pathlib.Path(folder).resolve())
print("mutants_test: all is so")
