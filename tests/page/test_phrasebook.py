"""Broken, missing and repeated phrases are errors at their line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from derive.course.names import Language
from derive.errors import Rejected
from derive.page.phrasebook import read_phrases
from derive.page.template import Templates, templates_of
from derive.page.wording import phrases
from tests.courses import ROOT

PHRASES = ROOT / "templates" / "phrases" / "en"
PAGE = (PHRASES / "page.yaml").read_text(encoding="utf-8")


def with_page(folder: Path, text: str) -> Path:
    own = folder / "phrases" / "en"
    own.mkdir(parents=True)
    for file in PHRASES.iterdir():
        (own / file.name).symlink_to(file)
    (own / "page.yaml").unlink()
    (own / "page.yaml").write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (PAGE, "", "the file must be a table of phrases"),
        (PAGE, "- 1\n", "the file must be a table of phrases"),
        ("terms:", "terms: [", "this `[` is not closed"),
        ("terms:", "tirms:", "`tirms` is not a kind of phrase"),
        ("  part: part\n", "  part: 3\n", "`labels.part` must be text"),
        ("  part: part\n", "  part: part\n  part: part\n", "`part` is given twice"),
        ("explain_columns: [", "explain_columns: x\n  unused: [", "`labels.explain_columns` must be a list of phrases"),
        ("grades:\n", "grades: none\nmarks:\n", "`grades` must be a table of phrases"),
    ],
)
def test_broken_phrases_are_told_with_their_file(tmp_path: Path, old: str, new: str, message: str) -> None:
    with_page(tmp_path, PAGE.replace(old, new, 1))
    with pytest.raises(Rejected) as caught:
        read_phrases([tmp_path / "phrases" / "en"])
    complaint = caught.value.complaints[0]
    assert message in complaint.message
    assert complaint.place
    assert complaint.place.path == "templates/phrases/en/page.yaml"


@pytest.mark.parametrize("phrase", ["<<r", "<<rr>>", "<<1/0>>", "<% if %>", "<<symbol.x.y>>"])
def test_a_phrase_that_cannot_be_filled_is_told_at_its_line(tmp_path: Path, phrase: str) -> None:
    from derive.page.wording import filled

    with_page(tmp_path, PAGE.replace("along: along", f"along: {json.dumps(phrase)}", 1))
    with pytest.raises(Rejected) as caught:
        filled(phrases(Templates((tmp_path,))).labels["along"], {"symbol": 1})
    place = caught.value.complaints[0].place
    assert place
    assert (place.path, place.text.strip()) == ("templates/phrases/en/page.yaml", f"along: {json.dumps(phrase)}")


def test_a_phrase_that_two_files_have_is_told(tmp_path: Path) -> None:
    with_page(tmp_path, PAGE + "routes:\n  rotation.torque:\n    carried_round: once more\n")
    with pytest.raises(Rejected, match=r"another file also has `routes\.rotation\.torque`"):
        read_phrases([tmp_path / "phrases" / "en"])


def test_a_label_that_is_missing_is_told_and_not_a_key_error(tmp_path: Path) -> None:
    with_page(tmp_path, PAGE.replace("  second_route: second route\n", ""))
    with pytest.raises(Rejected, match="the phrases have no `second_route` under `labels`"):
        phrases(Templates((tmp_path,))).labels["second_route"]


def course_with(folder: Path, text: str) -> Templates:
    """Return the templates of derive with one file of phrases of a course."""
    own = folder / "templates" / "phrases" / "en"
    own.mkdir(parents=True)
    (own / "own.yaml").write_text(text)
    found = templates_of(folder)
    assert found.folders == (folder / "templates", ROOT / "templates")
    return found


def test_a_course_can_replace_single_phrases(tmp_path: Path) -> None:
    own = phrases(course_with(tmp_path, "labels:\n  problem: Exercise\n"))
    assert own.labels["problem"] == "Exercise"
    assert own.labels["part"] == phrases(templates_of(ROOT)).labels["part"]


def test_a_phrase_that_replaces_nothing_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        phrases(course_with(tmp_path, "labels:\n  probelm: Exercise\n"))
    complaint = caught.value.complaints[0]
    assert complaint.help == "did you mean `problem`?"
    assert complaint.place and (complaint.place.path, complaint.place.line) == ("templates/phrases/en/own.yaml", 2)


def test_a_word_of_a_course_has_the_forms_of_its_language(tmp_path: Path) -> None:
    own = tmp_path / "templates" / "phrases" / "de"
    own.mkdir(parents=True)
    (own / "own.yaml").write_text("terms:\n  kolben: {nom: der Kolben, akk: den Kolben}\n")
    with pytest.raises(Rejected) as caught:
        phrases(templates_of(tmp_path), Language("de"))
    (complaint,) = caught.value.complaints
    assert "`terms.kolben` has the form `akk`" in complaint.message
    assert (complaint.help or "").startswith("the forms are `nom`, `acc`, ")
    assert complaint.place and complaint.place.line == 2
    (own / "own.yaml").write_text("terms:\n  kolben: {nom: der Kolben, acc: den Kolben}\n")
    assert phrases(templates_of(tmp_path), Language("de")).terms["kolben"] == {
        "nom": "der Kolben",
        "acc": "den Kolben",
    }
