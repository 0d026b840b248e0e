"""Templates of phrases and of TeX, and how they are filled: an unknown name is an error, and no template runs code.

`<<name>>` is printed, `<% if ... %>` chooses, `<# ... #>` is a comment; braces are left to TeX.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import StrictUndefined
from jinja2.sandbox import ImmutableSandboxedEnvironment

from derive import FOLDER
from derive.errors import Complaint, Rejected


def template_folder(root: Path) -> Path:
    """Return the course's templates if it has some, else those of the installation."""
    for folder in (each / "templates" for each in (root, Path(FOLDER), Path(FOLDER).parent)):
        if (folder / "phrases" / "en").is_dir():
            return folder
    raise Rejected(Complaint("no-templates", "no `templates/` with phrases was found"))


def environment(**own: Any) -> ImmutableSandboxedEnvironment:
    """Return an environment; `own` are options of one kind of template: where to find them, how to print a value."""
    return ImmutableSandboxedEnvironment(
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        autoescape=False,  # autoescape would be for HTML
        **own,
    )
