"""A second process, its output and its end. Needs no Blender."""
import os
import re
import signal
import subprocess
import threading

from .frames import counted
from .job import MARK

LINE = re.compile(MARK + r"(step|note|warning|wet|done|error): (.*)")


class Run:
    """Starts a program that reports its progress on standard output, by the lines of work.say().
    All of its output goes into a log. Its standard input closes when this process ends for any reason."""

    def __init__(self, words, log, environment=None):
        self.log = str(log)
        self.text, self.share = "starting", 0.0   # of progress: words, and 0 ... 1
        self.notes, self.warnings, self.wet = [], [], []
        self.error = None
        self.cancelled = False
        self._process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                         errors="replace", stdin=subprocess.PIPE, start_new_session=True,
                                         env=environment)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        with open(self.log, "w", encoding="utf-8") as log:
            for line in self._process.stdout:
                log.write(line)
                log.flush()
                self._hear(line)

    def _hear(self, line):
        found = LINE.fullmatch(line.rstrip("\n"))
        if not found:
            return
        kind, text = found.groups()
        if kind == "step":
            count, _, self.text = text.partition(" ")
            done, total = map(int, count.split("/"))
            self.share = done / max(total, 1)
        elif kind == "wet":
            self.wet.append(int(text))
        elif kind == "error":
            self.error = text
        else:
            (self.warnings if kind == "warning" else self.notes).append(text)

    def is_running(self):
        return self._process.poll() is None or self._reader.is_alive()

    def wait(self):
        self._process.wait()
        self._reader.join()

    def cancel(self):
        """Ends the process and its children."""
        self.cancelled = True
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGTERM)

    def failure(self):
        """After its end: a sentence about its error, or None."""
        if self.cancelled:
            return f"cancelled: {counted(len(self.wet))} finished"
        status = self._process.returncode
        if status == 0:
            return None
        if self.error:
            return self.error
        how = f"was ended by signal {-status}" if status < 0 else f"ended with status {status}"
        return f"the second Blender {how}; see {self.log}"
