"""A quiz of Canvas: a package of QTI 1.2 with the fields that Canvas reads.

A numerical question of Canvas has one field. So if all answers of a part are numbers, each number becomes a separate
question. All other parts become essay questions. A number that a student types is right if it differs from the result
by at most half a unit of the last printed digit. The worked solution is the general feedback of the question.

Sources: IMS Global, *Question and Test Interoperability: ASI XML Binding Specification*, version 1.2; for the fields of
Canvas, files that Canvas exported.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from xml.sax.saxutils import escape as escape_xml
from xml.sax.saxutils import quoteattr

from derive.exporting.packages import zipped
from derive.exporting.questions import Answer, Part, Question, with_files

QTI = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
CANVAS = "http://canvas.instructure.com/xsd/cccv1p0"
PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
FILES = "%24IMS-CC-FILEBASE%24"  # Canvas replaces this by the address of the imported files
FOLDER = "drawings"
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'


def canvas_package(set_id: str, title: str, questions: Sequence[Question]) -> bytes:
    """Return the questions of a set as a ZIP file; equal input gives equal bytes."""
    quiz, files = _ident(set_id), dict[str, bytes]()
    items, total = list[str](), 0.0
    for question in questions:
        for part in question.parts:
            for item, points, used in _items(question, part):
                items.append(item)
                total += points
                files |= {f"{FOLDER}/{name}": question.files[name] for name in used}
    assessment = (
        f'{HEAD}<questestinterop xmlns="{QTI}">\n<assessment ident="{quiz}" title={quoteattr(title)}>\n'
        f"<qtimetadata>{_field('cc_maxattempts', '1')}</qtimetadata>\n"
        f'<section ident="root_section">\n{"".join(items)}</section>\n</assessment>\n</questestinterop>\n'
    )
    meta = (
        f'{HEAD}<quiz identifier="{quiz}" xmlns="{CANVAS}">\n<title>{escape_xml(title)}</title>\n'
        f"<quiz_type>assignment</quiz_type>\n<points_possible>{total:g}</points_possible>\n</quiz>\n"
    )
    drawings = sorted(files)
    files |= {f"{quiz}/{quiz}.xml": assessment.encode(), f"{quiz}/assessment_meta.xml": meta.encode()}
    files["imsmanifest.xml"] = _manifest(quiz, drawings).encode()
    return zipped(files)


def _ident(*names: str) -> str:
    return "g" + hashlib.sha256("/".join(names).encode()).hexdigest()[:32]


def _items(question: Question, part: Part) -> list[tuple[str, float, list[str]]]:
    body, used = with_files(f"{question.statement}\n{part.question}", _address, question.files)
    solution, also = with_files(part.feedback, _address, question.files)
    files = [*dict.fromkeys([*used, *also])]
    answers: Sequence[Answer | None] = part.answers if part.is_numerical else [None]
    points = (part.points or len(answers)) / len(answers)
    found = []
    for number, answer in enumerate(answers, 1):
        ident = _ident(question.id, part.label, answer.key if answer else "")
        title = question.heading(part) + (f", {number} of {len(answers)}" if len(answers) > 1 else "")
        asked = f"{body}\n{answer.sought}" if answer else body
        found.append((_item(ident, title, points, asked, solution, answer), points, files))
    return found


def _address(file: str) -> str:
    return f"{FILES}/{FOLDER}/{file}"


def _item(ident: str, title: str, points: float, body: str, solution: str, answer: Answer | None) -> str:
    sort = "numerical_question" if answer else "essay_question"
    fields = f"{_field('question_type', sort)}{_field('points_possible', f'{points:g}')}"
    blank = (
        '<render_fib fibtype="Decimal"><response_label ident="answer1"/></render_fib>'
        if answer
        else '<render_fib><response_label ident="answer1" rshuffle="No"/></render_fib>'
    )
    return (
        f'<item ident="{ident}" title={quoteattr(title)}>\n'
        f"<itemmetadata><qtimetadata>{fields}</qtimetadata></itemmetadata>\n"
        f'<presentation>{_material(body)}<response_str ident="response1" rcardinality="Single">{blank}</response_str>'
        "</presentation>\n"
        '<resprocessing><outcomes><decvar maxvalue="100" minvalue="0" varname="SCORE" vartype="Decimal"/></outcomes>\n'
        '<respcondition continue="Yes"><conditionvar><other/></conditionvar>'
        '<displayfeedback feedbacktype="Response" linkrefid="general_fb"/></respcondition>\n'
        f"{_graded(answer) if answer else ''}</resprocessing>\n"
        f'<itemfeedback ident="general_fb"><flow_mat>{_material(solution)}</flow_mat></itemfeedback>\n</item>\n'
    )


def _graded(answer: Answer) -> str:
    assert answer.value is not None
    low, high = (f"{answer.value + side * answer.tolerance:.12g}" for side in (-1, 1))
    return (
        '<respcondition continue="No"><conditionvar><or>'
        f'<varequal respident="response1">{answer.value:.12g}</varequal>'
        f'<and><vargte respident="response1">{low}</vargte><varlte respident="response1">{high}</varlte></and>'
        '</or></conditionvar><setvar action="Set" varname="SCORE">100</setvar></respcondition>\n'
    )


def _field(label: str, entry: str) -> str:
    return f"<qtimetadatafield><fieldlabel>{label}</fieldlabel><fieldentry>{entry}</fieldentry></qtimetadatafield>"


def _material(html: str) -> str:
    return f'<material><mattext texttype="text/html">{escape_xml(html)}</mattext></material>'


def _manifest(quiz: str, drawings: Sequence[str]) -> str:
    pictures = "".join(
        f'<resource identifier="{_ident(name)}" type="webcontent" href={quoteattr(name)}>'
        f"<file href={quoteattr(name)}/></resource>\n"
        for name in drawings
    )
    return (
        f'{HEAD}<manifest identifier="manifest-{quiz}" xmlns="{PACKAGE}">\n'
        "<metadata><schema>IMS Content</schema><schemaversion>1.1.3</schemaversion></metadata>\n"
        "<organizations/>\n<resources>\n"
        f'<resource identifier="{quiz}" type="imsqti_xmlv1p2"><file href="{quiz}/{quiz}.xml"/>'
        f'<dependency identifierref="{quiz}-meta"/></resource>\n'
        f'<resource identifier="{quiz}-meta" href="{quiz}/assessment_meta.xml" '
        'type="associatedcontent/imscc_xmlv1p1/learning-application-resource">'
        f'<file href="{quiz}/assessment_meta.xml"/></resource>\n'
        f"{pictures}</resources>\n</manifest>\n"
    )
