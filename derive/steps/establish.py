"""The one function that makes steps.

A `Step` is data: keys and expressions, no sentence and no TeX. Only `establish()` makes a step, after three checks:

    (a) Each line of the chain follows from the line before it; a limit, a series or a rounded number equals an earlier
        line only approximately. The left side equals the first line. The returned value equals the last exact line.
    (b) Every second route to the result, and every check of the result, agrees with the result.
    (c) The subjects of the inputs fit together, and the word that chooses the sentence is true of the result.

A verb states its law once, as a function. `establish` calls the law with the *names* of its inputs, which gives the
formula, and with their *values*, which gives the substitution. The simplified substitution is the result.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import FrameType
from typing import Any

from sympy import Expr, MatrixBase, Symbol

from derive.algebra.equality import Compared, Evidence, Grade, equal
from derive.algebra.expressions import Relation, bound, explicit
from derive.algebra.singular import has_no_value
from derive.algebra.tidy import tidied
from derive.errors import Complaint, Rejected, Spelled, Unverified
from derive.steps import record
from derive.steps.chain import (
    approximation_evidence,
    bindings_of,
    check_last_line,
    evidence_of_routes,
    left_side_evidence,
    line_evidence,
    names_in,
    refused,
    short,
    without_repeats,
)
from derive.steps.natural import NamesValue, NaturalQuantities, Proposal
from derive.steps.record import coordinates_in
from derive.steps.rule import GENERIC, TRIALS, ZERO, Doubt, Judged, Rule, wrongly_handed_on
from derive.steps.signs import undecided
from derive.steps.step import (
    Fact,
    Form,
    Law,
    Level,
    Quantity,
    Route,
    Step,
    Witness,
    is_zero,
    name_or_key,
    same_value,
    value_behind,
)
from derive.steps.subject import NOTHING, Subject, united, with_name
from derive.steps.symbols import check_symbol


@dataclass(frozen=True)
class Lines:
    """How the law becomes the lines of a chain, and how the result is written.

    before    lines of the chain before the law
    between   forms between the substituted law and the result
    after     lines of the chain after the result
    law       the level from which the law is shown
    put_in    the level from which the law with substituted values is shown; None omits this line
    result    whether the result has a separate line
    arranged  a function that rewrites the result without changing its value
    motion    rate -> its value by the equations of motion; these values are substituted in the line of the result
    means     name -> its value, for names in the left side that are not in the law
    """

    before: Sequence[Form] = ()
    between: Sequence[Form] = ()
    after: Sequence[Form] = ()
    law: Level = Level.BRIEF
    put_in: Level | None = Level.STANDARD
    result: bool = True
    arranged: Callable[[Any], Any] = tidied
    motion: Mapping[Symbol, Expr] = field(default_factory=dict)
    means: Mapping[Any, Any] = field(default_factory=dict)

    def chain(self, symbol: Any, formula: Any, substituted: Any, result: Any) -> list[Form]:
        """Return the lines in their order, without repeats."""
        forms = [*self.before, Form(formula, "law", self.law)]
        forms += [Form(substituted, "put_in", self.put_in)] if self.put_in else []
        forms += [*self.between]
        forms += [Form(result, "motion" if self.motion else "result")] if self.result else []
        return without_repeats([*forms, *self.after], symbol)


@dataclass(frozen=True)
class PhraseData:
    """Data for the sentence of a step, in addition to the chain, and data for judging the outcome.

    words         term of the phrase -> key of its word, such as "about" -> "corner"
    formulas      role -> a formula that only the sentence contains, and the same formula by a different route
    named         role -> a symbol or a place that only the sentence contains, judged by a predicate
    points_to     role -> a quantity that the sentence mentions by its symbol or its number
    outcome_data  further data for judging the outcome
    stands_for    keys of other steps; an answer that asks for one of them gets this step
    """

    words: Mapping[str, str] = field(default_factory=dict)
    formulas: Mapping[str, tuple[Any, Any]] = field(default_factory=dict)
    named: Mapping[str, Any] = field(default_factory=dict)
    points_to: Mapping[str, Quantity] = field(default_factory=dict)
    outcome_data: Mapping[str, Any] = field(default_factory=dict)
    stands_for: Sequence[str] = ()

    @property
    def told(self) -> dict[str, Any]:
        """Return, by role, the formulas, symbols and places that occur only in the sentence."""
        return {**{role: formula for role, (formula, _) in self.formulas.items()}, **self.named}


@dataclass(frozen=True)
class Scope:
    """The subject of a result, its new coordinates, and its relation to a general or exact quantity.

    about         further properties of the subject, or a function of the result that returns them
    differ        the properties in which the subjects of the inputs may differ
    coordinates   coordinates that the step introduces, with their kinds
    case_of       the general quantity with the same symbol, if the result is a particular case of it
    approximates  for a limit or a series: the symbol of the exact result, or the key of the exact equation
    """

    about: Subject | Callable[[Any], Subject] = NOTHING
    differ: Collection[str] = ()
    coordinates: Mapping[Symbol, str] = field(default_factory=dict)
    case_of: Quantity | None = None
    approximates: Any = None

    def around(self, together: Subject, result: Any) -> Subject:
        """Return the common subject of the inputs, with the properties in `about` added."""
        return together.with_more(self.about(result) if callable(self.about) else self.about)


def establish(
    rule: Rule,
    symbol: Any,
    law: Law,
    inputs: Mapping[str, Any],
    *,
    key: str | None = None,
    kind: str | None = None,
    routes: Mapping[str, Route] | None = None,
    outcome: Callable[[Any], str] | str = GENERIC,
    lines: Lines = Lines(),
    phrase_data: PhraseData = PhraseData(),
    scope: Scope = Scope(),
    parents: Sequence[Quantity] = (),
    facts: Sequence[Fact] = (),
    proposals: Sequence[Proposal] = (),
) -> Quantity:
    """Make a step, or raise an error.

    rule        the law, its source, its outcomes and its evidence; a rule without evidence is a definition
    symbol      the symbol of the result on the page
    law         a function of the inputs, in their order; it is called with names and with values
    inputs      role -> quantity, or plain SymPy value
    routes      claim of the rule -> a function of the result; it returns two values that must be equal, or a verdict
    outcome     a word that selects the phrase, or a function of the result that returns such a word
    parents     quantities on which the result depends, in addition to its inputs
    facts       facts that the quantity carries in addition to its value
    proposals   quantities that are usual in the field; the result may be written in their symbols

    Raises `Unverified` if a line differs from the line before it, or if a route or a check gives a different result.
    `Unverified` is also raised if a statement in the sentence of the step is not confirmed.
    """
    key = key or rule.key
    quantities = {role: q for role, q in inputs.items() if isinstance(q, Quantity)}
    _check_names(key, list(quantities.values()))
    together = united(key, [(q.key, q.subject) for q in quantities.values()], scope.differ, same_value)
    body = (scope.about.body if isinstance(scope.about, Subject) else None) or together.body
    plain_symbol, words, called = symbol, _told_centre(phrase_data.words, body), str(getattr(body, "called", ""))
    if called:
        key, symbol = with_name(called, key, symbol)
        words = {"part": called, **words}
    given = [value_behind(q) for q in inputs.values()]
    names = [q.symbol if isinstance(q, Quantity) else q for q in inputs.values()]

    formula, substituted = law(*names), law(*given)
    bindings = bindings_of([*quantities.values(), *parents])
    result = lines.arranged(bound(explicit(bound(substituted, bindings)), {**bindings, **lines.motion}))
    record.check_not_defined(key, symbol, result)
    _check_letter(key, symbol, result, lines.means)
    check_symbol(key, symbol, result)
    check_can_hold(key, result)
    _check_has_value(key, result)
    chain = lines.chain(symbol, formula, substituted, result)
    natural = NaturalQuantities(symbol, result, [*quantities.values(), *parents], proposals)
    chain = natural.chain(chain, result)
    _check_told(key, phrase_data.formulas)
    written = natural.formulas(phrase_data.formulas)
    parents = list(dict.fromkeys([*parents, *natural.used]))
    bindings = {**bindings_of(natural.used), **bindings}
    # `means` has precedence for names in the left side, such as x_dot in x_dot^2.
    told = lines.means.keys() & getattr(symbol, "free_symbols", set())
    others = {name: value for name, value in bindings.items() if name != symbol or not told}
    evidence = left_side_evidence(key, symbol, chain[0], {**others, **lines.means})
    evidence += [line_evidence(key, chain, i, bindings, lines.motion) for i in range(1, len(chain))]
    check_last_line(key, chain, result, bindings, lines.motion)
    approximates, about, rests = approximation_evidence(
        key, symbol, chain, scope.approximates, [*quantities.values(), *parents]
    )
    evidence += rests
    evidence += evidence_of_routes(key, rule, result, routes or {})
    _check_words(key, words)
    if TRIALS in rule.evidence:
        evidence.append(Evidence(TRIALS, rule.evidence[TRIALS], Grade.SAMPLED, "the outcome at trial numbers"))
    elif not routes:
        evidence.append(_unsupported(key, rule))
    subject = scope.around(together, result)
    chosen = outcome(result) if callable(outcome) else outcome
    values = {**dict(zip(inputs, given, strict=True)), **phrase_data.told, **phrase_data.outcome_data}
    _check_pointed(key, phrase_data.points_to)
    judged = Judged(result, values, {**quantities, **phrase_data.points_to}, plain_symbol, subject, words)
    _check_outcome(key, rule, chosen, judged, may_be_zero=callable(outcome))
    _check_named(key, rule, judged, phrase_data.named)
    _check_handed_on(key, judged, facts)
    roles = {**inputs, **phrase_data.told, **written, **phrase_data.points_to}
    step = Step(
        key=key,
        rule=rule.name,
        symbol=symbol,
        chain=tuple(chain),
        inputs=tuple(dict.fromkeys(q.key for q in [*quantities.values(), *parents])),
        roles=tuple((role, name_or_key(q) if isinstance(q, Quantity) else q) for role, q in roles.items()),
        outcome=chosen,
        evidence=tuple(evidence),
        kind=kind,
        words=tuple(words.items()),
        coordinates=tuple({**coordinates_in(result), **scope.coordinates}.items()),
        stands_for=tuple(phrase_data.stands_for),
        names=names_in([symbol, *(form.expr for form in chain)], bindings),
        motion=tuple(lines.motion.items()),
        law_at=_place_of_verb(sys._getframe(1)),
        approximates=approximates,
        about=about,
        **rule.theorems(chosen, words),
    )
    step = replace(step, display=rule.shown.of(step))
    facts = [*facts, NamesValue()] if rule.names_value else facts
    quantity = Quantity(result, step, tuple(dict.fromkeys([*parents, *quantities.values()])), tuple(facts), subject)
    quantity = _witnessed(quantity, judged)
    record.add(quantity, scope.case_of)
    return quantity


def _witnessed(quantity: Quantity, judged: Judged) -> Quantity:
    """Add evidence from the motion of the described system, if the step can be tested on it; reject a result that
    contradicts this motion."""
    found = {fact for each in quantity.ancestors() for fact in each.facts if isinstance(fact, Witness)}
    by_kind = {kind: [fact for fact in found if type(fact) is kind] for kind in {type(fact) for fact in found}}
    if any(len(facts) > 1 for facts in by_kind.values()):
        return quantity  # the quantity depends on several systems
    said = [facts[0].testimony(quantity, judged, quantity.step.outcome) for facts in by_kind.values()]
    verdict = next((each for each in sorted((s for s in said if s is not None), key=bool)), None)
    if verdict is None:
        return quantity
    if not verdict:
        at = ", ".join(f"{name} = {value}" for name, value in verdict.point)
        message = f"`{quantity.key}` contradicts the motion of the described system: {verdict.detail}"
        help_line = (
            "if the result holds only for some values of the letters, state these with `assume:`, or give numbers"
        )
        notes = (f"for example at {at}",) if at else ()
        raise Unverified(Complaint("contradicts-motion", message, help=help_line, notes=notes))
    evidence = Evidence("motion", Compared.WITNESS, verdict.grade, verdict.detail)
    return replace(quantity, step=replace(quantity.step, evidence=(*quantity.step.evidence, evidence)))


def _told_centre(words: Mapping[str, str], body: Any) -> Mapping[str, str]:
    """Write "centre of mass" in full if another point of the body may be called "centre"."""
    is_unclear = words.get("about") == "centre" and bool(getattr(body, "other_centre", ""))
    return {**words, "about": "centre_of_mass"} if is_unclear else words


def _place_of_verb(frame: FrameType) -> str:
    """Return the file and line where a verb states its law; an empty text for a verb outside `derive`."""
    module = str(frame.f_globals["__name__"])
    return f"{module.replace('.', '/')}.py:{frame.f_lineno}" if module.partition(".")[0] == "derive" else ""


def _check_told(key: str, told: Mapping[str, tuple[Any, Any]]) -> None:
    """Check that each formula of the sentence equals the same formula by a different route, and that each condition
    contains a symbol."""
    for role, (formula, otherwise) in told.items():
        verdict = equal(formula, otherwise)
        if not verdict:
            raise refused(key, f"its sentence has a wrong `{role}`", formula, otherwise, verdict)
        if isinstance(formula, Relation) and not explicit(formula).free_symbols:
            message = f"`{key}`: its sentence gives {formula} as a condition, but this condition contains no symbol"
            raise Unverified(Complaint("unverified", message))


def _check_words(key: str, words: Mapping[str, str]) -> None:
    empty = next((term for term, word in words.items() if not word), None)
    if empty is not None:
        raise Unverified(Complaint("unverified", f"`{key}`: its sentence has an empty word for `{empty}`"))


def _check_pointed(key: str, pointed: Mapping[str, Quantity]) -> None:
    """Check that the sentence does not name one step in two roles."""
    if len({id(quantity) for quantity in pointed.values()}) < len(pointed):
        message = f"`{key}`: its sentence names one step as {' and as '.join(pointed)}"
        raise Unverified(Complaint("unverified", message))


def _check_outcome(key: str, rule: Rule, outcome: str, facts: Judged, may_be_zero: bool) -> None:
    """Check that the word that chooses the sentence is true of the result."""
    vanishing = is_zero(facts.result)
    if outcome == ZERO and not vanishing:
        raise _not_confirmed(key, Doubt("the result is not known to be zero"))
    if outcome == GENERIC and may_be_zero and vanishing:
        raise _not_confirmed(key, Doubt("the result is zero"))
    verdict = rule.verdict(outcome, facts)
    if not verdict:
        raise _not_confirmed(key, verdict if isinstance(verdict, Doubt) else undecided(facts.result))


def _not_confirmed(key: str, doubt: Doubt) -> Unverified:
    message = f"`{key}`: the sentence for this result could not be confirmed: {doubt.reason}"
    return Unverified(Complaint("unverified", message, help=doubt.help))


def _check_named(key: str, rule: Rule, facts: Judged, named: Mapping[str, Any]) -> None:
    """Check that the predicate of each object that only the sentence names is true."""
    role = rule.wrongly_named(facts, named)
    if role is not None:
        message = f"`{key}`: its sentence names {short(named[role])} as `{role}`, which does not fit the result"
        raise Unverified(Complaint("unverified", message))


def _check_handed_on(key: str, facts: Judged, handed_on: Sequence[Fact]) -> None:
    wrong = wrongly_handed_on(facts, handed_on)
    if wrong is not None:
        message = f"`{key}`: its fact {type(wrong).__name__}, which later steps use, does not fit its result"
        raise Unverified(Complaint("unverified", message))


def _check_names(key: str, quantities: Sequence[Quantity]) -> None:
    """Reject two distinct inputs with the same name in one formula."""
    named: dict[Any, Quantity] = {}
    for quantity in quantities:
        if quantity.symbol is None:
            continue
        other = named.setdefault(quantity.symbol, quantity)
        if other.step != quantity.step:
            message = f"`{key}` needs `{other.key}` and `{quantity.key}`, but both are called {quantity.symbol}"
            raise Rejected(
                Complaint(
                    "letter-clash",
                    message,
                    help=Spelled(
                        'pass `symbol="..."` to one of the two verbs',
                        "give one of the two another letter, under `symbols` or with `symbol`",
                    ),
                )
            )


def _check_letter(key: str, symbol: Any, result: Any, means: Mapping[Any, Any]) -> None:
    """Reject a result that contains its own symbol, and two components with the same symbol."""
    letters = {symbol} if isinstance(symbol, Symbol) else set(means)
    if isinstance(symbol, MatrixBase) and len(set(symbol)) < len(symbol):
        raise Unverified(Complaint("unverified", f"`{key}`: two of {', '.join(map(str, symbol))} have the same name"))
    taken = {str(letter) for letter in letters} & {str(other) for other in result.free_symbols}
    if taken:
        name = min(taken)
        message = f"`{key}` is called {name}, but {name} already denotes another quantity"
        raise Rejected(
            Complaint(
                "letter-clash",
                message,
                help=Spelled('use another letter, or pass `symbol="..."` to the verb', "use another letter"),
            )
        )


def check_can_hold(key: str, result: Any) -> None:
    """Reject a strict inequality or `!=` between two identical sides, which can never hold."""
    if isinstance(result, Relation) and result.operator in {"<", ">", "!="} and result.left == result.right:
        raise Unverified(Complaint("unverified", f"`{key}` can never hold: {short(result)}"))


def _check_has_value(key: str, result: Any) -> None:
    if has_no_value(result):
        message = f"`{key}` has no value: a denominator in it vanishes, or a part of it is infinite"
        raise Rejected(Complaint("no-value", message, help="look for values that make a denominator vanish"))


def _unsupported(key: str, rule: Rule) -> Evidence:
    """Return the evidence of a definition; reject any other step without a second route."""
    if not rule.is_definition:
        raise Unverified(Complaint("no-second-route", f"`{key}` has no second route and is not a definition"))
    return Evidence("definition", Compared.NOTHING, Grade.DEFINITION, rule.name)
