"""Moodle XML: a category with one question for each part of each problem.

With `stack`, a part whose answers are all formulas that can be compared becomes a question of the plugin STACK, which
compares formulas with Maxima. A part whose answers are numbers becomes a numerical question or, with several answers, a
cloze question. Other parts become essay questions. The worked solution is the general feedback of the question.

Source of the formats: Moodle documentation, "Moodle XML format"; STACK documentation, "Authoring".
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

from derive.exporting.questions import Answer, Part, Question, with_files


def moodle_xml(course: str, title: str, questions: Sequence[Question], stack: bool = False) -> str:
    category = _element("category", _text(f"$course$/top/{_path(course)}/{_path(title)}"))
    made = [f'<question type="category">{category}</question>']
    for question in questions:
        made += [_question(question, part, stack) for part in question.parts]
    return '<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n' + "\n".join(made) + "\n</quiz>\n"


def _path(name: str) -> str:
    return name.replace("/", "//")  # in Moodle, a single slash separates a category from its subcategory


def is_for_stack(part: Part) -> bool:
    return bool(part.answers) and all(answer.letters and answer.value is None for answer in part.answers)


def _question(question: Question, part: Part, stack: bool) -> str:
    if stack and is_for_stack(part):
        return _typed("stack", question, part, _stack(question, part.answers), _inputs(question, part.answers))
    if not part.is_numerical:
        return _typed("essay", question, part, _ESSAY)
    if len(part.answers) == 1:
        (answer,) = part.answers
        return _typed("numerical", question, part, _numerical(answer), answer.sought)
    return _typed("cloze", question, part, "", _gaps(part))


_ESSAY = (
    "<responseformat>editor</responseformat><responserequired>1</responserequired>"
    "<responsefieldlines>15</responsefieldlines><attachments>3</attachments>"
    "<attachmentsrequired>0</attachmentsrequired>"
    '<graderinfo format="html"><text></text></graderinfo>'
    '<responsetemplate format="html"><text></text></responsetemplate>'
)


def _typed(sort: str, question: Question, part: Part, more: str, gaps: str = "") -> str:
    feedback = part.feedback if part is not question.parts[-1] else f"{part.feedback}\n{question.remarks}"
    pieces = [
        _element("name", _text(question.heading(part))),
        _html("questiontext", "\n".join(filter(None, [question.statement, part.question, gaps])), question),
        _html("generalfeedback", feedback, question),
        "" if sort == "cloze" else f"<defaultgrade>{part.points or 1:g}</defaultgrade>",
        "<penalty>0</penalty><hidden>0</hidden>",
        more,
    ]
    return f'<question type="{sort}">\n' + "\n".join(filter(None, pieces)) + "\n</question>"


def _numerical(answer: Answer) -> str:
    """Return the number without its unit, which the question states: Moodle does not recognize a typed unit that
    contains a space or begins with a digit."""
    return (
        '<answer fraction="100" format="moodle_auto_format">'
        f"<text>{answer.value:.12g}</text><tolerance>{answer.tolerance:.12g}</tolerance>"
        '<feedback format="html"><text></text></feedback></answer>'
        "<unitgradingtype>0</unitgradingtype><unitpenalty>0</unitpenalty>"
        "<showunits>3</showunits><unitsleft>0</unitsleft>"
    )


def _marks(part: Part) -> list[int]:
    """Return the mark of each field of a cloze question; the marks are whole numbers."""
    count, points = len(part.answers), part.points or 0
    whole = int(points) if points >= count and points == int(points) else count
    return [whole // count + (number < whole % count) for number in range(count)]


def _gaps(part: Part) -> str:
    return "\n".join(
        f"<p>{answer.named} = "
        f"{{{marks}:NUMERICAL:={answer.value:.12g}:{answer.tolerance:.12g}}} {escape(answer.unit)}</p>"
        for answer, marks in zip(part.answers, _marks(part), strict=True)
    )


def _inputs(question: Question, answers: Sequence[Answer]) -> str:
    fields = (
        f"<p>{answer.named} = [[input:ans{number}]] [[validation:ans{number}]]</p>"
        for number, answer in enumerate(answers, 1)
    )
    return "\n".join([question.typing, *fields])


def _stack(question: Question, answers: Sequence[Answer]) -> str:
    numbered = list(enumerate(answers, 1))
    positive = sorted(frozenset[str]().union(*(answer.positive for answer in answers)))
    # With a positive letter x, STACK simplifies sqrt(x^2) to x. This would be wrong for a negative letter.
    assumed = [f"assume({', '.join(f'{letter}>0' for letter in positive)});"] if positive else []
    variables = "\n".join([*assumed, *(f"ta{number}: {maxima(answer.sympy)};" for number, answer in numbered)])
    feedback = " ".join(f"[[feedback:prt{number}]]" for number, _ in numbered)
    return "\n".join(
        [
            "<stackversion><text></text></stackversion>",
            _element("questionvariables", _text(variables)),
            f'<specificfeedback format="html">{_text(feedback)}</specificfeedback>',
            "<questionnote><text></text></questionnote>",
            "<questionsimplify>1</questionsimplify><assumepositive>0</assumepositive><assumereal>1</assumereal>",
            *(_input(number, answer, question.letters) for number, answer in numbered),
            *(_comparison(number, len(numbered), answer) for number, answer in numbered),
        ]
    )


def maxima(sympy: str) -> str:
    """Return a formula of letters and common functions in the syntax of Maxima."""
    return re.sub(r"\bpi\b", "%pi", sympy.replace("**", "^"))


def _input(number: int, answer: Answer, letters: Sequence[str]) -> str:
    # STACK accepts only those names of more than two characters that are listed here.
    names = ", ".join(dict.fromkeys([*(letter for letter in letters if len(letter) > 1), *dict(answer.names)]))
    return (
        f"<input><name>ans{number}</name><type>algebraic</type><tans>ta{number}</tans><boxsize>30</boxsize>"
        "<strictsyntax>0</strictsyntax><insertstars>1</insertstars><syntaxhint></syntaxhint>"
        "<syntaxattribute>0</syntaxattribute><forbidwords></forbidwords>"
        f"<allowwords>{names}</allowwords>"
        "<forbidfloat>0</forbidfloat><requirelowestterms>0</requirelowestterms><checkanswertype>0</checkanswertype>"
        "<mustverify>1</mustverify><showvalidation>1</showvalidation><options></options></input>"
    )


def _comparison(number: int, count: int, answer: Answer) -> str:
    names = ", ".join(f"{name}={maxima(of)}" for name, of in answer.names)
    given = f"sa{number}: subst([{names}], ans{number});" if names else ""
    compared = f"sa{number}" if names else f"ans{number}"
    results = "".join(
        f"<{sort}scoremode>=</{sort}scoremode><{sort}score>{score}</{sort}score><{sort}penalty></{sort}penalty>"
        f"<{sort}nextnode>-1</{sort}nextnode><{sort}answernote>prt{number}-1-{sort[0].upper()}</{sort}answernote>"
        f'<{sort}feedback format="html"><text></text></{sort}feedback>'
        for sort, score in (("true", 1), ("false", 0))
    )
    return (
        f"<prt><name>prt{number}</name><value>{1 / count:.7f}</value><autosimplify>1</autosimplify>"
        f"<feedbackstyle>1</feedbackstyle><feedbackvariables>{_text(given)}</feedbackvariables>"
        f"<node><name>0</name><answertest>AlgEquiv</answertest><sans>{compared}</sans><tans>ta{number}</tans>"
        f"<testoptions></testoptions><quiet>0</quiet>{results}</node></prt>"
    )


def _html(tag: str, html: str, question: Question) -> str:
    shown, used = with_files(html, lambda name: f"@@PLUGINFILE@@/{name}", question.files)
    files = "".join(
        f'<file name={quoteattr(name)} path="/" encoding="base64">{b64encode(question.files[name]).decode()}</file>'
        for name in used
    )
    return f'<{tag} format="html">{_text(shown)}{files}</{tag}>'


def _text(text: str) -> str:
    return f"<text>{escape(text)}</text>"


def _element(tag: str, inside: str) -> str:
    return f"<{tag}>{inside}</{tag}>"
