"""Questions of PrairieLearn: a folder for each part, with `info.json`, `question.html` and `server.py`, in a ZIP file.

A number has a field that compares significant figures. A formula of letters, numbers and common functions has a field
for symbolic input, so that PrairieLearn can compare it. A part with any other answer is graded by a person.

Source of the format: PrairieLearn documentation, "Question configuration" and "Elements".
"""

from __future__ import annotations

import json
import re
import uuid
from collections.abc import Sequence
from html import escape
from keyword import kwlist

from derive.exporting.packages import zipped
from derive.exporting.questions import CONSTANTS, Answer, Part, Question, with_files

UNUSABLE = CONSTANTS | {*kwlist}  # names that PrairieLearn does not read as letters


def prairielearn_package(set_id: str, title: str, questions: Sequence[Question]) -> bytes:
    """Return the questions of a set as a ZIP file; equal input gives equal bytes."""
    files: dict[str, bytes] = {}
    for question in questions:
        for part in question.parts:
            files |= _folder(set_id, title, question, part)
    return zipped(files)


def _folder(set_id: str, title: str, question: Question, part: Part) -> dict[str, bytes]:
    name = f"questions/{set_id}/{question.name}{f'-{part.label}' if part.label else ''}"
    address = "{{ options.client_files_question_url }}/"
    texts = _without_tags(f"{question.statement}\n{part.question}"), _without_tags(part.feedback)
    (asked, used), (solution, also) = (with_files(each, lambda file: address + file, question.files) for each in texts)
    usable = [letter for letter in question.letters if letter not in UNUSABLE]
    fields = [_field(number, answer, usable) for number, answer in enumerate(part.answers, 1)]
    graded = all(fields) and bool(fields)
    typing = [question.typing] if any(answer.value is None for answer in part.answers) else []
    shown = (
        "\n".join(map(_without_tags, [*typing, *fields]))
        if graded
        else _element("pl-rich-text-editor", 'file-name="answer.html"')
    )
    page = (
        f"<pl-question-panel>\n{asked}\n</pl-question-panel>\n{shown}\n"
        f"<pl-answer-panel>\n{solution}\n</pl-answer-panel>\n"
    )
    info = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"derive:{set_id}/{question.name}/{part.label}")),
        "title": question.heading(part),
        "topic": title,
        "tags": ["derive"],
        "type": "v3",
        "singleVariant": True,
        **({} if graded else {"gradingMethod": "Manual"}),
    }
    files = {
        "info.json": json.dumps(info, ensure_ascii=False, indent=2) + "\n",
        "question.html": page,
        "server.py": _server(part.answers if graded else ()),
    }
    drawings = {f"clientFilesQuestion/{each}": question.files[each] for each in dict.fromkeys([*used, *also])}
    contents = {**{file: text.encode() for file, text in files.items()}, **drawings}
    return {f"{name}/{file}": content for file, content in contents.items()}


def _without_tags(html: str) -> str:
    """Separate double braces of TeX, because Mustache would read them as tags: `{{` becomes `{ {`."""
    return re.sub(r"\}(?=\})", "} ", re.sub(r"\{(?=\{)", "{ ", html))


def _field(number: int, answer: Answer, usable: Sequence[str]) -> str:
    name = f'answers-name="answer{number}"'
    label = f"<p>{answer.named} =</p>"
    if answer.value is not None:
        unit = f' suffix="{escape(answer.unit)}"' if answer.unit else ""
        figures = answer.figures or 4
        compared = f'{name} comparison="sigfig" digits="{figures}"{unit}'
        return f"{label}\n" + _element("pl-number-input", compared)
    if not _is_comparable(answer):
        return ""
    variables = f'{name} variables="{", ".join(usable)}"'
    return f"{label}\n" + _element("pl-symbolic-input", variables)


def _is_comparable(answer: Answer) -> bool:
    return answer.letters is not None and not answer.letters & UNUSABLE


def _element(tag: str, attributes: str) -> str:
    return f"<{tag} {attributes}></{tag}>"  # HTML has no self-closing form of these elements


def _server(answers: Sequence[Answer]) -> str:
    values = (answer.value if answer.value is not None else _formula(answer) for answer in answers)
    lines = [f'    data["correct_answers"]["answer{number}"] = {value}' for number, value in enumerate(values, 1)]
    return "def generate(data):\n" + ("\n".join(lines) or "    pass") + "\n"


def _formula(answer: Answer) -> str:
    """Return a formula as data of PrairieLearn. All letters are real, and some are positive; without this, sqrt(g/l)
    and sqrt(g)/sqrt(l) would be different for PrairieLearn."""
    letters = sorted(answer.letters or ())
    known = {letter: {"positive" if letter in answer.positive else "real": True} for letter in letters}
    data = {"_type": "sympy", "_value": answer.sympy, "_variables": letters, "_assumptions": known}
    return repr(data | {"_custom_functions": []})
