"""Fills the templates of TeX and HTML: plain text is escaped, and an error is reported with its line."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, TemplateError, TemplateNotFound, TemplateSyntaxError, Undefined

from derive import FOLDER
from derive.errors import Complaint, DeriveError, Place, Rejected
from derive.page.template import Templates, environment
from derive.render.notation.latex import escaped
from derive.render.rendered import Html, Tex

LATEX, HTML = "latex", "html"  # folders of templates; each has one kind of text, `Tex` or `Html`
ESCAPED: Mapping[str, tuple[type[str], Callable[[str], str]]] = {LATEX: (Tex, escaped), HTML: (Html, escape)}


def filled_template(templates: Templates, template: str, facts: Mapping[str, Any]) -> Tex:
    """Fill a template of the folder `latex`; an error in the template is reported with its line."""
    return Tex(_filled(templates, LATEX, template, facts))


def filled_html(templates: Templates, template: str, facts: Mapping[str, Any]) -> Html:
    """Fill a template of the folder `html`."""
    return Html(_filled(templates, HTML, template, facts))


def _filled(templates: Templates, kind: str, template: str, facts: Mapping[str, Any]) -> str:
    try:
        return _environment(templates, kind).get_template(template).render(facts)
    except TemplateNotFound as error:
        message = f"the template `{error.name}` does not exist"
        help_line = f"it belongs in `{_shown(templates.folders[0] / kind)}`"
        raise Rejected(Complaint("template", message, help=help_line)) from error
    except TemplateSyntaxError as error:
        at = _line(templates.file(f"{kind}/{error.name or template}"), error.lineno)
        message, help_line = f"the template cannot be read: {_said(error)}", None
        if unexpected := re.fullmatch(r"(.*unexpected )(?:char )?'(\\?.)'(?: at \d+)?", message):
            message = f"{unexpected[1]}character `{unexpected[2][-1]}`"
            help_line = "`<<` needs `>>`, and `<%` needs `%>`"
        raise Rejected(Complaint("template", message, at, help=help_line)) from error
    except (OSError, UnicodeError) as error:
        raise Rejected(Complaint("template", f"the template `{template}` cannot be read: {_said(error)}")) from error
    except DeriveError:
        raise
    except Exception as error:
        place = _failing_line(error, templates.files(f"{kind}/*.j2"))
        if place is None:
            raise
        raise Rejected(Complaint("template", f"the template fails: {_said(error)}", place)) from error


def filled_above(templates: Templates, template: str, line: str, facts: Mapping[str, Any]) -> Tex:
    """Fill the text of a template above the text `line`; the result is empty if this fails."""
    with suppress(TemplateError, OSError, UnicodeError):
        above, found, _ = templates.file(f"{LATEX}/{template}").read_text(encoding="utf-8").partition(line)
        if found:
            return Tex(_environment(templates, LATEX).from_string(above).render(facts))
    return Tex("")


def compile_templates(templates: Templates) -> None:
    """Compile all templates before processes fill them; an error in a template is reported when it is filled."""
    for loaded in (_environment(templates, kind) for kind in ESCAPED):
        for name in loaded.list_templates(["j2"]):
            with suppress(TemplateError, OSError, UnicodeError):
                loaded.get_template(name)


def _failing_line(error: Exception, templates: Mapping[str, Path]) -> Place | None:
    """Return the line of the template that raised the error; None if the error did not arise in a template."""
    files = {str(file): file for file in templates.values()}
    frames = traceback.extract_tb(error.__traceback__)
    theirs = [i for i, frame in enumerate(frames) if frame.filename in files]
    below = frames[theirs[-1] + 1 :] if theirs else []
    if not theirs or any(Path(frame.filename).is_relative_to(FOLDER) for frame in below):
        return None
    last = frames[theirs[-1]]
    return _line(files[last.filename], last.lineno or 1)


def _line(file: Path, number: int) -> Place:
    """Return the place of a line in a template; the path of the template begins with `templates/`."""
    try:
        lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    text = lines[number - 1] if 0 < number <= len(lines) else ""
    indent = len(text) - len(text.lstrip())
    return Place(_shown(file), number, indent + 1, text[:150], len(text[:150].strip()))


def _shown(file: Path) -> str:
    """Return a path such as `templates/latex/set.tex.j2`, independent of where the folder of templates is."""
    parts = file.parts[::-1]
    return "/".join(file.parts[-parts.index("templates") - 1 :]) if "templates" in parts else file.name


@cache
def _environment(templates: Templates, kind: str) -> Environment:
    ours, safe = ESCAPED[kind]

    def printed(value: Any) -> Any:
        """Escape a printed value unless it has the type of the template, `Tex` or `Html`; an undefined value raises an
        error when printed."""
        return value if isinstance(value, ours | Undefined) else ours(safe(str(value)))

    made = environment(
        loader=FileSystemLoader([folder / kind for folder in templates.folders]),
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=printed,  # every template escapes the values that it prints
    )
    if kind == LATEX:
        made.filters["bookmark"] = bookmark_text
    return made


def bookmark_text(text: str) -> Tex:
    """Return text for the title of a PDF or for a bookmark, which cannot contain fonts or formulas."""
    return Tex("".join(escaped(c) if c.isascii() else rf"\unichar{{{ord(c)}}}" for c in text))


def _said(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return (lines[0] if lines else type(error).__name__).rstrip(".")
