"""A package of QTI 2.1: one assessment item for each part of each problem, a test, and a manifest, in a ZIP file.

A part whose answers are numbers becomes an item with a field for each number. A number is right if it differs from
the result by at most half a unit of the last printed digit. In the items of other parts, the student writes a text. The
worked solution is the modal feedback of the item.

Source of the format: IMS Global, *Question and Test Interoperability Assessment Test, Section and Item Information
Model*, version 2.1.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

from derive.exporting.packages import zipped
from derive.exporting.questions import Answer, Part, Question, with_files

QTI = "http://www.imsglobal.org/xsd/imsqti_v2p1"
PACKAGE = "http://www.imsglobal.org/xsd/imscp_v1p1"
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'


def qti_package(set_id: str, title: str, questions: Sequence[Question]) -> bytes:
    """Return the questions of a set as a ZIP file; equal input gives equal bytes."""
    files: dict[str, bytes] = {}
    items: list[tuple[str, list[str]]] = []
    for question in questions:
        for part in question.parts:
            name = _identifier(f"{question.name}-{part.label or 'a'}")
            text, used = _item(name, question, part)
            files[f"{name}.xml"] = text.encode()
            files |= {f"files/{each}": question.files[each] for each in used}
            items.append((name, [f"files/{each}" for each in used]))
    files["test.xml"] = _test(set_id, title, [name for name, _ in items]).encode()
    files["imsmanifest.xml"] = _manifest(set_id, items).encode()
    return zipped(files)


def _identifier(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9_.-]", "_", f"Q{text}")


def _item(name: str, question: Question, part: Part) -> tuple[str, list[str]]:
    body, used = with_files(f"{question.statement}\n{part.question}", lambda file: f"files/{file}", question.files)
    solution, also = with_files(part.feedback, lambda file: f"files/{file}", question.files)
    asked = part.answers if part.is_numerical else ()
    declared = "".join(_declared(number, answer) for number, answer in enumerate(asked, 1)) or (
        '<responseDeclaration identifier="RESPONSE" cardinality="single" baseType="string"/>\n'
    )
    fields = "".join(_field(number, answer) for number, answer in enumerate(asked, 1)) or (
        '<extendedTextInteraction responseIdentifier="RESPONSE" expectedLines="15"/>\n'
    )
    points = part.points or max(1, len(asked))
    text = (
        f'{HEAD}<assessmentItem xmlns="{QTI}" identifier="{name}" title={quoteattr(question.heading(part))} '
        'adaptive="false" timeDependent="false">\n'
        f"{declared}"
        '<outcomeDeclaration identifier="SCORE" cardinality="single" baseType="float">'
        "<defaultValue><value>0</value></defaultValue></outcomeDeclaration>\n"
        f'<outcomeDeclaration identifier="MAXSCORE" cardinality="single" baseType="float">'
        f"<defaultValue><value>{points:g}</value></defaultValue></outcomeDeclaration>\n"
        '<outcomeDeclaration identifier="FEEDBACK" cardinality="single" baseType="identifier"/>\n'
        f"<itemBody>\n{body}\n{fields}</itemBody>\n"
        f"{_processing(asked, points)}"
        '<modalFeedback outcomeIdentifier="FEEDBACK" identifier="solution" showHide="show">\n'
        f"{solution}\n</modalFeedback>\n</assessmentItem>\n"
    )
    return _closed(text), [*dict.fromkeys([*used, *also])]


def _closed(html: str) -> str:
    return re.sub(r"(<img [^>]*[^/])>", r"\1/>", html)


def _declared(number: int, answer: Answer) -> str:
    return (
        f'<responseDeclaration identifier="RESPONSE{number}" cardinality="single" baseType="float">'
        f"<correctResponse><value>{answer.value:.12g}</value></correctResponse></responseDeclaration>\n"
    )


def _field(number: int, answer: Answer) -> str:
    field = f'<textEntryInteraction responseIdentifier="RESPONSE{number}" expectedLength="12"/>'
    return f"<p>{answer.named} = {field} {escape(answer.unit)}</p>\n"


def _processing(answers: Sequence[Answer], points: float) -> str:
    rules = "".join(
        "<responseCondition><responseIf>"
        f'<equal toleranceMode="absolute" tolerance="{answer.tolerance:.12g} {answer.tolerance:.12g}">'
        f'<variable identifier="RESPONSE{number}"/><correct identifier="RESPONSE{number}"/></equal>'
        '<setOutcomeValue identifier="SCORE"><sum><variable identifier="SCORE"/>'
        f'<baseValue baseType="float">{points / len(answers):.12g}</baseValue></sum></setOutcomeValue>'
        "</responseIf></responseCondition>\n"
        for number, answer in enumerate(answers, 1)
    )
    shown = (
        '<setOutcomeValue identifier="FEEDBACK"><baseValue baseType="identifier">solution</baseValue></setOutcomeValue>'
    )
    return f"<responseProcessing>\n{rules}{shown}\n</responseProcessing>\n"


def _test(set_id: str, title: str, items: Sequence[str]) -> str:
    listed = "".join(f'<assessmentItemRef identifier="{name}" href="{name}.xml"/>\n' for name in items)
    return (
        f'{HEAD}<assessmentTest xmlns="{QTI}" identifier="{_identifier(set_id)}" title={quoteattr(title)}>\n'
        '<testPart identifier="part" navigationMode="nonlinear" submissionMode="simultaneous">\n'
        f'<assessmentSection identifier="section" title={quoteattr(title)} visible="true">\n{listed}'
        "</assessmentSection>\n</testPart>\n</assessmentTest>\n"
    )


def _manifest(set_id: str, items: Sequence[tuple[str, Sequence[str]]]) -> str:
    resources = "".join(
        f'<resource identifier="{name}" type="imsqti_item_xmlv2p1" href="{name}.xml"><file href="{name}.xml"/>'
        + "".join(f"<file href={quoteattr(file)}/>" for file in files)
        + "</resource>\n"
        for name, files in items
    )
    needed = "".join(f'<dependency identifierref="{name}"/>' for name, _ in items)
    return (
        f'{HEAD}<manifest xmlns="{PACKAGE}" identifier="manifest-{_identifier(set_id)}">\n'
        "<metadata><schema>QTIv2.1 Package</schema><schemaversion>1.0.0</schemaversion></metadata>\n"
        f"<organizations/>\n<resources>\n{resources}"
        '<resource identifier="test" type="imsqti_test_xmlv2p1" href="test.xml"><file href="test.xml"/>'
        f"{needed}</resource>\n</resources>\n</manifest>\n"
    )
