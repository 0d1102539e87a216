"""Runs the tests that reach a mutant, until one fails."""
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import threading

SLOWER, LEAST_SECONDS = 10, 5  # than the unchanged program: a mutant that runs longer has no end
ADDRESS_SPACE = 8 << 30


@dataclasses.dataclass
class Verdict:
    number: int
    state: str  # killed, survived, unreached, unchangeable
    change: int = 0  # 0 the first, 1 the second
    tests: int = 0  # that reach it
    by: str = ""  # the program that saw it, and the test


class Trial:
    def __init__(self, tree):
        self.tree = tree
        self.tests_folder = tree.build / tree.project.programs_folder
        self.record_file = tree.folder / "reached.json"

    def run(self, program, tests, environment, cpu_seconds, extra=()):
        """(exit status, CPU seconds, output) of a program in a folder of its own for temporary files."""
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
            # One that waits for ever uses no CPU.
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
        listed = subprocess.run([self.tests_folder / program, "--gtest_list_tests"], capture_output=True, text=True, check=True)
        tests, suite = [], ""
        for row in listed.stdout.splitlines():
            name = row.split("#")[0].strip()
            if row.startswith("  "):
                tests.append(suite + name)
            elif name.endswith("."):
                suite = name
        return [test for test in tests if "DISABLED_" not in test]

    def record_test(self, program, test):
        with tempfile.NamedTemporaryFile(prefix="reached-") as file:
            status, seconds, text = self.run(program, [test], {"LIMPID_MUTANTS_REACHED": file.name}, 600)
            content = pathlib.Path(file.name).read_bytes()
        return {"passed": status == 0, "seconds": seconds, "said": text[-1500:] if status else "",
                "reached": {str(number): value for number, value in enumerate(content) if value}}

    def record(self, say):
        """Runs each test of the unchanged programs alone; again only where the program is a new one."""
        known = json.loads(self.record_file.read_text()) if self.record_file.exists() else {}
        self.reached = {}
        with concurrent.futures.ThreadPoolExecutor(self.tree.jobs) as pool:
            for program in self.tree.project.programs:
                built = (self.tests_folder / program).stat().st_mtime_ns
                if known.get(program, {}).get("built") != built:
                    tests = self.list_tests(program)
                    records = dict(zip(tests, pool.map(lambda test: self.record_test(program, test), tests)))
                    known[program] = {"built": built, "tests": records}
                    self.record_file.write_text(json.dumps(known))
                self.reached[program] = {}
                for test, record in known[program]["tests"].items():
                    if record["passed"]:
                        self.reached[program][test] = record
                    else:
                        say(f"not used, it fails without a mutant: {program} {test}\n{record['said']}")
                seconds = sum(record["seconds"] for record in self.reached[program].values())
                say(f"{program}: {len(self.reached[program])} tests, {seconds:.0f} s")

    # ---- mutants

    def judge(self, number):
        plan, change = [], 0
        for program, tests in self.reached.items():
            values = {test: record["reached"].get(str(number), 0) for test, record in tests.items()}
            hits = [test for test, value in values.items() if value in (1, 2)]
            change = max([change, *values.values()])
            if hits:
                plan.append((sum(tests[test]["seconds"] for test in hits), program, hits))
        count = sum(len(hits) for _, _, hits in plan)
        if not plan:
            return Verdict(number, "unchangeable" if change == 3 else "unreached")
        which = 1 if change == 2 else 0
        for seconds, program, hits in sorted(plan):
            status, _, text = self.run(program, hits, {"LIMPID_MUTANT": str(number)}, LEAST_SECONDS + SLOWER * seconds,
                                       ["--gtest_fail_fast"])
            if status != 0:
                failed = [row for row in text.splitlines() if row.startswith("[  FAILED  ]")]
                how = failed[0].split("]")[1].split("(")[0].split(",")[0].strip() if failed else f"ended with {status}"
                return Verdict(number, "killed", which, count, f"{program} {how}")
        return Verdict(number, "survived", which, count)

    def judge_all(self, numbers):
        with concurrent.futures.ThreadPoolExecutor(self.tree.jobs) as pool:
            yield from pool.map(self.judge, numbers)
