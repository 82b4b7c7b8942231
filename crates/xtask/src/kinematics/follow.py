"""Asks LinuxCNC's kinematics of five axes where the linear axes are for a tip of the tool.

    follow.py

Needs Debian's package linuxcnc-uspace. Millimetres and degrees. One line a pose, with tabs between the cells: the machine, the tip
(X Y Z), the rotary axes (A B C), the linear axes (X Y Z).
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

# By machine: the module, its axes by joint, its parameters.
MACHINES = {
    "table-table": ("xyzac-trt-kins", "XYZAC", {
        "y-offset": 20, "z-offset": 10, "x-rot-point": 40, "y-rot-point": 25, "z-rot-point": -90,
    }),
    "table-table-b": ("xyzbc-trt-kins", "XYZBC", {
        "x-offset": -15, "z-offset": 35, "x-rot-point": 40, "y-rot-point": 25, "z-rot-point": -90,
    }),
    "head-head": ("5axiskins", "XYZBCW", {"pivot-length": 250}),
    "head-table": ("maxkins", "XYZBCUVW", {"pivot-length": 180}),
}

TIPS = [(0, 0, 0), (30, -20, 15), (-45, 60, 5)]
ANGLES = [(0, 0), (30, 0), (0, 45), (30, 45), (-40, 110), (75, -160)]

INI = """[EMC]
VERSION = 1.1
MACHINE = kinematics
DEBUG = 0
[DISPLAY]
DISPLAY = ./ask.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = kinematics.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = kinematics.tbl
[HAL]
HALFILE = kinematics.hal
[TRAJ]
COORDINATES = {axes}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 1000
MAX_LINEAR_VELOCITY = 1000
MAX_LINEAR_ACCELERATION = 20000
MAX_ANGULAR_VELOCITY = 1000
MAX_ANGULAR_ACCELERATION = 20000
NO_FORCE_HOMING = 1
[KINS]
KINEMATICS = {module}
JOINTS = {joints}
"""

AXIS = "MAX_VELOCITY = 1000\nMAX_ACCELERATION = 20000\nMIN_LIMIT = -10000\nMAX_LIMIT = 10000\n"
JOINT = "TYPE = {kind}\nFERROR = 1000\nMIN_FERROR = 1000\nHOME = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"

ASK = r'''#!/usr/bin/python3
import json, time, linuxcnc
job = json.load(open("job.json"))
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
def do(act, *arguments):
    act(*arguments)
    command.wait_complete(20)
time.sleep(1)
do(command.state, linuxcnc.STATE_ESTOP_RESET)
do(command.state, linuxcnc.STATE_ON)
for joint in range(job["joints"]):
    do(command.home, joint)
time.sleep(1)
do(command.teleop_enable, 1)
do(command.mode, linuxcnc.MODE_MDI)
with open("out.json", "w") as out:
    rows = []
    for words in ["G21 G90 G0"] + job["blocks"]:
        do(command.mdi, words)
        time.sleep(0.1)
        status.poll()
        message = errors.poll()
        if message:
            raise SystemExit(words + ": " + message[1])
        rows.append(list(status.joint_position[:3]))
    json.dump(rows[1:], out)
'''


def ask(name):
    module, axes, parameters = MACHINES[name]
    joints = len(axes)
    first, second = axes[3:5]
    poses = [(tip, turns) for turns in ANGLES for tip in TIPS]
    blocks = [
        f"G0 X{tip[0]} Y{tip[1]} Z{tip[2]} {first}{turns[0]} {second}{turns[1]}" for tip, turns in poses
    ]
    hal = [f"loadrt {module}", f"loadrt motmod servo_period_nsec=1000000 num_joints={joints}"]
    hal += ["addf motion-command-handler servo-thread", "addf motion-controller servo-thread"]
    hal += [f"net j{joint} joint.{joint}.motor-pos-cmd => joint.{joint}.motor-pos-fb" for joint in range(joints)]
    hal += ["net enable iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in"]
    hal += [f"setp {module}.{parameter} {value}" for parameter, value in parameters.items()]
    ini = INI.format(axes=" ".join(axes), module=module, joints=joints)
    for joint, axis in enumerate(axes):
        kind = "ANGULAR" if axis in "ABC" else "LINEAR"
        ini += f"[AXIS_{axis}]\n{AXIS}[JOINT_{joint}]\n{AXIS}{JOINT.format(kind=kind)}"
    with tempfile.TemporaryDirectory(prefix="gcheck-kinematics-") as folder:
        files = {
            "kinematics.ini": ini,
            "kinematics.hal": "\n".join(hal) + "\n",
            "ask.py": ASK,
            "kinematics.tbl": "",
            "kinematics.var": "5220\t1.0\n",
            "job.json": json.dumps({"blocks": blocks, "joints": joints}),
        }
        for file_name, text in files.items():
            path = os.path.join(folder, file_name)
            with open(path, "w") as file:
                file.write(text)
            os.chmod(path, 0o777 if file_name == "ask.py" else 0o666)
        os.chmod(folder, 0o777)
        # The real-time part gives up the rights of root for those of this user, nobody.
        environment = dict(os.environ, RTAPI_UID="65534", RTAPI_FIFO_PATH=os.path.join(folder, "fifo"))
        environment.pop("DISPLAY", None)
        run = subprocess.run(
            ["linuxcnc", "-r", "kinematics.ini"],
            cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL,
        )
        out = os.path.join(folder, "out.json")
        if not os.path.exists(out) or not os.path.getsize(out):
            sys.exit(f"{name}: {(run.stdout + run.stderr)[-3000:]}")
        with open(out) as file:
            rows = json.load(file)
    for (tip, turns), linear in zip(poses, rows):
        angles = {"A": 0, "B": 0, "C": 0, first: turns[0], second: turns[1]}
        cells = [f"{value:g}" for value in (*tip, angles["A"], angles["B"], angles["C"])]
        cells += [f"{value + 0.0:.6f}" for value in linear]
        print("\t".join([name, *cells]))


def main():
    if not shutil.which("linuxcnc"):
        sys.exit("linuxcnc is not installed (Debian: linuxcnc-uspace)")
    print("machine\tx\ty\tz\ta\tb\tc\tlinear x\tlinear y\tlinear z")
    for name in sys.argv[1:] or MACHINES:
        ask(name)


main()
