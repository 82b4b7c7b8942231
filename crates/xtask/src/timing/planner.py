"""Runs programs in LinuxCNC's own motion planner, without a screen or hardware, and says how long each takes.

    planner.py [--accel 1000] [--limit 200] [--sample FOLDER] PROGRAM ...

Needs Debian's package linuxcnc-uspace. Units: mm, mm/s, mm/s^2, the same for X, Y and Z. The spindle reaches its speed at once,
turns on by simulation, and gives its position to threads and taps. Runs in real time.
One JSON line a program: {"program", "seconds", "ended", "error"}. With --sample, FOLDER/<name>.tsv has a number and X, Y and Z for
each cycle of a millisecond.
"""

import argparse
import os
import sys

import headless

SPEED = 200

INI = """[TRAJ]
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

RUN_PROGRAMS = r'''# No program pauses for so long, in seconds.
STALLED = 15
# Between two moves that the control stops for, it is done as well, but not for so long.
DONE = 0.3
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
        end = None
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
            if not done or not (started or now - begin > 2):
                end = None
            elif end is None:
                end = now
            elif now - end > DONE:
                ended = True
                now = end
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
    headless.need()
    ini = INI.format(accel=options.accel, twice=2 * options.accel)
    ini += headless.sections("XYZ", speed=SPEED, accel=options.accel, off=10)
    job = {
        "programs": [os.path.abspath(program) for program in options.programs],
        "sample": os.path.abspath(options.sample) if options.sample else None,
        "limit": options.limit,
        "joints": 3,
    }
    try:
        # On a busy machine the control would wait for its turn, and programs would take longer.
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(20))
    except PermissionError:
        print("the control has no priority: other work on this machine makes programs take longer", file=sys.stderr)
    lines, said = headless.run(ini, HAL, RUN_PROGRAMS, job, tools="T1 P1 Z0 D6\n", out="out.jsonl")
    sys.stdout.write(lines)
    if lines.count("\n") != len(options.programs):
        sys.stderr.write(said[-2000:])
        sys.exit(1)


main()
