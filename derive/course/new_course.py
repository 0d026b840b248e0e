"""The files of a new course."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from derive.course.problem_set import COURSE
from derive.errors import Complaint, Misused

WEEK = "problems/week1"

# path in the course -> pattern in the folder `new/course` of the templates
FILES = {
    COURSE: "course.yaml",
    f"{WEEK}/set.yaml": "set.yaml",
    f"{WEEK}/bead.yaml": "bead.yaml",
    "README.md": "README.md",
    "Makefile": "Makefile",
    "Containerfile": "Containerfile",
    ".gitignore": "gitignore",
    ".github/workflows/course.yml": "github.yml",
    ".gitlab-ci.yml": "gitlab.yml",
}


def begun_course(folder: Path, title: str, template: Callable[[str], Path]) -> dict[str, str]:
    """Return the texts of the files of a new course, by their paths in its folder.

    Raise `Misused` if the folder is a course already, is within a course, or has one of the files in `FILES`.

    title     the name of the course
    template  a function that returns the file of a template
    """
    if (folder / "problems").is_dir():
        message = f"`{folder}` is a course already: it has a folder `problems`"
        raise Misused(Complaint("exists", message, help="`derive new SET/PROBLEM` begins a problem in it"))
    above = (each for each in folder.resolve().parents if (each / COURSE).is_file() and (each / "problems").is_dir())
    if outer := next(above, None):
        message = f"`{folder}` would be within the course `{outer}`"
        help_line = "choose another folder, or begin a set: `derive new SET/PROBLEM`"
        raise Misused(Complaint("exists", message, help=help_line))
    if taken := [path for path in FILES if (folder / path).exists()]:
        message = f"the file `{taken[0]}` already exists in `{folder}`"
        raise Misused(Complaint("exists", message, help="choose an empty folder"))
    texts = {path: template(f"new/course/{name}").read_text(encoding="utf-8") for path, name in FILES.items()}
    texts[COURSE] = texts[COURSE].replace("{title}", json.dumps(title, ensure_ascii=False))  # JSON is YAML
    texts["README.md"] = texts["README.md"].replace("{heading}", " ".join(title.split()))
    return texts
