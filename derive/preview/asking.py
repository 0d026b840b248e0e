"""The worker of a preview as its server sees it: asked, waited for, ended when it takes too long, begun anew."""

from __future__ import annotations

import json
import select
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

STEP = 0.05  # seconds between two looks whether an answer is still wanted
PATIENCE = 1.0  # seconds that a question may go on after a newer edit has made it idle


@dataclass(frozen=True)
class Shown:
    """What a browser is to show: the main part of a page, or complaints about the files that it is made from."""

    main: str = ""
    complaints: tuple[str, ...] = ()
    seconds: float = 0.0


@dataclass
class Warm:
    """A worker, started when it is first asked or before."""

    root: Path
    limit: float
    _process: subprocess.Popen[str] | None = field(default=None, repr=False)

    def page(self, problem_id: str, detail: str | None, idle: Any = lambda: False) -> Shown | None:
        """The answer to a question; nothing if it became `idle` while it was worked on."""
        started = time.monotonic()
        process = self.begun()
        assert process.stdin and process.stdout
        try:
            process.stdin.write(json.dumps({"problem": problem_id, "detail": detail}) + "\n")
            process.stdin.flush()
        except BrokenPipeError:
            return self._died(problem_id)
        while not select.select([process.stdout], [], [], STEP)[0]:
            seconds = time.monotonic() - started
            if seconds > self.limit:
                self.end()
                message = f"error[time-limit]: `{problem_id}` took over {self.limit:g} s"
                return Shown(complaints=(f"{message}\n  = help: look for an endless loop in its script",))
            if seconds > PATIENCE and idle():
                self.end()
                return None
        line = process.stdout.readline()
        if not line:
            return self._died(problem_id)
        said = json.loads(line)
        shown = tuple(each["shown"] for each in said.get("complaints", ()))
        return Shown(said.get("main", ""), shown, time.monotonic() - started)

    def begun(self) -> subprocess.Popen[str]:
        """The process, which loads what it needs before it answers."""
        if self._process is not None and self._process.poll() is not None:
            self.end()
        if self._process is None:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "derive.preview.worker", str(self.root)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                encoding="utf-8",
                start_new_session=True,  # Ctrl-C is for the server, which ends it
            )
        return self._process

    def _died(self, problem_id: str) -> Shown:
        self.end()
        message = f"error[worker-died]: `{problem_id}` ended its process\n  = help: does its script end the program?"
        return Shown(complaints=(message,))

    def end(self) -> None:
        if self._process is not None:
            self._process.kill()
            with suppress(BrokenPipeError), self._process:  # its pipes are closed, and it is waited for
                pass
            self._process = None
