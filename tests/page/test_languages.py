"""Each language has the phrases of English: the same files and keys. A phrase prints the same names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from jinja2.meta import find_undeclared_variables
from sympy import Integer, Rational

from derive.algebra.expressions import Amount
from derive.course.names import DecimalSign, Language
from derive.errors import Rejected
from derive.page.template import environment, templates_of
from derive.page.wording import Text, filled, phrases
from derive.render.notation.latex import latex
from derive.render.notation.mathml import mathml
from derive.render.notation.notation import Notation
from derive.render.notation.text import plain
from tests.courses import ROOT

PHRASES = ROOT / "templates" / "phrases"
LANGUAGES = sorted(folder.name for folder in PHRASES.iterdir() if folder.name != "en")
OF_THE_LANGUAGE = ("labels.language", "labels.own_name", "labels.verdicts", "labels.report_page.columns", "laws")
MAY_HAVE_MORE = ("terms.", "labels.rules.")  # names of bodies, and of rules whose key has another name in English
ENVIRONMENT = environment()


def phrases_of(folder: Path, file: str) -> dict[str, Any]:
    """Return the phrases of a file by their keys; the forms of a term are together under one key."""
    return dict(_flat(yaml.load((folder / file).read_text(), Loader=yaml.CSafeLoader), ()))


def _flat(value: Any, keys: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    name = ".".join(keys)
    if name in OF_THE_LANGUAGE or not isinstance(value, Mapping) or keys[:1] == ("terms",) and len(keys) == 2:
        yield name, value
    else:
        for key, each in value.items():
            yield from _flat(each, (*keys, key))


def names_in(phrase: Any) -> set[str]:
    return {name for text in texts_of(phrase) for name in _names(text)}


def names_printed(phrase: Any) -> set[str]:
    return {name for text in texts_of(phrase) for name in re.findall(r"<<(\w+)", text)}


def texts_of(phrase: Any) -> Iterable[str]:
    return phrase.values() if isinstance(phrase, Mapping) else phrase if isinstance(phrase, list) else [phrase]


@cache
def _names(text: str) -> frozenset[str]:
    plain = re.sub(r"<<(\w+)(\.\w+)?>>", "", text)
    found = re.findall(r"<<(\w+)(?:\.\w+)?>>", text)
    rest = find_undeclared_variables(ENVIRONMENT.parse(plain)) if "<<" in plain or "<%" in plain else ()
    return frozenset((*found, *rest))


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_language_is_complete(language: str) -> None:
    files = sorted(file.name for file in (PHRASES / "en").glob("*.yaml"))
    assert sorted(file.name for file in (PHRASES / language).glob("*.yaml")) == files
    unlike: list[str] = []
    for file in files:
        ours, theirs = (phrases_of(PHRASES / name, file) for name in ("en", language))
        added = {key for key in theirs if key not in ours and not key.startswith(MAY_HAVE_MORE)}
        unlike += [f"{file}: {key}" for key in sorted({*ours} - {*theirs} | added)]
        for key, phrase in ours.items():
            if key in theirs and key not in OF_THE_LANGUAGE:
                used = names_in(theirs[key])
                if not names_printed(phrase) <= used <= names_in(phrase):
                    unlike.append(f"{file}: {key} uses {sorted(used)}, not {sorted(names_in(phrase))}")
    assert not unlike, "\n".join(unlike)
    rules = phrases_of(PHRASES / language, "report.yaml")  # English derives other names from the keys of the rules
    tasks = phrases_of(PHRASES / language, "rubric.yaml")
    assert not {key.removeprefix("tasks.") for key in tasks} - {key.removeprefix("labels.rules.") for key in rules}


GERMAN = Language("de")


def text_of(template: str, **names: Any) -> str:
    return "".join(node.text for node in filled(template, names) if isinstance(node, Text))


def test_a_word_has_the_form_that_a_phrase_asks_for() -> None:
    words = phrases(templates_of(ROOT), GERMAN)
    phrase = "Der Schwerpunkt <<part.gen>> ist <<start>>, von <<where>> aus."
    told = text_of(phrase, part=words.term("rod"), start=words.term("corner"), where=Text("hier"))
    assert told == "Der Schwerpunkt des Stabes ist die Ecke, von hier aus."
    assert text_of("der Impuls <<part.gen>>", part=words.term("crank")) == "der Impuls von „crank“"
    with pytest.raises(Rejected, match="no attribute"):
        text_of("<<part.gender>>", part=words.term("rod"))


def test_the_shape_of_a_body_has_its_name_in_the_language_of_the_page() -> None:
    """`A <<body.shape>>` is English; other languages have genders, so the article is a part of the name."""
    shown = {name: phrases(templates_of(ROOT), Language(name)).shape("half_disc") for name in ("en", "de", "fr")}
    assert shown == {"en": "half disc", "de": "eine Halbscheibe", "fr": "un demi-disque"}


def test_points_and_numbers_in_text_have_the_decimal_sign() -> None:
    words = phrases(templates_of(ROOT), GERMAN)
    assert [words.worth(Fraction(n)) for n in ("1", "5/2")] == ["1 Punkt", "2,5 Punkte"]
    assert words.numbers((Text("from 0.5 m to 12 m."),)) == (Text("from 0,5 m to 12 m."),)
    assert phrases(templates_of(ROOT), Language("de", DecimalSign.POINT)).worth(Fraction(5, 2)) == "2.5 Punkte"


def test_a_decimal_comma_in_every_format() -> None:
    layout = Notation(language={"decimal": "comma"}).layout(Amount(Rational(3, 2), "kg", Integer(1)))
    assert (plain(layout), latex(layout)) == ("1,5 kg", r"1{,}5\,\mathrm{kg}")
    assert "<mn>1,5</mn>" in mathml(layout)
    pair = Notation(language={"decimal": "comma"}).list_of((Amount(Rational(3, 2), "", Integer(1)), Integer(2)))
    assert (plain(pair), latex(pair)) == ("(1,5; 2)", r"(1{,}5;\ 2)")


def test_an_unknown_language_is_an_error_at_its_place() -> None:
    with pytest.raises(Rejected, match="no phrases of the language `xx`") as caught:
        phrases(templates_of(ROOT), Language("xx"))
    assert "`de`" in (caught.value.complaints[0].help or "")


def test_each_french_name_has_the_forms_that_phrases_use() -> None:
    used = set(re.findall(r"<<\w+\.(\w+)>>", "".join(file.read_text() for file in (PHRASES / "fr").glob("*.yaml"))))
    words = phrases(templates_of(ROOT), Language("fr"))
    tables = {**words.terms, "own_name": words.labels["own_name"]}
    assert used == {"nom", "de", "a"}
    assert not {name for name, forms in tables.items() if isinstance(forms, Mapping) and not used <= forms.keys()}


def test_no_label_is_named_like_a_method_of_a_mapping() -> None:
    """A template would print the method in place of the label."""
    labels = [key for key in phrases_of(PHRASES / "en", "page.yaml") if key.startswith("labels.")]
    methods = {name for name in dir(dict) if not name.startswith("_")}
    assert labels and [key for key in labels if methods.intersection(key.split("."))] == []
