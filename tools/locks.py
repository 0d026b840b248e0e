"""Write the lists of packages in `locks/`, with the digests of their files: `python -P -m tools.locks`.

The versions come from `constraints.txt`. `uv` finds the files of each version for the supported platforms. The files in
`locks/` name no registry.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CONSTRAINTS = ROOT / "constraints.txt"
OLDEST = "3.11"
BUILDS = "hatchling\neditables\n"  # packages needed to install derive itself
HEADS = {
    "runtime": "# The packages that derive and its installation need: written by `python -P -m tools.locks`.\n",
    "tests": "# The additional packages of the tests and linters: written by `python -P -m tools.locks`.\n",
}
_ENTRY = re.compile(r"^([a-z0-9][a-z0-9._-]*)==.*(?:\n +--hash=.*)*", re.MULTILINE)


def entries(text: str) -> dict[str, str]:
    """Return the entries of a lock file by the names of the packages: version, conditions and digests."""
    return {found[1]: found[0] for found in _ENTRY.finditer(text)}


def resolved(*options: str) -> dict[str, str]:
    """Return the entries of all packages that `uv`, with these options, selects for derive and its installation."""
    uv = shutil.which("uv")
    if uv is None:
        sys.exit("error[uv]: locks are written by `uv`, which is not installed: `pip install uv`")
    with tempfile.NamedTemporaryFile("w", suffix=".in") as builds:
        builds.write(BUILDS)
        builds.flush()
        command = [uv, "pip", "compile", "--quiet", "--universal", "--generate-hashes", "--python-version", OLDEST]
        plain = ["--no-header", "--no-annotate", "--no-emit-index-url", "--no-emit-find-links"]
        files = ["--constraint", str(CONSTRAINTS), *options, "pyproject.toml", builds.name]
        run = subprocess.run([*command, *plain, *files], cwd=ROOT, capture_output=True, text=True)
    if run.returncode:
        sys.exit(re.sub(r"\w+://\S+", "(address)", run.stderr))
    return entries(run.stdout)


def main() -> None:
    runtime = resolved()
    more = {name: entry for name, entry in resolved("--extra", "test").items() if name not in runtime}
    for name, found in (("runtime", runtime), ("tests", more)):
        (ROOT / "locks").mkdir(exist_ok=True)
        (ROOT / "locks" / f"{name}.txt").write_text(HEADS[name] + "".join(f"{entry}\n" for entry in found.values()))


if __name__ == "__main__":
    main()
