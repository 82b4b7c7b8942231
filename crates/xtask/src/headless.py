"""Runs LinuxCNC without a screen or hardware, with a script in the place of its screen.

Needs Debian's package linuxcnc-uspace. What a machine is, and what the script does, is told by those who import this.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

INI = """[EMC]
VERSION = 1.1
MACHINE = gcheck
DEBUG = 0
[DISPLAY]
DISPLAY = ./script.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = machine.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = machine.tbl
[HAL]
HALFILE = machine.hal
"""

# How a script speaks to the control, and brings it to where it takes commands.
SCRIPT = r'''#!/usr/bin/python3
import json, os, subprocess, time, linuxcnc
job = json.load(open("job.json"))
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
def do(act, *arguments, wait=5):
    act(*arguments)
    command.wait_complete(wait)
time.sleep(1)
do(command.state, linuxcnc.STATE_ESTOP_RESET)
do(command.state, linuxcnc.STATE_ON)
for joint in range(job["joints"]):
    do(command.home, joint)
'''

LIMITS = "MAX_VELOCITY = {speed}\nMAX_ACCELERATION = {accel}\nMIN_LIMIT = -10000\nMAX_LIMIT = 10000\n"
JOINT = "TYPE = {kind}\nFERROR = {off}\nMIN_FERROR = {off}\nHOME = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"


def need():
    """Ends with a message where the control is not installed."""
    if not shutil.which("linuxcnc"):
        sys.exit("linuxcnc is not installed (Debian: linuxcnc-uspace)")


def sections(axes, speed, accel, off):
    """Each axis and its joint; `off` is how far a joint may be from where it is told to be."""
    limits = LIMITS.format(speed=speed, accel=accel)
    text = ""
    for joint, axis in enumerate(axes):
        kind = "ANGULAR" if axis in "ABC" else "LINEAR"
        text += f"[AXIS_{axis}]\n{limits}[JOINT_{joint}]\n{limits}{JOINT.format(kind=kind, off=off)}"
    return text


def run(ini, hal, script, job, tools, out):
    """What the script wrote to the file `out`, empty where it wrote none, and what the control printed.

    `ini` and `script` come after INI and SCRIPT; the script reads `job` as such.
    """
    with tempfile.TemporaryDirectory(prefix="gcheck-") as folder:
        files = {
            "machine.ini": INI + ini,
            "machine.hal": hal,
            "script.py": SCRIPT + script,
            "machine.tbl": tools,
            "machine.var": "5220\t1.0\n",
            "job.json": json.dumps(job),
        }
        for name, text in files.items():
            path = os.path.join(folder, name)
            with open(path, "w") as file:
                file.write(text)
            os.chmod(path, 0o777 if name == "script.py" else 0o666)
        os.chmod(folder, 0o777)
        # The real-time part gives up the rights of root for those of this user, nobody.
        environment = dict(os.environ, RTAPI_UID="65534", RTAPI_FIFO_PATH=os.path.join(folder, "fifo"))
        environment.pop("DISPLAY", None)
        process = subprocess.run(
            ["linuxcnc", "-r", "machine.ini"],
            cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL,
        )
        path = os.path.join(folder, out)
        text = open(path).read() if os.path.exists(path) else ""
        return text, process.stdout + process.stderr
