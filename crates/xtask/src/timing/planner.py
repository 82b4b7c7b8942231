"""Runs programs in LinuxCNC's own motion planner, without a screen or hardware, and says how long each takes.

    planner.py [--accel 1000] [--limit 200] [--sample FOLDER] PROGRAM ...

Needs Debian's package linuxcnc-uspace. Units: mm, mm/s, mm/s^2, the same for X, Y and Z. The spindle reaches its speed at once,
turns on by simulation, and gives its position to threads and taps. Runs in real time.
One JSON line a program: {"program", "seconds", "ended", "error"}. With --sample, FOLDER/<name>.tsv has a number and X, Y and Z for
each cycle of a millisecond.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile

SPEED = 200

INI = """[EMC]
VERSION = 1.1
MACHINE = timing
DEBUG = 0
[DISPLAY]
DISPLAY = ./run_programs.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = timing.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = timing.tbl
[HAL]
HALFILE = timing.hal
[TRAJ]
COORDINATES = X Y Z
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 50
MAX_LINEAR_VELOCITY = 400
DEFAULT_LINEAR_ACCELERATION = {accel}
MAX_LINEAR_ACCELERATION = {twice}
NO_FORCE_HOMING = 1
[KINS]
KINEMATICS = trivkins coordinates=XYZ
JOINTS = 3
"""

LIMITS = "MAX_VELOCITY = {speed}\nMAX_ACCELERATION = {accel}\nMIN_LIMIT = -10000\nMAX_LIMIT = 10000\n"
JOINT = "TYPE = LINEAR\nFERROR = 10\nMIN_FERROR = 10\nHOME = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"

HAL = """loadrt trivkins coordinates=XYZ
loadrt motmod servo_period_nsec=1000000 num_joints=3
loadrt sim_spindle names=turns
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf turns servo-thread
setp turns.scale 0.0166666667
net spindle-speed spindle.0.speed-out => turns.velocity-cmd
net spindle-turns turns.position-fb => spindle.0.revs
net spindle-mark spindle.0.index-enable <=> turns.index-enable
setp spindle.0.at-speed 1
loadrt sampler depth=8000 cfg=fff
addf sampler.0 servo-thread
net x => sampler.0.pin.0
net y => sampler.0.pin.1
net z => sampler.0.pin.2
net x joint.0.motor-pos-cmd => joint.0.motor-pos-fb
net y joint.1.motor-pos-cmd => joint.1.motor-pos-fb
net z joint.2.motor-pos-cmd => joint.2.motor-pos-fb
net enable iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
"""

RUN_PROGRAMS = r'''#!/usr/bin/python3
import json, os, subprocess, time, linuxcnc
# No program stands for as long, in seconds.
STALLED = 15
job = json.load(open("job.json"))
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
def do(act, *arguments, wait=5):
    act(*arguments)
    command.wait_complete(wait)
time.sleep(1)
do(command.state, linuxcnc.STATE_ESTOP_RESET)
do(command.state, linuxcnc.STATE_ON)
for joint in range(3):
    do(command.home, joint)
time.sleep(0.5)
with open("out.jsonl", "w") as out:
    for program in job["programs"]:
        do(command.mode, linuxcnc.MODE_MDI)
        do(command.mdi, "M5 G21 G90 G94 G40 G49 G80 G61 G0 X0 Y0 Z0", wait=60)
        do(command.mdi, "G64", wait=10)
        do(command.mode, linuxcnc.MODE_AUTO)
        command.program_open(program)
        time.sleep(0.3)
        while errors.poll():
            pass
        cycles = None
        if job["sample"]:
            name = os.path.splitext(os.path.basename(program))[0]
            # What was sampled before this program is in the queue still.
            subprocess.run(["timeout", "0.3", "halsampler"], stdout=subprocess.DEVNULL)
            with open(os.path.join(job["sample"], name + ".tsv"), "w") as table:
                cycles = subprocess.Popen(["halsampler", "-t"], stdout=table)
        begin = time.time()
        command.auto(linuxcnc.AUTO_RUN, 0)
        started = ended = False
        error = None
        now = begin
        place, changed = None, begin
        while now - begin < job["limit"]:
            status.poll()
            now = time.time()
            if (status.position, status.motion_line) != place:
                place, changed = (status.position, status.motion_line), now
            elif now - changed > STALLED:
                break
            message = errors.poll()
            if message and message[0] in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
                error = message[1]
            idle = status.interp_state == linuxcnc.INTERP_IDLE
            started = started or not idle
            done = idle and status.inpos and status.queue == 0 and status.exec_state == linuxcnc.EXEC_DONE
            if (started or now - begin > 2) and done:
                ended = True
                break
            time.sleep(0.001)
        if now - changed > STALLED:
            # A part of the control has gone: nothing more can be measured in this run.
            break
        if not ended:
            do(command.abort)
        if cycles:
            time.sleep(0.1)
            cycles.terminate()
            cycles.wait()
        line = {"program": program, "seconds": round(now - begin, 3), "ended": ended, "error": error}
        out.write(json.dumps(line) + "\n")
        out.flush()
'''


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--accel", type=float, default=1000.0)
    parser.add_argument("--limit", type=float, default=200.0)
    parser.add_argument("--sample")
    options = parser.parse_args()
    if not shutil.which("linuxcnc"):
        sys.exit("linuxcnc is not installed (Debian: linuxcnc-uspace)")
    limits = LIMITS.format(speed=SPEED, accel=options.accel)
    ini = INI.format(accel=options.accel, twice=2 * options.accel)
    ini += "".join(f"[AXIS_{axis}]\n{limits}[JOINT_{joint}]\n{limits}{JOINT}" for joint, axis in enumerate("XYZ"))
    job = {
        "programs": [os.path.abspath(program) for program in options.programs],
        "sample": os.path.abspath(options.sample) if options.sample else None,
        "limit": options.limit,
    }
    try:
        # On a busy machine the control would wait for its turn, and programs would take longer.
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(20))
    except PermissionError:
        print("the control has no priority: other work on this machine makes programs take longer", file=sys.stderr)
    with tempfile.TemporaryDirectory(prefix="gcheck-timing-") as folder:
        files = {
            "timing.ini": ini,
            "timing.hal": HAL,
            "run_programs.py": RUN_PROGRAMS,
            "timing.tbl": "T1 P1 Z0 D6\n",
            "timing.var": "5220\t1.0\n",
            "job.json": json.dumps(job),
        }
        for name, text in files.items():
            path = os.path.join(folder, name)
            with open(path, "w") as file:
                file.write(text)
            os.chmod(path, 0o777 if name == "run_programs.py" else 0o666)
        os.chmod(folder, 0o777)
        # The real-time part gives up the rights of root for those of this user, nobody.
        environment = dict(os.environ, RTAPI_UID="65534", RTAPI_FIFO_PATH=os.path.join(folder, "fifo"))
        environment.pop("DISPLAY", None)
        run = subprocess.run(
            ["linuxcnc", "-r", "timing.ini"],
            cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL,
        )
        out = os.path.join(folder, "out.jsonl")
        lines = open(out).read() if os.path.exists(out) else ""
        sys.stdout.write(lines)
        if lines.count("\n") != len(options.programs):
            sys.stderr.write((run.stdout + run.stderr)[-2000:])
            sys.exit(1)


main()
