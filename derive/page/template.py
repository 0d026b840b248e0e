"""Templates of phrases and of TeX: an unknown name in a template is an error, and a template cannot run code.

`<<name>>` prints a value, `<% if ... %>` is a condition, `<# ... #>` is a comment; braces belong to TeX.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import StrictUndefined
from jinja2.sandbox import ImmutableSandboxedEnvironment

from derive import FOLDER
from derive.errors import Complaint, Rejected


def template_folder(root: Path) -> Path:
    """Return the course's folder of templates if there is one, else the templates of the installation."""
    for folder in (each / "templates" for each in (root, Path(FOLDER), Path(FOLDER).parent)):
        if (folder / "phrases" / "en").is_dir():
            return folder
    raise Rejected(Complaint("no-templates", "no `templates/` with phrases was found"))


def environment(**own: Any) -> ImmutableSandboxedEnvironment:
    """Return an environment of Jinja; `own` are further options, such as the loader and how to print a value."""
    return ImmutableSandboxedEnvironment(
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        autoescape=False,  # Jinja escapes HTML only
        **own,
    )
