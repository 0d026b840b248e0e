"""From steps to words: the phrase for a rule and an outcome, with its names filled from the derivation.

A phrase becomes nodes, such as `Text`, `Math`, `Ref` and `Chain`, which do not depend on the output format. Inputs,
axes, coordinates and steps have names here; an unknown name is an error, so prose can mention no other quantity.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeGuard

from jinja2 import Template, UndefinedError
from jinja2.meta import find_undeclared_variables
from jinja2.nodes import Compare, Name
from sympy.core.symbol import Str, Symbol

from derive.algebra.dimensions import Dimension
from derive.algebra.direction import Direction
from derive.algebra.equality import Grade
from derive.algebra.expressions import AXES, IN_DEGREES, TIME, Amount, Relation, explicit, scalar
from derive.algebra.kinds import unit_of_dimension, unit_of_kind
from derive.algebra.rounding import rounded_form
from derive.course.given import Given, Measured
from derive.course.names import ENGLISH, DecimalSign, Language
from derive.course.parts import points_text
from derive.course.problem import Problem
from derive.course.problem_file import ANY_OUTCOME
from derive.course.prose import Mention, TexFormula
from derive.errors import Complaint, DeriveError, Place, Rejected, did_you_mean, with_article
from derive.page.no_break_spaces import unbroken
from derive.page.phrasebook import OF_EVERY_PAGE, SHOWN_AS, Phrase, PhraseTable, no_phrase, read_phrases
from derive.page.template import Templates, environment
from derive.steps.derivation import Derivation
from derive.steps.numeric import in_radians
from derive.steps.step import Step


@dataclass(frozen=True)
class Text:
    """Running text, in which a number and its unit are not separated by the end of a line."""

    text: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", unbroken(self.text))


EQUALS = Text(" = ")


@dataclass(frozen=True)
class Verdict(Text):
    """A word that answers the question of a part, such as "stable"; it is framed like a formula that is an answer."""


@dataclass(frozen=True)
class FigureRef(Text):
    """A reference to a drawing of the page: Figure 1. In a list, such as Figures 1 and 2, the number is alone."""

    key: str
    number: int
    is_alone: bool = False


@dataclass(frozen=True)
class Math:
    """An expression in running text."""

    expr: Any


@dataclass(frozen=True)
class DisplayedMath(Math):
    """A formula of the author on a line of its own."""


@dataclass(frozen=True)
class FramedMath(Math):
    """A condition in running text that answers the question of a part; it is framed."""


@dataclass(frozen=True)
class DimensionMark:
    """A dimension, M L^2 T^-2, printed upright."""

    dimension: Dimension


@dataclass(frozen=True)
class UnitMark:
    text: str


@dataclass(frozen=True)
class Ref:
    """A reference by number to the last line of a step."""

    key: str


@dataclass(frozen=True)
class ProblemRef:
    """A reference to another problem of the set: Problem 3."""

    id: str
    text: str


@dataclass(frozen=True)
class Chain:
    """The place in a sentence where the lines of its step are printed."""


_PRINTED_NAME = re.compile(r"<<(\w+)(?:\.\w+)?>>")
_DECIMAL_POINT = re.compile(r"(?<=[0-9])\.(?=[0-9])")

AND = " and "  # key of a phrase for two steps: outcome of the first, AND, rule of the second
AFTER = " after "  # key of a phrase: outcome, AFTER, outcome or rule of the step just before
SAME = "same"  # a word after AFTER: the step just before has the same rule, outcome and words

JOINED = "<<chain>>"  # the phrase of a step without words; its lines follow the lines of the step before
VALUE = "value_"  # prefix of the roles that give values of symbols

AXIS_NAMES = {**{axis: Math(scalar(axis)) for axis in AXES}, "t": Math(TIME)}  # axes and time


@dataclass(frozen=True)
class ToldIn:
    """The problem that first states a theorem in a document: Problem 1."""

    problem: str


@dataclass(frozen=True)
class ToldOnce:
    """A theorem: its statement, and the shorter sentence that replaces the statement if an earlier problem of the
    document states the theorem."""

    name: str
    nodes: tuple[Inline, ...]
    again: tuple[Inline, ...]


@dataclass(frozen=True)
class NewParagraph:
    """The end of a paragraph within a text, such as the remarks of a problem."""


class Forms(tuple["Inline", ...]):
    """A word with its forms by name, such as the cases of a noun: `<<part>>` prints the first form, `<<part.gen>>`
    another."""

    forms: Mapping[str, tuple[Inline, ...]]

    @classmethod
    def of(cls, forms: Mapping[str, tuple[Inline, ...]]) -> Forms:
        made = cls(next(iter(forms.values())))
        made.forms = forms
        return made


Inline = NewParagraph | Text | Math | DimensionMark | UnitMark | Ref | ProblemRef | Chain | ToldOnce | ToldIn


@dataclass(frozen=True)
class Phrases:
    """The phrases of one language: see the files of `templates/phrases/en`."""

    rules: PhraseTable
    routes: Mapping[str, Mapping[str, str]]
    reasons: Mapping[str, Mapping[str, str]]
    theorems: Mapping[str, str]
    theorems_again: Mapping[str, str]
    setups: Mapping[str, Mapping[str, str]]
    clauses: Mapping[str, Mapping[str, str]]
    tasks: Mapping[str, str]
    laws: Mapping[str, str]
    terms: Mapping[str, str | Mapping[str, str]]
    bodies: Mapping[str, str]
    sizes: Mapping[str, str]
    drawings: Mapping[str, str]
    grades: Mapping[str, str]
    labels: Mapping[str, Any]

    @property
    def sign(self) -> str:
        """Return the decimal sign of numbers."""
        return "," if self.labels["language"]["decimal"] == DecimalSign.COMMA else "."

    def phrase(self, step: Step, before: Step | None = None) -> str:
        """Return the phrase for the sentence of a step; the phrase may depend on the step shown just before."""
        of_rule: Mapping[str, str] = self.rules.get(step.rule, {})
        preceded_by = "" if before is None else before.outcome if before.rule == step.rule else before.rule
        keys = [f"{step.outcome}{AFTER}{preceded_by}", step.outcome]
        if before is not None and (before.rule, before.outcome) == (step.rule, step.outcome):
            told = of_rule.get(step.outcome, "")
            printed = set(_PRINTED_NAME.findall(told))
            words = [{name: word for name, word in each.words if name in printed} for each in (before, step)]
            keys[:0] = [f"{step.outcome}{AFTER}{SAME}"] if words[0] == words[1] else []
        phrase = next((of_rule[key] for key in keys if key in of_rule), None)
        if phrase is None:
            raise Rejected(no_phrase(step.key, step.rule, step.outcome, self.rules))
        return phrase

    def of_both(self, step: Step, following: Step) -> str:
        """Return the phrase for one sentence about a step and the next step, or "" if there is no such phrase."""
        of_rule: Mapping[str, str] = self.rules.get(step.rule, {})
        return of_rule.get(f"{step.outcome}{AND}{following.rule}", "")

    def setup(self, step: Step) -> str:
        """Return the phrase that introduces axes, coordinates and the like for a step without lines."""
        return self.setups.get(step.rule, {}).get(step.outcome, "")

    def reason(self, step: Step, because: str, before: str) -> str:
        """Return the reason why a line follows from the line before. Some reasons apply only after a certain kind of
        line."""
        own = {**self.reasons["general"], **self.reasons.get(step.rule, {})}
        return own.get(f"{because}{AFTER}{before}", own.get(because, ""))

    def route(self, step: Step, claim: str) -> str:
        return self.routes.get(step.rule, {}).get(claim, "")

    def beside_answer(self, step: Step, again: str | None) -> tuple[Inline, ...]:
        """Return the note next to an answer that repeats an earlier equation, or that is only a definition."""
        if again is not None:
            return filled(self.labels["again"], {"ref": Ref(again)})
        return (Text(self.labels["by_definition"]),) if step.grade is Grade.DEFINITION and not step.inputs else ()

    def worth(self, points: Any, extra: bool = False) -> str:
        """Return the points in words, such as `2.5 points`; "" if there are none. An extra question has a label
        instead."""
        if extra:
            return str(self.labels["extra"])
        if points is None:
            return ""
        names = {"points": self.number(points_text(points)), "value": points}
        return "".join(node.text for node in filled(self.labels["worth"], names) if isinstance(node, Text))

    def number(self, text: str) -> str:
        """Return text with the decimal sign of the page in place of each decimal point."""
        return text if self.sign == "." else _DECIMAL_POINT.sub(self.sign, text)

    def numbers(self, nodes: tuple[Inline, ...]) -> tuple[Inline, ...]:
        """Return nodes that the engine wrote, with the decimal sign of the page in their numbers."""
        if self.sign == ".":
            return nodes
        return tuple(replace(node, text=self.number(node.text)) if isinstance(node, Text) else node for node in nodes)

    @property
    def semicolon(self) -> Text:
        return Text(f"{self.labels['language'].get('semicolon', ';')} ")

    def compared(self, rule: str) -> set[str]:
        """Return the names whose values the phrases of a rule compare with words."""
        tables = (self.rules, self.setups, self.clauses)
        return {name for table in tables for phrase in table.get(rule, {}).values() for name in names_compared(phrase)}

    def term(self, word: str) -> tuple[Inline, ...]:
        """Return the text of `terms:` for a word of a step or an input: `diagonal` is "a long diagonal". A word without
        a text is a name that the author chose; its text is the label `own_name`."""
        told = self.terms.get(word)
        if isinstance(told, str):
            return filled(told, AXIS_NAMES)
        forms: Mapping[str, str] = told or self.labels["own_name"]
        return Forms.of({name: filled(form, {**AXIS_NAMES, "name": Text(word)}) for name, form in forms.items()})

    def shape(self, id: str) -> str:
        """Return the text for the shape of a body in prose: "cuboid"; in a language with genders, with an article."""
        return self.body(id) if self.labels["language"].get("genders") else id.replace("_", " ")

    def body(self, id: str) -> str:
        """Return the text for a kind of body: "a hollow ball" for `thick_shell`; by default the id of the kind with an
        article."""
        return self.bodies.get(id) or with_article(id)

    def rule(self, rule: str) -> str:
        """Return a short name for the result of a rule: "kinetic energy" for `lagrange.kinetic_energy`."""
        return str(self.labels["rules"].get(rule, rule.rpartition(".")[2].replace("_", " ")))

    def size(self, id: str) -> str:
        """Return the text for a size of a body: `base_radius` is "base radius"."""
        return self.sizes.get(id) or id.replace("_", " ")


def phrases(templates: Templates, language: Language = ENGLISH) -> Phrases:
    """Return the phrases of a language; they are read again if the files have changed."""
    below = [folder / "phrases" for folder in templates.folders]
    known = sorted({page.parent.name for folder in below for page in folder.glob(f"*/{OF_EVERY_PAGE}")})
    if language.name not in known:
        message, place = (
            f"there are no phrases of the language `{language.name}`",
            getattr(language.name, "place", None),
        )
        help_line = f"the languages are {', '.join(f'`{name}`' for name in known)}"
        raise Rejected(Complaint("no-such-language", message, place, help=help_line))
    folders = tuple(folder / language.name for folder in below if (folder / language.name).is_dir())
    files = (file for folder in folders for file in sorted(folder.glob("*.yaml")))
    return _phrases(folders, tuple((str(file), file.stat().st_mtime_ns) for file in files), language.decimal)


@lru_cache(maxsize=4)
def _phrases(folders: tuple[Path, ...], written: tuple[tuple[str, int], ...], decimal: DecimalSign | None) -> Phrases:
    read = read_phrases(folders)
    if decimal:
        read["labels"]["language"]["decimal"] = decimal.value
    return Phrases(**read)


# --- filling ---

_IN_PROSE = environment()
_TOKEN = re.compile("\x00(\\d+)\x00")


class _Printed(str):
    """The token of a node in a template; `<<name.form>>` is the token of another form of a word."""

    forms: Mapping[str, str]

    def __getattr__(self, name: str) -> str:
        forms: Mapping[str, str] = self.__dict__.get("forms", {})
        if name not in forms:
            raise AttributeError(name)
        return forms[name]


class _Nodes:
    """Nodes that a template prints: each node is printed as a token, and `split` replaces the tokens by the nodes."""

    def __init__(self) -> None:
        self.found: list[Inline | tuple[Inline, ...]] = []

    def token(self, value: Any) -> Any:
        if value == ():
            return ""  # an empty text is false in a condition of a phrase
        if not isinstance(value, Inline | tuple):
            return value
        printed = _Printed(self._numbered(value))
        if isinstance(value, Forms):
            printed.forms = {name: self._numbered(form) for name, form in value.forms.items()}
        return printed

    def _numbered(self, value: Inline | tuple[Inline, ...]) -> str:
        self.found.append(value)
        return f"\x00{len(self.found) - 1}\x00"

    def split(self, text: str) -> tuple[Inline, ...]:
        nodes: list[Inline] = []
        for i, piece in enumerate(_TOKEN.split(text)):
            if i % 2 == 0:
                if piece:
                    nodes.append(Text(piece))
                continue
            value = self.found[int(piece)]
            nodes.extend(value if isinstance(value, tuple) else (value,))
        return tuple(nodes)


def filled(template: str, names: Mapping[str, Any]) -> tuple[Inline, ...]:
    """Return a phrase with its names replaced by their values."""
    nodes = _Nodes()
    try:
        text = _compiled(template).render({name: nodes.token(value) for name, value in names.items()})
    except UndefinedError as error:
        message = f"a phrase uses an unknown name: {error.message}"
        raise Rejected(Complaint("undefined-name", message, _place_of(template))) from error
    except DeriveError:
        raise
    except Exception as error:  # an expression in a phrase can raise any error
        said = (str(error).splitlines() or [""])[0] or type(error).__name__
        raise Rejected(Complaint("bad-phrase", f"a phrase cannot be read: {said}", _place_of(template))) from error
    return nodes.split(text.strip())


@lru_cache(maxsize=2048)
def _compiled(template: str) -> Template:
    return _IN_PROSE.from_string(template)


@lru_cache(maxsize=2048)
def names_asked(template: str) -> frozenset[str]:
    """Return all names in a phrase, printed or only tested."""
    return frozenset(find_undeclared_variables(_IN_PROSE.parse(template)))


@lru_cache(maxsize=2048)
def names_compared(template: str) -> frozenset[str]:
    """Return the names that a phrase compares, such as `seen` in `<% if seen == "kept" %>`."""
    sides = (side for each in _IN_PROSE.parse(template).find_all(Compare) for side in (each.expr, each.ops[0].expr))
    return frozenset(side.name for side in sides if isinstance(side, Name))


def _place_of(template: str) -> Place:
    return template.place if isinstance(template, Phrase) else Place(f"{SHOWN_AS}/en/{OF_EVERY_PAGE}", 1)


def told(
    pieces: Sequence[Any],
    names: Mapping[str, Any],
    missing: Callable[[str, Place], None],
    referred: Callable[[Mention], Inline | None] = lambda mention: None,
    formula: Callable[[TexFormula], Inline] = lambda formula: Text(f"${formula.tex}$"),
) -> tuple[Inline, ...]:
    """Return the author's prose with its mentions replaced by values; an unknown name is reported and omitted.

    `referred` returns the node for a mention of an equation, drawing or problem, or None; `formula` returns the node
    for a formula.
    """
    nodes: list[Inline] = []
    for piece in pieces:
        if isinstance(piece, str):
            nodes.append(Text(re.sub(r"\s+", " ", piece)))
        elif isinstance(piece, TexFormula):
            read = formula(piece)
            nodes.append(DisplayedMath(read.expr) if piece.displayed and isinstance(read, Math) else read)
        elif piece.of:
            node = referred(piece)
            nodes += [node] if node else []
        elif piece.name in names:
            value = names[piece.name]
            nodes.extend(
                value if isinstance(value, tuple) else (value if isinstance(value, Inline) else Text(str(value)),)
            )
        else:
            missing(piece.name, piece.place)
    return tuple(nodes)


def joined(items: Iterable[tuple[Inline, ...] | Inline], last: str = "and") -> tuple[Inline, ...]:
    """Join items as in `a, b and c`."""
    groups = [item if isinstance(item, tuple) else (item,) for item in items]
    nodes: list[Inline] = []
    for i, group in enumerate(groups):
        if i:
            nodes.append(Text(f" {last} " if i == len(groups) - 1 else ", "))
        nodes.extend(group)
    return tuple(nodes)


def name_of(step: Step) -> Inline:
    """Return the name of a step's result in prose: the symbol, or the equation number of a relation."""
    return Ref(step.key) if step.symbol is None else Math(step.symbol)


def equation_of(step: Step) -> Inline:
    """Return the result of a step as an equation in running text."""
    return Math(step.result if step.symbol is None else Relation(step.symbol, "=", step.result))


def with_verdict(nodes: Sequence[Inline], words: Phrases) -> tuple[Inline, ...]:
    """Return the sentence with its verdict marked, if it contains exactly one verdict: "the equilibrium is stable". In
    a sentence with several verdicts, a single inequality is marked instead."""
    pattern = re.compile(rf"\b({'|'.join(words.labels['verdicts'])})\b")
    found = [(i, match) for i, node in enumerate(nodes) if type(node) is Text for match in pattern.finditer(node.text)]
    if len(found) > 1:
        is_only_one = sum(map(_is_inequality, nodes)) == 1
        return tuple(FramedMath(node.expr) if is_only_one and _is_inequality(node) else node for node in nodes)
    if len(found) != 1:
        return tuple(nodes)
    ((i, match),) = found
    before, after = match.string[: match.start()], match.string[match.end() :]
    return (*nodes[:i], Text(before), Verdict(match.group()), Text(after), *nodes[i + 1 :])


def _is_inequality(node: Inline) -> TypeGuard[Math]:
    return isinstance(node, Math) and isinstance(node.expr, Relation) and node.expr.operator in ("<", ">")


def names_of_step(step: Step, words: Phrases, dimension: Dimension | None) -> dict[str, Any]:
    """Return the names that the phrase of a step may mention, with their values."""
    names: dict[str, Any] = {
        "chain": Chain(),
        "symbol": name_of(step),
        "result": Math(step.result),
    }
    roles = letters_put_equal(step.roles)
    names.update({role: Ref(called.name) if isinstance(called, Str) else Math(called) for role, called in roles})
    names.update(_lists(names, words.labels["and"]))
    compared = words.compared(step.rule)
    names.update({name: word if name in compared else words.term(word) for name, word in step.words})
    names.update(AXIS_NAMES)
    if dimension is not None:
        names["dimension"] = DimensionMark(dimension)
    unit = unit_of_kind(step.kind) if step.kind else unit_of_dimension(dimension) if dimension is not None else ""
    if unit:
        names["unit"] = UnitMark(unit)
    return names


def _lists(names: Mapping[str, Any], last: str) -> dict[str, tuple[Inline, ...]]:
    """Join numbered roles: equation_1, equation_2 and equation_3 become `equation_list`, "(1), (2) and (3)"."""
    groups: dict[str, list[Any]] = {}
    for role in sorted(names, key=lambda name: (len(name), name)):
        stem, _, number = role.rpartition("_")
        if number.isdigit():
            groups.setdefault(f"{stem}_list", []).append(names[role])
    return {name: joined(items, last) for name, items in groups.items()}


def letters_put_equal(roles: Sequence[tuple[str, Any]]) -> list[tuple[str, Any]]:
    """Join b = a in value_1 and c = a in value_2 to b = c = a; other roles are unchanged."""
    values = [told for role, told in roles if role.startswith(VALUE) and isinstance(told, Relation)]
    joined_at: dict[Any, Any] = {}
    for each in values:
        at = (
            each.right if each.operator == "=" and isinstance(each.right, Symbol) else each
        )  # only values that are symbols are joined, not equal numbers
        joined_at[at] = Relation(Relation(joined_at[at].left, "=", each.left), "=", at) if at in joined_at else each
    others = [(role, told) for role, told in roles if not (role.startswith(VALUE) and isinstance(told, Relation))]
    return [*others, *((f"{VALUE}{i}", told) for i, told in enumerate(joined_at.values(), 1))]


def in_turn(step: Step, following: Iterable[Step], words: Phrases) -> dict[str, tuple[Inline, ...]]:
    """Return the names that a sentence of a step and the following steps may contain, with their values. For example,
    `together` is the list of their coordinates, `theta, x and y`."""
    steps = [step]
    for each in following:
        if each.rule != step.rule or words.phrase(each, steps[-1]) != JOINED:
            break
        steps.append(each)
    if len(steps) == 1:
        return {}
    named = [dict(each.roles) for each in steps]
    lists = {role: [each[role] for each in named if isinstance(each.get(role), Str)] for role in named[0]}
    found: dict[str, list[Inline]] = {
        f"{role}_together": [Ref(each.name) for each in told] for role, told in lists.items()
    }
    found["together"] = [Math(q) for each in named if (q := each.get("coordinate")) is not None]
    return {name: joined(told, words.labels["and"]) for name, told in found.items() if len(told) == len(steps)}


def given_words(given: Given, measured: Iterable[Measured], words: Phrases) -> tuple[Inline, ...]:
    """Return an input as the statement shows it: `a, 2a and 3a`, `M = 1.5 kg`, `a long diagonal`."""
    if given.word is not None:
        is_shape = given.name.rpartition(".")[2] == "shape"
        return (Text(words.shape(given.word)),) if is_shape else words.term(given.word)
    if given.written is not None:
        return (Math(given.written),)
    if isinstance(given.value, Direction) and given.value.components:
        return *words.term("components"), Text(f" {words.labels['along']} "), Math(tuple(given.value.components))
    amounts = {m.symbol: Amount(m.number, m.unit, m.factor) for m in measured}
    values = given.value if isinstance(given.value, tuple) else (given.value,)
    last = words.labels["and"]
    if len(set(values)) == len(values) and all(v in amounts or not v.free_symbols & set(amounts) for v in values):
        return joined([_stated(v, amounts) if v in amounts else (Math(v),) for v in values], last)
    behind = [symbol for symbol in amounts if any(v.has(symbol) for v in values)]
    names = joined([(Math(v),) for v in values], last)
    if not behind:
        return names
    return *names, Text(f" {words.labels['with']} "), *joined([_stated(symbol, amounts) for symbol in behind], last)


def stated_once(nodes: Sequence[Inline], last: str, also: str) -> tuple[Inline, ...]:
    """Show the number of a symbol only at its first occurrence: `a = 10 cm`, then `a`.

    `last` is the word between an expression and its symbols, as in `a/2 with a = 10 cm`, and `also` is "and".
    """
    kept: list[Inline] = []
    known: set[Any] = set()
    for i, node in enumerate(nodes):
        kept.append(node)
        letter, sign = (kept[-3:-1]) if len(kept) > 2 else (None, None)
        if not (sign == EQUALS and isinstance(letter, Math) and isinstance(node, Math)):
            continue
        if not isinstance(node.expr, Amount) or letter.expr not in known:
            known.add(letter.expr)
            continue
        del kept[-2:]
        alone = kept[-2:-1] == [Text(f" {last} ")] and nodes[i + 1 : i + 2] != (Text(f" {also} "),)
        if alone:
            del kept[-2:]
    return tuple(kept)


def conversions(problem: Problem, put_in: Collection[Any]) -> list[tuple[Inline, ...]]:
    """Return the unit conversions of the given numbers that a step substitutes. The step may substitute an angle in
    degrees or in radians."""
    given = [(m, problem.amounts[m.symbol]) for m in problem.measured]
    written = [(m, amount) for m, own in given for amount in dict.fromkeys((own, in_radians(own)))]
    return [conversion(m, amount, problem.figures) for m, amount in written if amount in put_in]


def conversion(measured: Measured, amount: Amount, figures: int) -> tuple[Inline, ...]:
    """Return `omega = 900 rpm = 30 pi rad/s ≈ 94.25 rad/s`, or `M = 1.5 kg` if nothing is converted."""
    written = Amount(measured.number, measured.unit, measured.factor)
    nodes: list[Inline] = [Math(measured.symbol), EQUALS, Math(written)]
    if measured.unit != amount.args[1].name:
        nodes += [EQUALS, Math(amount)]
    if not explicit(amount).is_Rational and amount.args[1].name not in IN_DEGREES:
        nodes += [Text(" \u2248 "), Math(Amount(rounded_form(measured.si, figures), amount.args[1], amount.args[2]))]
    return tuple(nodes)


def _stated(symbol: Any, amounts: Mapping[Any, Amount]) -> tuple[Inline, ...]:
    return Math(symbol), EQUALS, Math(amounts[symbol])


def around_chain(nodes: tuple[Inline, ...]) -> tuple[tuple[Inline, ...], tuple[Inline, ...]]:
    """Return the words before and the words after the lines of a step."""
    at = next((i for i, node in enumerate(nodes) if isinstance(node, Chain)), len(nodes))
    return _trimmed(nodes[:at]), _trimmed(nodes[at + 1 :])


def _trimmed(nodes: tuple[Inline, ...]) -> tuple[Inline, ...]:
    """Remove blank text at both ends, and punctuation at the beginning."""
    kept = list(nodes)
    while kept and isinstance(kept[0], Text) and not kept[0].text.strip(" .,"):
        kept.pop(0)
    while kept and isinstance(kept[-1], Text) and not kept[-1].text.strip():
        kept.pop()
    return tuple(kept)


def unknown_keys(problem: Problem, derivation: Derivation, words: Phrases) -> list[Complaint]:
    """Return errors for unknown keys of `wording:` and `show:`, and for unknown outcomes."""
    here = {step.key: step for step in derivation.steps}
    in_another_case = {key for step in derivation.steps for key in step.stands_for}
    known = {*here, *in_another_case, *derivation.unshown}  # `unshown` has steps on which no answer depends
    faults = []
    for section, key in [*(("wording", key) for key in problem.wording), *(("show", key) for key in problem.show)]:
        if key not in known:
            message, place = f"no step on this page is called `{key}`", problem.place_of(section, key)
            faults.append(Complaint("unknown-key", message, place, help=did_you_mean(key, here)))
    for key, outcome in [(key, outcome) for key, told_of in problem.wording.items() for outcome in told_of]:
        phrases_of = words.rules.get(here[key].rule, {}) if key in here else {}
        outcomes = [name for name in phrases_of if AFTER not in name and AND not in name]
        if outcome != ANY_OUTCOME and outcomes and outcome not in outcomes:
            message, place = f"the step `{key}` has no outcome `{outcome}`", problem.place_of("wording", key, outcome)
            help_line = did_you_mean(outcome, outcomes) or "its outcomes are " + ", ".join(
                f"`{each}`" for each in outcomes
            )
            faults.append(Complaint("unknown-key", message, place, help=help_line))
    return faults
