"""The start of the second Blender: blender -b COPY.blend --python start_work.py -- JOB.json

This process ends when its standard input closes, and so with the Blender that started it. That Blender removes the folders of
the job. If it was killed, this process removes them as far as it can."""
import importlib
import json
import os
import pathlib
import shutil
import signal
import sys
import threading


def end_with_the_other():
    while os.read(0, 1):
        pass
    try:
        job = pathlib.Path(sys.argv[-1])
        for folder in (json.loads(job.read_text())["unfinished"], job.parent):
            shutil.rmtree(folder, ignore_errors=True)
    finally:
        os.killpg(0, signal.SIGKILL)


threading.Thread(target=end_with_the_other, daemon=True).start()
package = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(package.parent))
importlib.import_module(f"{package.name}.work").main()
