"""Search for answers in files for students: values and formulas as text, TeX and MathML, also in hidden objects of a
PDF."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from pypdf import PdfReader
from pypdf.generic import ContentStream, DictionaryObject, StreamObject

ANSWER = re.compile(r'<span class="answer">(.*?)<span class="beside">', re.DOTALL)


def plain(text: str) -> str:
    return re.sub(r"\s|\\[,;!]", "", text)


def forms_of_answers(texts: Mapping[str, str]) -> set[str]:
    """Return the forms of each answer on a page that was printed as JSON and, optionally, HTML."""
    found = set[str]()
    for answer in json.loads(texts["json"])["answers"].values():
        found |= {answer["sympy"], *(answer[form].rpartition(" = ")[2] for form in ("text", "latex"))}
        found |= {str(answer["number"]["value"])} if answer["number"] else set()
    for framed in ANSWER.findall(texts.get("html", "")):
        found |= {side.partition("</mo>")[2] for side in re.findall(r"<math[^>]*>(.*?)</math>", framed)[1:]}
    return {plain(each) for each in found if len(plain(each)) > 2}


def texts_in(file: Path) -> Iterable[str]:
    """Yield the text in a file; for a PDF, the text of its pages and of its objects and streams."""
    yield file.name
    if file.suffix != ".pdf":
        yield file.read_text()
        return
    reader = PdfReader(file)
    yield " ".join(page.extract_text() for page in reader.pages)
    for number in range(1, int(str(reader.trailer["/Size"]))):
        if number in reader.xref[0] or number in reader.xref_objStm:
            found = reader.get_object(number)
            yield str(found)
            if isinstance(found, StreamObject) and not isinstance(found, ContentStream):
                if isinstance(found, DictionaryObject) and "/FontFile" not in str(found) and "/Length1" not in found:
                    yield found.get_data().decode("latin-1")


def leaks(folder: Path, texts: Mapping[str, str]) -> list[str]:
    """Return the names of files that show an answer, each with the form of the answer."""
    forms = forms_of_answers(texts)
    assert forms
    found = []
    for file in sorted(each for each in folder.rglob("*") if each.is_file()):
        shown = [plain(text) for text in texts_in(file)]
        found += [f"{file.name}: {form}" for form in forms if any(form in text for text in shown)]
    return found
