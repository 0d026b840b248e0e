"""Remarks on claims of a document that cannot be compared, and its own letters beside each erratum."""

from __future__ import annotations

import pytest

from derive.course.reference.errata import Erratum
from derive.course.reference.quotes import Remark, unquotable
from derive.errors import Rejected
from tests.course.reference.stated import HEAD, Compared, one

NAMED = "- document: hw9.md\n"


def test_a_remark_quotes_what_is_printed_and_compares_nothing(compared: Compared) -> None:
    found = one(compared("part: 4, line: 110, remark: never given, quote: 'Find the magnitude of $\\tau$'"))
    assert (found.outcome, found.complaint) == ("remark", None)
    assert found.told().remark == Remark("4", 110, "Find the magnitude of $\\tau$", "never given")
    assert (found.facts()["line"], found.facts()["states"]) == (110, None)


def test_a_claim_that_is_right_by_luck_is_compared_and_remarked_on(compared: Compared) -> None:
    chain = r"answer: inertia_tensor_zz, line: 3, remark: by luck, latex: '\frac{5}{12} M a^2 = \frac{10}{24} M a^2'"
    found = compared(chain)
    assert [each.outcome for each in found] == ["agrees", "agrees"]
    remarks = [each.told().remark for each in found]
    assert remarks[0] is not None and remarks[0].quote == r"$\frac{5}{12} M a^2 = \frac{10}{24} M a^2$"
    assert remarks[1] is None, "it is told once"


def test_an_erratum_is_quoted_as_printed_with_its_line(compared: Compared) -> None:
    slip = r"line: 28, answer: inertia_tensor_zz, latex: '\frac{5}{13} M a^{2}'"
    found = one(compared(slip + r", erratum: {why: 13 for 12, right: '\frac{5}{12} M a^{2}'}"))
    assert found.erratum is not None
    assert (found.erratum.line, found.erratum.quote) == (28, r"$\frac{5}{13} M a^{2}$")
    assert found.erratum.instead == r"$\frac{5}{12} M a^{2}$"


def test_a_garbled_formula_is_an_erratum_that_is_only_quoted(compared: Compared) -> None:
    slip = r"line: 7, part: 2, quote: '$\int x x$', erratum: {why: no differential, right: '$\int x d x$'}"
    found = one(compared(slip))
    assert (found.outcome, found.grade, found.complaint) == ("erratum", None, None)
    erratum = found.told().erratum
    assert erratum is not None and found.told().remark is None
    assert (erratum.line, erratum.quote, erratum.instead) == (7, r"$\int x x$", r"$\int x d x$")
    assert Erratum.decoded(erratum.encoded()) == erratum


def test_where_the_document_is_named_errata_and_remarks_have_their_lines(compared: Compared) -> None:
    entry = "    - {remark: odd, quote: 'cube'}\n"
    with pytest.raises(Rejected) as refused:
        compared(whole=NAMED + HEAD + entry)
    assert refused.value.complaints[0].message == "errata and remarks need `line`: a line of `hw9.md`"
    found = one(compared(whole=NAMED + HEAD + entry.replace("remark", "line: 3, remark")))
    assert found.facts()["document"] == "hw9.md"


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("remark: odd", "a remark needs `quote`: what the document prints"),
        ("line: x, remark: odd, quote: cube", "`line` must be the number of a line, from 1 to 99999, but it is `x`"),
        (r"remark: odd, quote: '$\input{x}$'", r"`quote`: `\input` cannot be quoted"),
        (r"quote: x, erratum: {why: bad, right: '$\input{x}$'}", r"`right`: `\input` cannot be quoted"),
        ("quote: x, erratum: {why: bad, right: [1, 2, 3]}", "`right`: it is not text"),
        ("states: M*a**2", "an entry needs `answer`: the key of the step that has this value"),
        ("answer: kinetic_energy", "an entry needs `states` or `latex`: the value"),
    ],
)
def test_what_a_remark_lacks_is_told(entry: str, message: str, compared: Compared) -> None:
    with pytest.raises(Rejected) as refused:
        compared(entry)
    assert refused.value.complaints[0].message.startswith(message)


def test_what_cannot_be_quoted_says_why() -> None:
    assert unquotable("a plain $x^2$") is None
    assert unquotable("$x") == "a formula of the quotation has no end: one `$` is missing"
