"""`derive preview`: pages in the browser while you write them."""

from __future__ import annotations

import argparse
from contextlib import suppress

from derive.cli.problem_ids import problem_id_of, root_of
from derive.cli.running import ending
from derive.cli.streams import silence


def preview_pages(arguments: argparse.Namespace) -> int:
    """Serve a page until the user interrupts, which is the normal end and not a failure."""
    from derive.preview.preview import preview
    from derive.preview.worker_control import Shown

    set_id, _, name = problem_id_of(arguments.id).partition("/")

    def ready(address: str) -> None:
        print(f"{address} (Ctrl-C ends it)", flush=True)
        if arguments.open:
            import webbrowser

            webbrowser.open(address)

    def told(of: str, shown: Shown) -> None:
        if arguments.quiet and shown.main:
            return
        said, why = ("shown", []) if shown.main else ("not shown", shown.complaints[:1])
        try:
            print(*[f"{set_id}/{of}: {said} ({shown.seconds:.2f} s)", *why], sep="\n", flush=True)
        except (OSError, ValueError):  # nobody reads the output any more, but the page is still served
            silence(1)

    with suppress(KeyboardInterrupt):
        root, port, limit = root_of(arguments), arguments.port, arguments.time_limit
        preview(root, set_id, name, port, arguments.detail, limit, ready, told, ending)
    return 0
