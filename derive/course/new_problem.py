"""The files of a new problem, copied from a pattern or from an existing problem.

Existing files are not overwritten, except that the file of a set gains an entry in its list of problems.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from os.path import relpath
from pathlib import Path

from derive.course.names import DOCUMENTS, INDEX, NAME
from derive.course.problem_set import COURSE, mapping_in, path_of, problem_set
from derive.course.schema import wrong_type
from derive.course.yaml_tree import Scalar, Sequence
from derive.errors import Complaint, Faults, Misused, did_you_mean

PATTERNS = ("system", "body", "rotation", "script")
SCHEMA = "problem.schema.json"
SOLVED_BY = re.compile(r"^solve:[ \t]*(\S+\.py)", re.MULTILINE)
SCHEMA_OF_SET = "set.schema.json"
NEW_SET = "title: {}\n# date: Fall term\n# instructor: your name\n\nproblems:\n"
PROBLEM_NAMED = re.compile(r"<<\s*problem\s+([\w-]+)\s*>>")


def begun(
    root: Path, template: Callable[[str], Path], schemas: Path, problem_id: str, like: str, pattern_root: Path
) -> dict[str, str]:
    """Return the texts of the files of a new problem, and of the file of its set, by their paths from the root.

    Raise `Misused` if the name is taken or not allowed, or if the pattern or problem `like` does not exist.

    template      a function that returns the file of a template; the templates in the folder `new` are the patterns
    schemas       the folder of the schemas for editors
    like          a pattern by its name, or the id of a problem
    pattern_root  the folder of the course that has the problem `like`
    """
    set_id, _, name = problem_id.partition("/")
    _check_names(root, set_id, name)
    folder = f"problems/{set_id}"
    yaml, script = _copied(pattern_root, like) if "/" in like else _pattern(template, like)
    written_for = f"{name}.py" if script else ""
    if script:
        yaml = SOLVED_BY.sub(lambda found: found[0].replace(found[1], written_for), yaml, count=1)
    files = {f"{folder}/{name}.yaml": _for_editors(root / folder, schemas / SCHEMA) + yaml}
    if script:
        files[f"{folder}/{written_for}"] = script
    if taken := next((path for path in files if (root / path).exists()), None):
        raise Misused(Complaint("exists", f"the file `{taken}` already exists", help="choose another name"))
    path = f"{folder}/set.yaml"
    if (root / path).is_file():
        files[path] = _with_problem(root, path, name)
    else:
        files[path] = _for_editors(root / folder, schemas / SCHEMA_OF_SET) + _new_set(root, set_id, name)
    return files


def _for_editors(folder: Path, schema: Path) -> str:
    """Return the comment that names the schema of a file for an editor."""
    return f"# yaml-language-server: $schema={relpath(schema, folder)}\n"


def _new_set(root: Path, set_id: str, name: str) -> str:
    """Return the text of the file of a new set; the key `course` is left out if `course.yaml` has it."""
    shared = mapping_in(root, COURSE, "a course") if (root / COURSE).is_file() else None
    course = "" if shared and shared.get("course") else "course: Mechanics\n"
    return f"{course}{NEW_SET.format(set_id)}  - {name}\n"


def _check_names(root: Path, set_id: str, name: str) -> None:
    if not NAME.fullmatch(set_id) or not NAME.fullmatch(name):
        help_line = "such as `hw10/wheel`: letters, digits, `-` and `_`"
        message = f"`{set_id}{'/' if name else ''}{name}` is not a valid name of a set and a problem"
        raise Misused(Complaint("new-name", message, help=help_line))
    if name in (*DOCUMENTS, INDEX, "set", "reference"):
        message = f"a problem cannot be called `{name}`, because another file of the set has that name"
        raise Misused(Complaint("new-name", message, help="choose another name"))


def _pattern(template: Callable[[str], Path], like: str) -> tuple[str, str]:
    if like not in PATTERNS:
        help_line = did_you_mean(like, PATTERNS) or f"use {', '.join(PATTERNS)}, or a problem such as `hw9/top`"
        raise Misused(Complaint("new-like", f"`{like}` is not a pattern", help=help_line))
    script = template(f"new/{like}.py")
    return _read(template(f"new/{like}.yaml")), _read(script) if script.is_file() else ""


def _copied(root: Path, like: str) -> tuple[str, str]:
    """Return the text of a problem's file and of its script. References to other problems become plain words."""
    file = root / path_of(root, like)
    text = re.sub(r"\A# yaml-language-server:.*\n", "", _read(file))
    heading = problem_set(root, like.partition("/")[0])

    def in_words(found: re.Match[str]) -> str:
        return f"problem {heading.numbers.get(found[1], found[1])} of {heading.title}"

    solved = SOLVED_BY.search(text)
    script = file.parent / solved[1] if solved else None
    return PROBLEM_NAMED.sub(in_words, text), _read(script) if script and script.is_file() else ""


def _with_problem(root: Path, path: str, name: str) -> str:
    text, faults = _read(root / path), Faults()
    listed = mapping_in(root, path, "a set").get("problems")
    if not isinstance(listed, Sequence) or not listed.items:
        wrong_type(faults, "`problems`", "a list of names", listed or mapping_in(root, path, "a set"))
        faults.stop()
    assert isinstance(listed, Sequence)
    last = listed.items[-1]
    if any(isinstance(item, Scalar) and item.text == name for item in listed.items):
        return text
    lines = text.splitlines(keepends=True)
    line = lines[last.place.line - 1]
    before = line[: last.place.column - 1]
    if re.fullmatch(r"\s*-\s+", before):
        return "".join([*lines[: last.place.line], "" if line.endswith("\n") else "\n", f"{before}{name}\n",
                        *lines[last.place.line :]])  # fmt: skip
    end = last.place.column - 1 + last.place.width
    lines[last.place.line - 1] = f"{line[:end]}, {name}{line[end:]}"
    return "".join(lines)


def _read(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeError):
        raise Misused(Complaint("new-like", f"`{file.name}` cannot be read")) from None
