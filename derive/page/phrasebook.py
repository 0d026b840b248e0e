"""The phrases of a language: a folder of `templates/phrases` with one file for each topic."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn

import yaml

from derive.course.yaml_tree import Source, abridged, read_source, yaml_tree
from derive.errors import Complaint, Place, Rejected, did_you_mean

SHOWN_AS = "templates/phrases"
OF_EVERY_PAGE = "page.yaml"
MAX_PHRASES = 20_000

_ANY, _TEXT = "*", "text"
_TABLE = {_ANY: _TEXT}
_FORMS = "text, or a table of its forms"
_SHAPE: dict[str, Any] = {
    "rules": {_ANY: _TABLE},
    "routes": {_ANY: _TABLE},
    "reasons": {_ANY: _TABLE},
    "theorems": _TABLE,
    "theorems_again": _TABLE,
    "setups": {_ANY: _TABLE},
    "clauses": {_ANY: _TABLE},
    "tasks": _TABLE,
    "laws": _TABLE,
    "terms": {_ANY: _FORMS},
    "bodies": _TABLE,
    "sizes": _TABLE,
    "drawings": _TABLE,
    "grades": _TABLE,
    "labels": {
        _ANY: _TEXT,
        "unnamed": [_TEXT],
        "verdicts": [_TEXT],
        "language": _TABLE,
        "own_name": _TABLE,
        "rules": _TABLE,
        "explain": _TABLE,
        "documents": _TABLE,
        "hints": _TABLE,
        "web": _TABLE,
        "explain_headings": [_TEXT],
        "explain_columns": [_TEXT],
        "report_page": {_ANY: _TEXT, "intro": [_TEXT], "columns": {_ANY: [_TEXT]}, "row": [_TEXT]},
    },
}


class Phrase(str):
    """A phrase with its file and the YAML keys under which the file contains it."""

    source: Source
    keys: tuple[str, ...]

    @property
    def place(self) -> Place:
        return _place(self.source, self.keys)


class PhraseTable(dict[str, Any]):
    """Phrases by name; access to a missing phrase raises `Rejected` with the place in the file."""

    def __init__(self, source: Source, keys: tuple[str, ...]):
        super().__init__()
        self.source, self.keys_above = source, keys

    def __missing__(self, name: str) -> NoReturn:
        where = f" under `{'.'.join(self.keys_above)}`" if self.keys_above else ""
        message, help_line = f"the phrases have no `{name}`{where}", did_you_mean(str(name), self)
        raise Rejected(Complaint("no-phrase", message, _place(self.source, self.keys_above), help=help_line))


def no_phrase(key: str, rule: str, outcome: str, rules: PhraseTable) -> Complaint:
    """Return the error for a step without a sentence; it shows the rule's phrases, or names the file to edit."""
    message, place = f"`{key}`: no phrase for `{rule}` with the outcome `{outcome}`", None
    folder = _place(rules.source, ()).path.rpartition("/")[0]
    help_line = f"write `rules: {{{rule}: {{{outcome}: ...}}}}` in {folder}/{rule.partition('.')[0]}.yaml"
    if (of_rule := rules.get(rule)) is not None:
        place, known = _place(of_rule.source, of_rule.keys_above), ", ".join(f"`{name}`" for name in of_rule)
        help_line = f"the rule has phrases for {known}: write one for `{outcome}` too"
    return Complaint("no-phrase", message, place, help=help_line)


def read_phrases(folders: Sequence[Path]) -> PhraseTable:
    """Return the phrases of the last folder; a phrase in an earlier folder replaces the phrase with the same name.

    Raise `Rejected` with the line of an error.
    """
    *replacing, own = folders
    page = _phrases_of(own / OF_EVERY_PAGE)
    for file in sorted(own.glob("*.yaml")):
        if file.name != OF_EVERY_PAGE:
            _add(page, _phrases_of(file))
    forms = _forms_of([*page["terms"].values(), page["labels"]["own_name"]])
    for folder in reversed(replacing):
        for file in sorted(folder.glob("*.yaml")):
            replaced = _phrases_of(file)
            _check_forms(replaced.get("terms", {}), forms)
            _replace(page, replaced, ())
    for name in _SHAPE:
        page[name]  # raises an error if the table is missing
    page["reasons"]["general"]
    return page


class _Loader(yaml.CSafeLoader):
    """Reads phrases; a key that occurs twice in a mapping is an error."""

    def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
        found: dict[Any, Any] = super().construct_mapping(node, deep)
        if len(found) < len(node.value):
            raise yaml.YAMLError("a key is given twice")
        return found


def _phrases_of(file: Path) -> PhraseTable:
    shown_as = f"{SHOWN_AS}/{file.parent.name}/{file.name}"
    source = read_source(file, shown_as)
    try:
        loaded = yaml.load(source.text, Loader=_Loader)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        yaml_tree(source)  # raises an error with its line if the YAML is invalid
        lines = str(error).splitlines() or [type(error).__name__]
        raise Rejected(Complaint("yaml", f"the phrases cannot be read: {lines[0]}", Place(shown_as, 1))) from None
    table: PhraseTable = _Checked(source).phrases(loaded, _SHAPE, ())
    return table


def _add(page: PhraseTable, topic: PhraseTable) -> None:
    for sort, table in topic.items():
        known = page.setdefault(sort, PhraseTable(page.source, (sort,)))
        for name, phrases in table.items():
            if name in known:
                place = _place(topic.source, (sort, name))
                raise Rejected(Complaint("phrases", f"another file also has `{sort}.{name}`", place))
            known[name] = phrases


def _replace(known: PhraseTable, own: PhraseTable, keys: tuple[str, ...]) -> None:
    """Replace phrases of derive by phrases of a course. A new phrase is rejected, except under `terms`."""
    for name, phrases in own.items():
        if name not in known and keys != ("terms",):  # a course may have words for the names of its own bodies
            message = f"derive has no phrase `{'.'.join((*keys, name))}` that this one could replace"
            place = _place(own.source, (*keys, name))
            raise Rejected(Complaint("phrases", message, place, help=did_you_mean(name, known)))
        if isinstance(phrases, PhraseTable) and isinstance(known.get(name), PhraseTable):
            _replace(known[name], phrases, (*keys, name))
        else:
            known[name] = phrases


def _forms_of(words: Iterable[Any]) -> dict[str, None]:
    """Return the names of the forms that words have in a language, such as the cases of a noun."""
    return {form: None for forms in words if isinstance(forms, PhraseTable) for form in forms}


def _check_forms(terms: Mapping[str, Any], known: Mapping[str, None]) -> None:
    """Reject a form that no word of the language has."""
    for name, forms in terms.items():
        for form in _forms_of([forms]):
            if form not in known:
                message = f"`terms.{name}` has the form `{form}`, which no word of derive has in this language"
                help_line = did_you_mean(form, known) or f"the forms are {', '.join(f'`{each}`' for each in known)}"
                raise Rejected(Complaint("phrases", message, forms[form].place, help=help_line))


class _Checked:
    """Checks the structure of a file and records the place of each phrase; a file with a different structure
    is rejected."""

    def __init__(self, source: Source):
        self.source, self.count = source, 0

    def phrases(self, value: Any, shape: Any, keys: tuple[str, ...]) -> Any:
        self.count += 1
        if self.count > MAX_PHRASES:
            _wrong(self.source, (), f"shorter: there are more than {MAX_PHRASES} phrases")
        if shape == _FORMS:
            shape = _TABLE if isinstance(value, dict) else _TEXT
        if shape == _TEXT:
            return self.text(value, keys)
        if isinstance(shape, list):
            if not isinstance(value, list):
                _wrong(self.source, keys, "a list of phrases")
            return [self.phrases(each, shape[0], keys) for each in value]
        if not isinstance(value, dict):
            _wrong(self.source, keys, "a table of phrases")
        table = PhraseTable(self.source, keys)
        for name, each in value.items():
            if not isinstance(name, str):
                _wrong(
                    self.source, keys, f"a table of phrases by their names, but `{abridged(str(name))}` is not a name"
                )
            if name not in shape and _ANY not in shape:
                message, help_line = f"`{abridged(name)}` is not a kind of phrase", did_you_mean(name, shape)
                raise Rejected(Complaint("phrases", message, _place(self.source, (*keys, name)), help=help_line))
            table[name] = self.phrases(each, shape.get(name, shape.get(_ANY)), (*keys, name))
        return table

    def text(self, value: Any, keys: tuple[str, ...]) -> Phrase:
        if not isinstance(value, str):
            _wrong(self.source, keys, "text", "put it in quotes" if isinstance(value, int | float) else None)
        phrase = Phrase(value)
        phrase.source, phrase.keys = self.source, keys
        return phrase


def _wrong(source: Source, keys: tuple[str, ...], wanted: str, help_line: str | None = None) -> NoReturn:
    what = f"`{'.'.join(keys)}`" if keys else "the file"
    raise Rejected(Complaint("phrases", f"{what} must be {wanted}", _place(source, keys), help=help_line))


def _place(source: Source, keys: tuple[str, ...]) -> Place:
    """Return the line of the last of these keys that the file has."""
    node, index = yaml.compose(source.text, Loader=yaml.CSafeLoader), 0
    for name in keys:
        pairs = node.value if isinstance(node, yaml.MappingNode) else []
        found = next(((key, value) for key, value in pairs if key.value == name), None)
        if found is None:
            break
        index, node = found[0].start_mark.index, found[1]
    place = source.place(index)
    return source.place(index, len(place.text))
