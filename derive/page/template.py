"""Templates of phrases and of TeX: an unknown name in a template is an error, and a template cannot run code.

`<<name>>` prints a value, `<% if ... %>` is a condition, `<# ... #>` is a comment; braces belong to TeX.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import StrictUndefined
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import missing

from derive import FOLDER
from derive.errors import Complaint, Rejected, did_you_mean, nearest

PRINTED = ("latex", "html")  # the folders of templates
TEMPLATE, WORDS = (".j2", ".css", ".js", ".tex", ".html"), (".yaml", ".yml")  # suffixes
COMPLETE = "new"  # a folder that only the templates of derive itself have


@dataclass(frozen=True)
class Templates:
    """The folders of templates in order: a file of an earlier folder replaces the file of the same name in a later
    one."""

    folders: tuple[Path, ...]

    def file(self, name: str) -> Path:
        """Return the first existing file of this name in the folders; if there is none, its path in the last folder."""
        paths = [folder / name for folder in self.folders]
        return next((path for path in paths if path.is_file()), paths[-1])

    def files(self, pattern: str) -> dict[str, Path]:
        """Return the files that match the pattern, by name, in the order of the names."""
        found = {path.name: path for folder in reversed(self.folders) for path in folder.glob(pattern)}
        return dict(sorted(found.items()))


def templates_of(root: Path) -> Templates:
    """Return the course's folder of templates, if there is one, and then the templates of derive itself."""
    folders = [each / "templates" for each in (root, Path(FOLDER), Path(FOLDER).parent)]
    complete = next((folder for folder in folders if (folder / COMPLETE).is_dir()), None)
    if complete is None:
        raise Rejected(Complaint("no-templates", "the templates of derive were not found"))
    own = folders[0]
    return Templates((own, complete) if own != complete and own.is_dir() else (complete,))


def unused_templates(root: Path) -> list[Complaint]:
    """Return a warning for each file that has no effect in the templates of a course."""
    templates = templates_of(root)
    if len(templates.folders) == 1:
        return []
    own, ours = templates.folders
    found = [file for file in sorted(own.rglob("*")) if file.is_file() and file.suffix in (*TEMPLATE, *WORDS)]
    texts = {
        file: file.read_text(encoding="utf-8", errors="replace") for file in found if _folder(own, file) in PRINTED
    }
    languages = {page.parent.name for folder in (own, ours) for page in (folder / "phrases").glob("*/page.yaml")}

    def is_used(file: Path) -> bool:
        if file.suffix in WORDS:
            of_language = file.parent.parent == own / "phrases" and file.parent.name in languages
            return of_language and file.suffix == WORDS[0]
        name = file.relative_to(own / _folder(own, file)).as_posix()
        included = any(f'"{name}"' in text for each, text in texts.items() if each != file)
        return file in texts and (included or (ours / file.relative_to(own)).is_file())

    return [_unused(own, ours, file, languages) for file in found if not is_used(file)]


def _folder(own: Path, file: Path) -> str:
    """Return the first folder of the path of a file below `own`; "." if the file is in `own` itself."""
    return (file.parent.relative_to(own).parts or (".",))[0]


def _unused(own: Path, ours: Path, file: Path, languages: Collection[str]) -> Complaint:
    there = [folder for folder in PRINTED if (ours / folder / file.name).is_file()]
    if file.suffix in WORDS:
        why = "it is not in the folder of a language"
        help_line: str | None = f"put it in `templates/phrases/{nearest(file.parent.name, languages) or 'en'}`"
        if file.suffix != WORDS[0]:
            why, help_line = "files of phrases end with `.yaml`", f"rename it to `{file.stem}.yaml`"
    elif there:
        why, help_line = "it is in the wrong folder", f"put it in `templates/{there[0]}`"
    else:
        why = "derive has no template of this name"
        help_line = did_you_mean(file.name, [each.name for folder in PRINTED for each in (ours / folder).glob("*")])
    message = f"nothing uses `templates/{file.relative_to(own).as_posix()}`: {why}"
    return Complaint("unused-template", message, help=help_line, severity="warning")


class Unknown(StrictUndefined):
    """A name without a value. The message about an unknown attribute suggests a similar name, and does not name classes
    of derive."""

    @property
    def _undefined_message(self) -> str:
        if self._undefined_hint or not isinstance(self._undefined_name, str):
            return super()._undefined_message
        name, of = self._undefined_name, self._undefined_obj
        if of is missing:
            return f"no value is called `{name}`"
        known = of if isinstance(of, Mapping) else dir(of)
        help_line = did_you_mean(name, [each for each in known if not str(each).startswith("_")])
        return f"no attribute is called `{name}`{f'; {help_line}' if help_line else ''}"


def environment(**own: Any) -> ImmutableSandboxedEnvironment:
    """Return a sandboxed Jinja environment with the delimiters `<<`, `<%` and `<#`.

    own   further options, such as the loader and the function that prints a value
    """
    return ImmutableSandboxedEnvironment(
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=Unknown,
        autoescape=False,  # Jinja escapes HTML only
        **own,
    )
