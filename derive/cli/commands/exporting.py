"""`derive export`: a set of problems, or one problem, for a learning platform or a word processor."""

from __future__ import annotations

import argparse
import time
from functools import partial

from derive.cli.output import check_output, deliver
from derive.cli.problem_ids import problem_id_of, root_of
from derive.cli.running import waiting
from derive.cli.terminal import complain


def export(arguments: argparse.Namespace) -> int:
    from derive.building.cache import cache_of_set
    from derive.building.document_list import list_again
    from derive.building.files import folder, shown_path
    from derive.building.manifest import EXPORT_SUFFIX, Manifest
    from derive.building.recipe import input_digest, recipe_of, stated_by
    from derive.building.set_names import set_folder
    from derive.building.solution import rendered
    from derive.building.workers import done, job_of
    from derive.course.problem import load_problem
    from derive.course.problem_set import path_of, problem_set
    from derive.exporting.questions import questions_of
    from derive.exporting.word import check_installed

    started = time.time_ns()
    root, asked = root_of(arguments), problem_id_of(arguments.id)
    set_id, _, name = asked.partition("/")
    file = f"{name or set_id}-{arguments.format}.{EXPORT_SUFFIX[arguments.format]}"
    output = arguments.output or str(set_folder(root, set_id) / file)
    check_output(output, root)
    heading = problem_set(root, set_id)
    if name:
        path_of(root, asked)
    if arguments.format == "docx":
        check_installed()
    if not arguments.output:
        folder(set_folder(root, set_id))
    pages, cache = [], cache_of_set(root, set_id)
    for problem_id in [asked] if name else heading.problems:
        with waiting(f"deriving {problem_id}"):
            work = partial(rendered, root, problem_id, heading.detail, cache, draws=True, only=("questions",))
            pages.append(done(job_of(root, problem_id, work, arguments.time_limit)))
    complain(warning for page in pages for warning in page.warnings)
    questions = questions_of(pages)
    if arguments.format in ("moodle", "stack"):
        from derive.exporting.moodle import is_for_stack, moodle_xml

        content = moodle_xml(heading.course, heading.title, questions, arguments.format == "stack").encode()
    elif arguments.format == "prairielearn":
        from derive.exporting.prairielearn import prairielearn_package

        content = prairielearn_package(set_id, heading.title, questions)
    elif arguments.format == "canvas":
        from derive.exporting.canvas import canvas_package

        content = canvas_package(set_id, heading.title, questions)
    elif arguments.format == "docx":
        from derive.exporting.word import word_document

        content = word_document(heading.title, questions)
    else:
        from derive.exporting.qti import qti_package

        content = qti_package(set_id, heading.title, questions)
    deliver(content, output)
    of_set = stated_by(heading)
    recipe = recipe_of(root, of_set=of_set)
    read = {*heading.inputs, *(path for page in pages for path in page.inputs)}
    inputs = {path: input_digest(root / path, started) for path in sorted(read)}
    record = partial(Manifest.was_exported, file=file, recipe=recipe, inputs=inputs, of_set=of_set)
    list_again(root, set_id, None if arguments.output else record)
    if output != "-":
        parts = [part for each in questions for part in each.parts]
        separate = arguments.format == "canvas"  # in Canvas, each numerical answer is a question of its own
        count = sum(len(part.answers) if separate and part.is_numerical else 1 for part in parts)
        print(f"wrote {shown_path(root / output)}: {count} question{'s' if count != 1 else ''}")
        if arguments.format == "stack" and not any(is_for_stack(part) for part in parts):
            print("no part has only answers that STACK can compare, so the file is the same as with `--format moodle`")
        if any(load_problem(root, page.id).variations for page in pages):
            print("the questions have the values of the problems themselves, not those under `variants:`")
    return 0
