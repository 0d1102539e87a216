"""Runs a program until this standard input closes: python until_closed.py PROGRAM WORD...

It closes when the Blender that started this ends for any reason, even if it was killed. Needs no Blender."""
import os
import subprocess
import sys
import threading


def end(process):
    while os.read(0, 1):
        pass
    process.terminate()


program = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL)
threading.Thread(target=end, args=(program,), daemon=True).start()
sys.exit(program.wait())
