"""`derive audit`: which rows of a worked document do not follow, and what was probably meant."""

from __future__ import annotations

import argparse
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from derive.cli.problem_ids import problem_id_of, root_of
from derive.cli.running import waiting
from derive.cli.terminal import tell

if TYPE_CHECKING:
    from derive.audit.expected import Expected


def audit(arguments: argparse.Namespace) -> int:
    """Print the verdicts; the exit code is 1 if a row differs."""
    from derive.audit.assumptions import assumed_of, declared_letters
    from derive.audit.auditing import audited
    from derive.audit.report import as_html, as_json, as_text, exit_code
    from derive.documents.layout import read_document
    from derive.documents.source import read_source

    name = arguments.file
    assumed = [assumed_of(text) for text in arguments.assume]
    declared = declared_letters(Path(arguments.symbols)) if arguments.symbols else {}
    with waiting(f"reading {name}"):
        document = read_document(read_source(Path(name), name))
        expected = [result for each in arguments.problem for result in _expected(arguments, each)]
        found = audited(document, assumed, declared, expected, partial(_progress, name))
    written = {"json": as_json, "html": as_html}.get(arguments.format)
    print(written(found) if written else as_text(found, arguments.verbose))
    sys.stdout.flush()
    return exit_code(found)


def _progress(name: str, line: int, left: int) -> None:
    tell(f"{name}: line {line}, {left} claims left")


def _expected(arguments: argparse.Namespace, named: str) -> list[Expected]:
    from derive.building.expected import expected_results
    from derive.building.workers import done, job_of
    from derive.course.problem_set import path_of

    root, problem_id = root_of(arguments), problem_id_of(named)
    path_of(root, problem_id)
    tell(f"deriving {problem_id}")
    work = partial(expected_results, root, problem_id)
    found: list[Expected] = done(job_of(root, problem_id, work, arguments.time_limit))
    return found
