"""`derive doctor`: what a build needs, what is missing, and how to supply it."""

from __future__ import annotations

import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from derive import FOLDER
from derive.building.cache import PACKAGES, package_version
from derive.building.files import shown_path
from derive.building.set_names import set_names
from derive.building.tex import chosen_engine, engines, typeset
from derive.errors import DeriveError
from derive.page.template import templates_of

_PAGE = r"""\documentclass{article}
\usepackage[T1]{fontenc}
\usepackage{lmodern,amsmath,tikz,hyperref}
\begin{document}
$E = \frac{1}{2} \omega^T I \omega$
\end{document}
"""


@dataclass(frozen=True)
class Finding:
    """One requirement of a build: whether it is satisfied, what was found, and the fix."""

    what: str
    good: bool
    found: str
    fix: str = ""

    def shown(self) -> str:
        line = f"{'ok' if self.good else 'no':4}{self.what:10}{self.found}"
        return line if self.good or not self.fix else f"{line}\n{'':14}{self.fix}"


def findings(root: Path | None, engine: str | None) -> list[Finding]:
    return [_python(), _packages(), _templates(), *_tex(engine), *_root(root)]


def _python() -> Finding:
    found = f"{sys.version.split()[0]} at {shown_path(Path(sys.executable))}"
    return Finding(
        "Python", sys.version_info >= (3, 11), found, "install Python 3.11 or later, remove .venv, run `make`"
    )


def _packages() -> Finding:
    versions = {name: package_version(name) for name in PACKAGES}
    missing = [name for name, version in versions.items() if version is None]
    found = ", ".join(f"{name} {version}" for name, version in versions.items() if version)
    return Finding("packages", not missing, found, f"missing: {', '.join(missing)}; run `make`")


def _templates() -> Finding:
    folder = templates_of(Path(FOLDER)).folders[-1]
    return Finding("templates", True, f"{shown_path(folder)}; a course can have templates of its own in `templates`")


def _tex(name: str | None) -> list[Finding]:
    try:
        engine = chosen_engine(name)
    except DeriveError as error:
        complaint = error.complaints[0]
        return [Finding("TeX", False, complaint.message, complaint.help or "")]
    others = [f"{other.name} ({other.path})" for other in engines() if other != engine]
    found = [Finding("TeX", True, f"{engine.name} from {engine.origin}, {shown_path(engine.path)}")]
    if others:
        found.append(Finding("", True, f"`--engine` or DERIVE_ENGINE chooses another: {', '.join(others)}"))
    return [*found, _test_page(name)]


def _test_page(name: str | None) -> Finding:
    started = time.monotonic()
    try:
        with tempfile.TemporaryDirectory() as folder:
            typeset(_PAGE, Path(folder) / "page.pdf", chosen_engine(name), timeout=60)
    except DeriveError as error:
        return Finding(
            "test page", False, error.complaints[0].message, "choose another `--engine`, or install TeX Live"
        )
    return Finding("test page", True, f"typeset in {time.monotonic() - started:.1f} s")


def _root(root: Path | None) -> list[Finding]:
    if root is None:
        return [Finding("problems", False, "no folder `problems` was found", "name its parent folder with `--root`")]
    sets = set_names(root)
    found = f"{shown_path(root / 'problems')}, with {', '.join(sets) or 'no set'}"
    return [Finding("problems", bool(sets), found, "a set is a folder with a file `set.yaml`"), _outputs(root)]


def _outputs(root: Path) -> Finding:
    folder = root / "build"
    try:
        folder.mkdir(exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return Finding("outputs", True, f"{shown_path(folder)} can be written")
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        return Finding("outputs", False, f"{shown_path(folder)}: {reason}", "make it a folder that you can write to")
