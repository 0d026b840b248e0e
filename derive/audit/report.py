"""The verdicts of an audit as text, as JSON and as a web page."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any

from derive.audit.auditing import Audit
from derive.audit.claims import Claim, Outcome, Verdict
from derive.audit.expected import Compared, Status
from derive.audit.knowledge import ASSUMED
from derive.errors import Complaint, Place

WORDS = {
    Outcome.HOLDS: "hold",
    Outcome.APPROXIMATES: "are approximations",
    Outcome.DEFINES: "define something or state a law",
    Outcome.DIFFERS: "differ",
    Outcome.UNDECIDED: "are undecided",
    Outcome.UNREADABLE: "are not read",
}
LONGEST = 200


def exit_code(audit: Audit) -> int:
    """Return 1 if a row differs, otherwise 0."""
    return int(any(_verdict(claim).outcome is Outcome.DIFFERS for claim in audit.claims))


def summary(audit: Audit) -> dict[str, int]:
    counted = Counter(_verdict(claim).outcome for claim in audit.claims)
    return {str(outcome): counted[outcome] for outcome in Outcome}


def as_text(audit: Audit, every: bool) -> str:
    """Return the rows that differ or have a suggestion, each with its place, and a summary, which also lists the rows
    that are not read. With `every`, return all rows and the summary."""
    shown = [_told(audit, claim, every) for claim in audit.claims if every or _is_noteworthy(_verdict(claim))]
    counted = summary(audit)
    parts = [f"{counted[str(outcome)]} {words}" for outcome, words in WORDS.items() if counted[str(outcome)]]
    total = f"{audit.document.source.path}: {len(audit.claims)} claims: {', '.join(parts)}"
    more = [*_not_read(audit, every), *_unconfirmed(audit), *_of_answers(audit, every)]
    return "\n\n".join([*shown, "\n".join([total, *more])])


def _not_read(audit: Audit, every: bool) -> Iterator[str]:
    verdicts = ((claim.row.line, _verdict(claim)) for claim in audit.claims)
    unread = {line: verdict.because for line, verdict in verdicts if verdict.outcome is Outcome.UNREADABLE}
    if not every:
        yield from (f"  line {line} is not read: {because}" for line, because in unread.items())


def _lines_of(claims: Iterable[Claim]) -> list[int]:
    return list(dict.fromkeys(claim.row.line for claim in claims))


def _unconfirmed(audit: Audit) -> Iterator[str]:
    if lines := _lines_of(audit.unconfirmed):
        yield f"  no other row confirms what is stated in line{'s' * (len(lines) > 1)} {', '.join(map(str, lines))}"


def _of_answers(audit: Audit, every: bool) -> Iterator[str]:
    problems: dict[str, list[Compared]] = {}
    for each in audit.compared:
        problems.setdefault(each.expected.problem, []).append(each)
    for problem, answers in problems.items():
        counted = Counter(each.status for each in answers)
        parts = [f"{counted[status]} {status}" for status in Status if counted[status]]
        yield f"{problem}: {len(answers)} answers: {', '.join(parts)}"
        for each in answers:
            if every or each.status is not Status.FOUND:
                where = f" in line {audit.claims[each.claim].row.line}" if each.claim is not None else ""
                yield f"  {each.status}{where}: {each.expected.key}: {each.expected.latex}"


def _is_noteworthy(verdict: Verdict) -> bool:
    return verdict.outcome is Outcome.DIFFERS or bool(verdict.suggestion)


def _told(audit: Audit, claim: Claim, every: bool) -> str:
    verdict = _verdict(claim)
    notes = [f"read as: {reading}" for reading in [_reading(claim)] if reading]
    if every:
        text = audit.document.source.text
        notes += [f"`{text[each.span.start : each.span.end].strip()}`: {each.rule}" for each in verdict.choices]
    if verdict.counterexample:
        notes.append(f"for example {verdict.counterexample}")
    if lines := _lines(audit, verdict):
        notes.append(f"uses line{'s' * (len(lines) > 1)} {', '.join(map(str, lines))}")
    if verdict.inherits is not None:
        notes.append(f"repeats the slip of line {audit.claims[verdict.inherits].row.line}")
    if carrying := [each.row.line for each in audit.claims if _verdict(each).inherits == claim.number]:
        notes.append(f"repeated in line {', '.join(map(str, dict.fromkeys(carrying)))}")
    if ASSUMED in verdict.given:
        notes.append("uses an assumption from the command line")
    suggestion = f"probably {verdict.suggestion}: {verdict.why_plausible}" if verdict.suggestion else None
    if verdict.why_plausible and not suggestion:
        notes.append(verdict.why_plausible)
    code = str(verdict.outcome)
    return Complaint(code, verdict.because, _place(audit, claim), tuple(notes), suggestion, "row").shown()


def _place(audit: Audit, claim: Claim) -> Place:
    return audit.document.source.place(_verdict(claim).span or claim.right_span)


def _verdict(claim: Claim) -> Verdict:
    return claim.verdict or Verdict(Outcome.UNDECIDED, "not examined")


def _reading(claim: Claim) -> str:
    if claim.values is None:
        return ""
    left, right = (str(each) for each in claim.values)
    return f"{_cut(left)} {claim.relation} {_cut(right)}"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."


def _lines(audit: Audit, verdict: Verdict) -> list[int]:
    return list(dict.fromkeys(audit.claims[number].row.line for number in verdict.given if number != ASSUMED))


def as_data(audit: Audit) -> dict[str, Any]:
    """Return the audit as data: the file, its rows with their verdicts, and how often each verdict occurs. After a
    comparison with a derivation, the data also have the answers."""
    answers = [
        {
            "problem": each.expected.problem,
            "answer": each.expected.key,
            "latex": each.expected.latex,
            "status": str(each.status),
            "line": audit.claims[each.claim].row.line if each.claim is not None else None,
        }
        for each in audit.compared
    ]
    found = {"file": audit.document.source.path, "rows": list(_rows(audit)), "summary": summary(audit)}
    return {**found, "answers": answers} if answers else found


def as_json(audit: Audit) -> str:
    return json.dumps(as_data(audit), indent=2, ensure_ascii=False)


def _rows(audit: Audit) -> Iterator[dict[str, Any]]:
    unconfirmed = {claim.number for claim in audit.unconfirmed}
    for claim in audit.claims:
        verdict = _verdict(claim)
        inherits = audit.claims[verdict.inherits].row.line if verdict.inherits is not None else None
        yield {
            "line": _place(audit, claim).line,
            "latex": audit.document.source.text[claim.left_span.start : claim.right_span.end].strip()
            if claim.left_span.start <= claim.right_span.start
            else claim.row.latex,
            "reading": _reading(claim),
            "verdict": str(verdict.outcome),
            "because": verdict.because,
            "given": _lines(audit, verdict),
            "counterexample": verdict.counterexample,
            "suggestion": verdict.suggestion,
            "inherits": inherits,
            "confirmed": claim.number not in unconfirmed,
        }


_STYLE = """
body { font: 16px/1.5 Georgia, serif; max-width: 84rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
.line { display: grid; grid-template-columns: 3rem minmax(0, 3fr) minmax(0, 2fr); column-gap: 1rem; }
.line > span { color: #999; text-align: right; font-size: .8rem; }
code { font-size: .85rem; white-space: pre-wrap; overflow-wrap: anywhere; }
aside { font-size: .9rem; line-height: 1.35; }
aside p { margin: .1rem 0; padding-left: .6rem; border-left: 3px solid transparent; }
.differs { border-color: #c0392b; background: #fbe9e6; } .noted { border-color: #d19a00; background: #fdf6e0; }
.undecided, .unreadable { color: #777; } .holds, .defines, .approximates { color: #3b7a3b; }
.marked > code { background: #fbe9e6; } small { color: #777; }
"""
_MARKS = {Outcome.HOLDS: "\u2713", Outcome.APPROXIMATES: "\u2248", Outcome.DEFINES: "\u2254"}


def as_html(audit: Audit) -> str:
    """Return the document as HTML, with notes in its margin."""
    notes: dict[int, list[str]] = {}
    marked: set[int] = set()
    for claim in audit.claims:
        line = _place(audit, claim).line
        notes.setdefault(line, []).append(_note(audit, claim))
        if _is_noteworthy(_verdict(claim)):
            marked.add(line)
    for row, fault in audit.unread:
        if row.line not in notes:
            notes[row.line] = [f'<p class="unreadable">I cannot read this: {escape(fault)}.</p>']
    lines = [
        f'<div class="line{" marked" if number in marked else ""}" id="L{number}"><span>{number}</span>'
        f"<code>{escape(text) or '&nbsp;'}</code><aside>{''.join(notes.get(number, ()))}</aside></div>"
        for number, text in enumerate(audit.document.source.written.split("\n"), 1)
    ]
    title = escape(audit.document.source.path)
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f"<style>{_STYLE}</style></head><body><h1>{title}</h1>{_summary_as_html(audit, sorted(marked))}"
        f"{''.join(lines)}</body></html>\n"
    )


def _summary_as_html(audit: Audit, marked: list[int]) -> str:
    counted = summary(audit)
    parts = [f"{counted[str(outcome)]} {words}" for outcome, words in WORDS.items() if counted[str(outcome)]]
    look = ", ".join(f'<a href="#L{number}">{number}</a>' for number in marked)
    told = f"<p>{len(audit.claims)} claims: {', '.join(parts)}.</p>"
    told += f"<p>Please look at line {look}.</p>" if marked else "<p>I found nothing to correct.</p>"
    alone = ", ".join(f'<a href="#L{number}">{number}</a>' for number in _lines_of(audit.unconfirmed))
    told += f"<p>No other row confirms what is stated in line {alone}.</p>" if alone else ""
    answers = "<br>".join(f"<code>{escape(line)}</code>" for line in _of_answers(audit, every=True))
    return told + (f"<details><summary>Answers of the derivation</summary>{answers}</details>" if answers else "")


def _note(audit: Audit, claim: Claim) -> str:
    verdict = _verdict(claim)
    noteworthy = _is_noteworthy(verdict)
    kind = "noted" if noteworthy and verdict.outcome is not Outcome.DIFFERS else str(verdict.outcome)
    reading = escape(_reading(claim))
    if verdict.outcome in _MARKS and not noteworthy:
        given = "".join(f", line {number}" for number in _lines(audit, verdict))
        because = escape(verdict.because)
        return f'<p class="{kind}" title="{reading}">{_MARKS[verdict.outcome]} <small>{because}{given}</small></p>'
    told = [f"<small>Read as {reading}.</small>"] if reading else []
    told += [escape(each) for each in sentences(audit, verdict)]
    return f'<p class="{kind}">{" ".join(told)}</p>'


def sentences(audit: Audit, verdict: Verdict) -> list[str]:
    found = [_sentence(verdict.because)]
    if verdict.counterexample:
        found.append(_sentence(f"for example {verdict.counterexample}"))
    if verdict.suggestion:
        found.append(_sentence(f"probably {verdict.suggestion}: {verdict.why_plausible}"))
    elif verdict.why_plausible:
        found.append(_sentence(verdict.why_plausible))
    if verdict.inherits is not None:
        found.append(f"The slip is in line {audit.claims[verdict.inherits].row.line}; this row only repeats it.")
    return found


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:].rstrip(".") + "."
