"""Where templates lie and are filled, those of phrases and of TeX: an unknown name is an error, and none reaches code.

`<<name>>` is printed, `<% if ... %>` chooses, `<# ... #>` says nothing: no braces, which TeX has for itself.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jinja2 import StrictUndefined
from jinja2.sandbox import ImmutableSandboxedEnvironment

from derive import FOLDER
from derive.errors import Complaint, Rejected


def template_folder(root: Path) -> Path:
    """The course's own templates if it has them, else those of the installation."""
    for folder in (each / "templates" for each in (root, Path(FOLDER), Path(FOLDER).parent)):
        if (folder / "phrases" / "en").is_dir():
            return folder
    raise Rejected(Complaint("no-templates", "no `templates/` with phrases was found"))


def environment(**own: Any) -> ImmutableSandboxedEnvironment:
    """An environment; `own` is what one kind of templates has besides: where they are found, how they print a value."""
    return ImmutableSandboxedEnvironment(
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        autoescape=False,  # that would be HTML
        **own,
    )
