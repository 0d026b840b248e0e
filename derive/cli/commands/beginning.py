"""`derive new` and `derive schema`: files for an author who begins a problem, and for the author's editor."""

from __future__ import annotations

import argparse

from derive.cli.asked import new_id_of, root_of
from derive.errors import Complaint, Misused


def new(arguments: argparse.Namespace) -> int:
    """Write the files of a new problem, which can be built immediately, and print what to do next."""
    from derive.building.files import shown_path, write
    from derive.building.set_names import wrong_set_name
    from derive.course.begun import begun
    from derive.course.editors import SCHEMAS, schema_folder
    from derive.page.template import template_folder

    root = root_of(arguments)
    schemas = schema_folder(root)
    problem_id = new_id_of(arguments.id)
    set_id = problem_id.partition("/")[0]
    if set_id and (why := wrong_set_name(set_id)):
        raise Misused(Complaint("new-name", f"a set cannot be called `{set_id}`: {why}", help="such as `hw10/wheel`"))
    files = begun(root, template_folder(root), schemas, problem_id, arguments.like)
    if not (schemas / "problem.schema.json").exists():
        for name, made in SCHEMAS.items():
            write(schemas / name, made())
    for path, content in files.items():
        if write(root / path, content):
            print(f"wrote {shown_path(root / path)}")
    print(f"next: `derive preview {problem_id}` shows it while you edit, `derive build {problem_id}` makes its pages")
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
