"""`python -m gcheck`: starts the binary that came with this package."""

import os
import subprocess
import sys
import sysconfig


def find() -> str:
    """The binary, wherever this installation put its scripts."""
    name = "gcheck" + (sysconfig.get_config_var("EXE") or "")
    folders = [sysconfig.get_path("scripts")]
    user_scheme = getattr(sysconfig, "get_preferred_scheme", None)
    if user_scheme is not None:
        folders.append(sysconfig.get_path("scripts", scheme=user_scheme("user")))
    # `pip install --target FOLDER` puts scripts into FOLDER/bin.
    folders.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "bin"))
    for folder in folders:
        path = os.path.join(folder, name)
        if os.path.isfile(path):
            return path
    raise FileNotFoundError(f"no {name} in {', '.join(folders)}")


def main() -> int:
    """Runs the binary with the arguments of this process."""
    try:
        binary = find()
        if os.name == "nt":
            return subprocess.run([binary, *sys.argv[1:]], check=False).returncode
        os.execv(binary, [binary, *sys.argv[1:]])
    except OSError as error:
        print(f"gcheck cannot be started: {error}; install the package again", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
