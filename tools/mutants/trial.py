"""Runs the tests that reach a mutant, until one fails."""
import concurrent.futures
import dataclasses
import json
import math
import os
import pathlib
import resource
import shlex
import shutil
import signal
import subprocess
import tempfile
import threading
import time

SLOWER, LEAST_SECONDS = 10, 5  # than the unchanged program: a mutant that runs longer has no end
ADDRESS_SPACE = 8 << 30
FIRST, SECOND, UNCHANGEABLE = 1, 2, 3  # Reached in mutant.h


@dataclasses.dataclass
class Verdict:
    number: int
    state: str  # killed, survived, unreached, unchangeable
    change: int = 0  # 0 the first, 1 the second
    tests: int = 0  # that reach it
    by: str = ""  # the program that saw it, and the test


class Trial:
    def __init__(self, tree, most_seconds=None):
        self.tree, self.most_seconds = tree, most_seconds or math.inf  # of the tests of a mutant
        self.tests_folder = tree.build / tree.project.programs_folder
        self.record_file = tree.folder / "reached.json"

    def run(self, program, tests, environment, cpu_seconds, extra=()):
        """(exit status, CPU seconds, output) of a program with a separate folder for temporary files."""
        scratch = tempfile.mkdtemp(prefix="mutant-")

        def limit():
            os.nice(max(0, 19 - os.nice(0)))
            resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_seconds) + 1, int(cpu_seconds) + 2))
            resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen(
                [str(self.tests_folder / program), f"--gtest_filter={':'.join(tests)}", "--gtest_brief=1", *extra],
                cwd=self.tests_folder, stdout=output, stderr=subprocess.STDOUT, preexec_fn=limit, start_new_session=True,
                env={**os.environ, "TMPDIR": scratch, "TEST_TMPDIR": scratch, **environment})
            # A program that waits forever uses no CPU time.
            alarm = threading.Timer(60 + 40 * cpu_seconds, lambda: os.killpg(process.pid, signal.SIGKILL))
            alarm.start()
            _, status, usage = os.wait4(process.pid, 0)
            alarm.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read().decode(errors="replace")
        shutil.rmtree(scratch, ignore_errors=True)
        return process.returncode, usage.ru_utime + usage.ru_stime, text

    # ---- what reaches what

    def list_tests(self, program):
        """Each test's name, and the modification times of its program's shared code and of its own source."""
        objects = {}
        for entry in json.loads((self.tree.build / "compile_commands.json").read_text()):
            words = shlex.split(entry["command"])
            object_file = pathlib.Path(entry["directory"], words[words.index("-o") + 1])
            if f"{program}.dir" in object_file.parts:
                objects[entry["file"]] = object_file.stat().st_mtime_ns
        with tempfile.NamedTemporaryFile(prefix="tests-") as file:
            subprocess.run([self.tests_folder / program, "--gtest_list_tests", f"--gtest_output=json:{file.name}"],
                           stdout=subprocess.DEVNULL, check=True)
            suites = json.loads(pathlib.Path(file.name).read_text())["testsuites"]
        sources = {f"{suite['name']}.{test['name']}": test["file"] for suite in suites for test in suite["testsuite"]}
        shared = [built for source, built in objects.items() if source not in sources.values()]
        shared += [library.stat().st_mtime_ns for library in self.tree.build.rglob("*.a")]
        return {test: [max(shared), objects[source]] for test, source in sources.items() if "DISABLED_" not in test}

    def record_test(self, program, test, built):
        with tempfile.NamedTemporaryFile(prefix="reached-") as file:
            status, seconds, text = self.run(program, [test], {"LIMPID_MUTANTS_REACHED": file.name}, 600)
            content = pathlib.Path(file.name).read_bytes()
        return {"built": built, "passed": status == 0, "seconds": seconds, "said": text[-1500:] if status else "",
                "reached": {str(number): value for number, value in enumerate(content) if value}}

    def record(self, say):
        """Runs each test of the unchanged programs alone; again only after recompilation."""
        known = json.loads(self.record_file.read_text()) if self.record_file.exists() else {}
        self.reached = {}
        with concurrent.futures.ThreadPoolExecutor(self.tree.jobs) as pool:
            for program in self.tree.project.programs:
                tests, before = self.list_tests(program), known.get(program, {})
                known[program] = {test: before[test] for test, built in tests.items() if before.get(test, {}).get("built") == built}
                new = [test for test in tests if test not in known[program]]
                for test, record in zip(new, pool.map(lambda test: self.record_test(program, test, tests[test]), new)):
                    known[program][test] = record
                if new:
                    self.record_file.write_text(json.dumps(known))
                for test, record in known[program].items():
                    if not record["passed"]:
                        say(f"not used, it fails without a mutant: {program} {test}\n{record['said']}")
                self.reached[program] = {test: record for test, record in known[program].items() if record["passed"]}
                seconds = sum(record["seconds"] for record in self.reached[program].values())
                say(f"{program}: {len(self.reached[program])} tests, {seconds:.0f} s")

    # ---- mutants

    def rounds(self, number):
        """The tests that come by a place, the fastest first: a round is (seconds, program, tests), and all rounds together
        take as long as those before it, for most mutants are noticed by any test."""
        hits = sorted((record["seconds"], program, test) for program, tests in self.reached.items()
                      for test, record in tests.items() if record["reached"].get(str(number)) in (FIRST, SECOND))
        budget, spent, by_program = 1, 0, {}
        for seconds, program, test in hits:
            if spent and spent + seconds > self.most_seconds:
                break
            if spent + seconds > budget and by_program:
                yield from by_program.values()
                budget, by_program = 2 * (spent + seconds), {}
            spent += seconds
            before, _, tests = by_program.get(program, (0, program, []))
            by_program[program] = (before + seconds, program, [*tests, test])
        yield from by_program.values()

    def judge(self, number):
        values = {record["reached"].get(str(number), 0) for tests in self.reached.values() for record in tests.values()}
        rounds = list(self.rounds(number))
        if not rounds:
            return Verdict(number, "unchangeable" if UNCHANGEABLE in values else "unreached")
        which, count = (1 if SECOND in values else 0), sum(len(tests) for _, _, tests in rounds)
        for seconds, program, tests in rounds:
            status, _, text = self.run(program, tests, {"LIMPID_MUTANT": str(number)}, LEAST_SECONDS + SLOWER * seconds,
                                       ["--gtest_fail_fast"])
            if status != 0:
                failed = [row for row in text.splitlines() if row.startswith("[  FAILED  ]")]
                how = failed[0].split("]")[1].split("(")[0].split(",")[0].strip() if failed else f"ended with {status}"
                return Verdict(number, "killed", which, count, f"{program} {how}")
        return Verdict(number, "survived", which, count)

    def judge_all(self, numbers, minutes=None):
        """As many as can be begun in so many minutes."""
        end = time.monotonic() + 60 * minutes if minutes else math.inf
        with concurrent.futures.ThreadPoolExecutor(self.tree.jobs) as pool:
            for verdict in pool.map(lambda number: self.judge(number) if time.monotonic() < end else None, numbers):
                if verdict:
                    yield verdict
