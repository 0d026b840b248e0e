"""`derive init`, `derive new` and `derive schema`: files for an author who begins a course or a problem, and for the
author's editor."""

from __future__ import annotations

import argparse
import shlex
import sys
from pathlib import Path

from derive.cli.problem_ids import found_root, new_id_of, root_of, root_with
from derive.errors import Complaint, Misused


def init(arguments: argparse.Namespace) -> int:
    folder = Path(arguments.folder)
    _write_course(folder, arguments.title)
    inside = "" if folder.resolve() == Path.cwd() else f"cd {shlex.quote(arguments.folder)}; "
    print(f"next: `{inside}derive preview week1/bead` shows the first problem, `derive new week1/NAME` begins another")
    return 0


def _write_course(folder: Path, title: str) -> None:
    from derive.building.files import shown_path, write
    from derive.course.editors import SCHEMAS, schema_folder
    from derive.course.new_course import begun_course
    from derive.page.template import templates_of

    texts = begun_course(folder, title, templates_of(folder).file)
    schemas = {f"{schema_folder(folder).relative_to(folder)}/{name}": made() for name, made in SCHEMAS.items()}
    for path, text in {**texts, **schemas}.items():
        write(folder / path, text)
        print(f"wrote {shown_path(folder / path)}")


def _offered_course() -> bool:
    """Ask the user at a terminal whether to make a course in the working folder; make it if the user agrees."""
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        return False
    print("No course was found. Make one in this folder? [y/N] ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        return False
    _write_course(Path.cwd(), "Mechanics")
    return True


def new(arguments: argparse.Namespace) -> int:
    """Write the files of a new problem, which can be built immediately, and print what to do next."""
    from derive.building.files import shown_path, write
    from derive.building.set_names import wrong_set_name
    from derive.course.editors import SCHEMAS, schema_folder
    from derive.course.new_problem import begun
    from derive.page.template import templates_of

    if found_root(arguments.root) is None and not arguments.root:
        _offered_course()
    root = root_of(arguments)
    schemas = schema_folder(root)
    problem_id = new_id_of(arguments.id)
    set_id = problem_id.partition("/")[0]
    if set_id and (why := wrong_set_name(set_id)):
        raise Misused(Complaint("new-name", f"a set cannot be called `{set_id}`: {why}", help="such as `hw10/wheel`"))
    like_root = root_with(arguments, new_id_of(arguments.like).partition("/")[0])
    files = begun(root, templates_of(root).file, schemas, problem_id, arguments.like, like_root)
    if not (schemas / "problem.schema.json").exists():
        for name, made in SCHEMAS.items():
            write(schemas / name, made())
    for path, content in files.items():
        if write(root / path, content):
            print(f"wrote {shown_path(root / path)}")
    print(f"next: `derive preview {problem_id}` shows the page while you edit, `derive build {problem_id}` builds it")
    return 0


def schema(arguments: argparse.Namespace) -> int:
    """Write the schemas by which editors complete and check the files of a course, or print one of them."""
    from derive.building.files import shown_path, write
    from derive.course.editors import SCHEMAS, schema_folder

    if arguments.sort:
        print(SCHEMAS[f"{arguments.sort}.schema.json"](), end="")
        return 0
    folder = schema_folder(root_of(arguments))
    for name, made in SCHEMAS.items():
        said = "wrote" if write(folder / name, made()) else "is up to date:"
        print(f"{said} {shown_path(folder / name)}")
    return 0
