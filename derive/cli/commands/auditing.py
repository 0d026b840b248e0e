"""`derive audit`: which rows of a worked document do not follow, and what was probably meant."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from derive.cli.running import waiting


def audit(arguments: argparse.Namespace) -> int:
    """Print the verdicts; the exit code is 1 if a row differs."""
    from derive.audit.auditing import audited
    from derive.audit.report import as_html, as_json, as_text, exit_code
    from derive.documents.layout import read_document
    from derive.documents.source import read_source

    with waiting(f"reading {arguments.file}"):
        found = audited(read_document(read_source(Path(arguments.file), arguments.file)))
    written = {"json": as_json, "html": as_html}.get(arguments.format)
    print(written(found) if written else as_text(found, arguments.verbose))
    sys.stdout.flush()
    return exit_code(found)
