"""A course at a revision of git, in a temporary folder: the files of one set, the scripts of all sets, the templates,
the file of the course and the logo.

Files are read as git stores them and not checked out, because a repository may name programs that run at checkout.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

from derive.building.files import writing
from derive.building.scratch import Scratch
from derive.course.problem_set import COURSE, logo_of_set
from derive.errors import Complaint, Misused

TEMPLATES = "templates"
_NEVER_ASKS = {"GIT_TERMINAL_PROMPT": "0", "GIT_NO_LAZY_FETCH": "1", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}
_TIME_LIMIT = 60


@contextmanager
def course_at(root: Path, revision: str, set_id: str) -> Iterator[Path]:
    """Provide the root of the course at that revision inside the `with` block; no other machine is contacted."""
    commit = _commit(root, revision)
    wanted = (f"problems/{set_id}", TEMPLATES, COURSE)
    there = _git(root, "ls-tree", "--name-only", commit, "--", *wanted).stdout.decode().splitlines()
    if wanted[0] not in there:
        message = f"no set was called `{set_id}` at `{revision}`"
        raise Misused(
            Complaint("no-such-set", message, help=f"`git log -- {wanted[0]}` lists the revisions that have it")
        )
    with Scratch() as name, writing(Path(name)):
        folder = Path(name)
        scripts = [each for each in _files(root, revision, commit, ["problems"]) if each[1].endswith(b".py")]
        _copy(root, revision, [*_files(root, revision, commit, there), *scripts], folder)
        if (logo := logo_of_set(folder, set_id)) and ".." not in Path(logo).parts:
            _copy(root, revision, _files(root, revision, commit, [logo]), folder)
        yield folder


def _copy(root: Path, revision: str, files: Sequence[tuple[bytes, bytes]], folder: Path) -> None:
    """Write files into a folder; `files` has pairs of the name of a git object and the path of its file."""
    contents = _contents(root, revision, [name for name, _ in files])
    for (_, path), content in zip(files, contents, strict=True):
        target = folder / os.fsdecode(path)
        if target.resolve().is_relative_to(folder.resolve()):
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)


def _files(root: Path, revision: str, commit: str, paths: Sequence[str]) -> list[tuple[bytes, bytes]]:
    """Return the object name and the path of each plain file at and below these paths; symbolic links are left out."""
    found = _git(root, "ls-tree", "-r", "-z", commit, "--", *paths)
    if found.returncode:
        raise Misused(_unreadable(revision, found.stderr))
    listed = found.stdout.split(b"\0")
    entries = [(*facts.split(), path) for facts, _, path in (entry.partition(b"\t") for entry in listed if entry)]
    return [(name, path) for mode, _, name, path in entries if mode in (b"100644", b"100755")]


def _contents(root: Path, revision: str, names: Sequence[bytes]) -> Iterator[bytes]:
    """Yield the content of each object of git, in the order of `names`."""
    found = _git(root, "cat-file", "--batch", told=b"".join(name + b"\n" for name in names))
    said = BytesIO(found.stdout)
    for name in names:
        head = said.readline().rstrip(b"\n")
        size = head.rpartition(b" ")[2]
        if found.returncode or not head.startswith(name) or not size.isdigit():
            raise Misused(_unreadable(revision, found.stderr or head))
        yield said.read(int(size))
        said.readline()


def _commit(root: Path, revision: str) -> str:
    if not shutil.which("git"):
        message = "`--rev` compares with a revision of git, but git is not installed"
        raise Misused(
            Complaint("no-git", message, help="install git, or compare with the last build: leave `--rev` out")
        )
    if _git(root, "rev-parse", "--git-dir").returncode:
        message = "`--rev` compares with a revision of git, but git finds no repository here that it accepts"
        help_line = "leave `--rev` out to compare with the last build; `git init` creates a repository"
        raise Misused(Complaint("no-repository", message, help=help_line))
    named = not revision.startswith("-") and revision.isprintable()
    found = _git(root, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}") if named else None
    if found is None or found.returncode:
        help_line = "name a commit, a branch or a tag: `HEAD`, `HEAD~1`, `main`; `git log --all` lists the commits"
        raise Misused(Complaint("no-such-revision", f"git finds no revision `{revision}` here", help=help_line))
    return found.stdout.decode().strip()


def _unreadable(revision: str, told: bytes) -> Complaint:
    said = (told.decode(errors="replace").strip().splitlines() or ["it says nothing"])[-1]
    return Complaint("revision-unreadable", f"git cannot read the files of `{revision}`: {said}")


def _git(root: Path, *arguments: str, told: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    command: Sequence[str] = ["git", "-C", str(root), "-c", "protocol.allow=never", *arguments]
    try:
        return subprocess.run(
            command,
            capture_output=True,
            check=False,
            env={**os.environ, **_NEVER_ASKS},
            input=told,
            timeout=_TIME_LIMIT,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Misused(Complaint("no-git", f"git does not answer: {error}")) from None
