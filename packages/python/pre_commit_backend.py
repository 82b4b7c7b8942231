"""Builds the wheel that pre-commit installs: no code, only the wish for the wheel with the binary.

A build backend as PEP 517 has it, so that nothing has to be downloaded to install nothing.
"""

import base64
import hashlib
import os
import re
import zipfile


def _project():
    """What pyproject.toml says, read without a TOML parser: Python has one since 3.11 only."""
    with open("pyproject.toml", encoding="utf-8") as file:
        text = file.read().split("[project]", 1)[1]

    def value(pattern):
        return re.search(pattern, text, re.MULTILINE).group(1)

    return {
        "name": value(r'^name = "(.*)"$'),
        "version": value(r'^version = "(.*)"$'),
        "summary": value(r'^description = "(.*)"$'),
        "python": value(r'^requires-python = "(.*)"$'),
        "needs": value(r'^dependencies = \["(.*)"\]$'),
    }


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel and tells its name."""
    project = _project()
    stem = f"{project['name'].replace('-', '_')}-{project['version']}"
    info = f"{stem}.dist-info"
    files = {
        f"{info}/METADATA": (
            "Metadata-Version: 2.1\n"
            f"Name: {project['name']}\n"
            f"Version: {project['version']}\n"
            f"Summary: {project['summary']}\n"
            f"Requires-Python: {project['python']}\n"
            f"Requires-Dist: {project['needs']}\n"
        ),
        f"{info}/WHEEL": (
            "Wheel-Version: 1.0\nGenerator: gcheck\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        ),
    }
    record = ""
    for path, text in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).decode().rstrip("=")
        record += f"{path},sha256={digest},{len(text.encode())}\n"
    files[f"{info}/RECORD"] = record + f"{info}/RECORD,,\n"
    name = f"{stem}-py3-none-any.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w") as wheel:
        for path, text in files.items():
            wheel.writestr(path, text)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """There is nothing to distribute: pre-commit takes the repository."""
    raise NotImplementedError("gcheck-pre-commit is installed from its repository")
