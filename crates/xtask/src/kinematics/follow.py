"""Asks LinuxCNC's kinematics of five axes where the linear axes are for a tip of the tool.

    follow.py

Needs Debian's package linuxcnc-uspace. Millimetres and degrees. One line a pose, with tabs between the cells: the machine, the tip
(X Y Z), the rotary axes (A B C), the linear axes (X Y Z).
"""

import json
import sys

import headless

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

INI = """[TRAJ]
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

ASK = '''time.sleep(1)
do(command.teleop_enable, 1)
do(command.mode, linuxcnc.MODE_MDI)
rows = []
for words in ["G21 G90 G0"] + job["blocks"]:
    do(command.mdi, words, wait=20)
    time.sleep(0.1)
    status.poll()
    message = errors.poll()
    if message:
        raise SystemExit(words + ": " + message[1])
    rows.append(list(status.joint_position[:3]))
with open("out.json", "w") as out:
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
    ini += headless.sections(axes, speed=1000, accel=20000, off=1000)
    job = {"blocks": blocks, "joints": joints}
    out, said = headless.run(ini, "\n".join(hal) + "\n", ASK, job, tools="", out="out.json")
    if not out:
        sys.exit(f"{name}: {said[-3000:]}")
    rows = json.loads(out)
    for (tip, turns), linear in zip(poses, rows):
        angles = {"A": 0, "B": 0, "C": 0, first: turns[0], second: turns[1]}
        cells = [f"{value:g}" for value in (*tip, angles["A"], angles["B"], angles["C"])]
        cells += [f"{value + 0.0:.6f}" for value in linear]
        print("\t".join([name, *cells]))


def main():
    headless.need()
    print("machine\tx\ty\tz\ta\tb\tc\tlinear x\tlinear y\tlinear z")
    for name in sys.argv[1:] or MACHINES:
        ask(name)


main()
