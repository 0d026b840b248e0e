r"""Break one row of a right document as people do: the audit must blame this row, and no other one.

    python -P -m tests.damage 500 --seed 7 [--derivation]

The right documents are our own solutions, derived once into a temporary folder. The side of a claim is damaged only
where the damage changes what the claim says. The table tells for each kind of damage and for each kind of claim how
many rows are blamed at their place, named as the other possibility, blamed elsewhere, undecided, listed as statements
that nothing confirms, and passed silently.
Damages that a document itself cannot show are counted apart; `can_be_seen` states the rule. With `--derivation`, each
document is also compared with the results of its problem, as by `derive audit --problem`.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from derive.audit.auditing import Audit, audited
from derive.audit.claims import Claim, Outcome
from derive.audit.expected import Expected
from derive.audit.fingerprint import differ, fingerprint
from derive.audit.nearest_change import letters_in
from derive.documents.layout import read_document
from derive.documents.source import Format, source_of

ROOT = Path(__file__).resolve().parent.parent
FOLDER = Path(tempfile.gettempdir()) / "derive-documents"
RESULTS = ("blamed", "named", "elsewhere", "undecided", "unconfirmed", "silent")

_GREEK = r"\\(?:alpha|beta|gamma|theta|phi|psi|omega|Omega|lambda|mu|rho|sigma)(?![a-zA-Z])"
_LETTER = rf"{_GREEK}|(?<![\\a-zA-Z{{])[a-zA-Z](?![a-zA-Z])"


@dataclass(frozen=True)
class Damage:
    kind: str
    text: str


def damages_of(side: str, random_: random.Random) -> Iterator[Damage]:
    """Yield the damages of each kind to the text of one side, each at a random place."""
    zones = [found.span() for found in re.finditer(r"\\text\{[^{}]*\}|\\begin\{\w+\}|\\end\{\w+\}|\[\d+pt\]", side)]

    def places(pattern: str) -> list[re.Match[str]]:
        found = [
            each for each in re.finditer(pattern, side) if not any(start <= each.start() < end for start, end in zones)
        ]
        return random_.sample(found, min(1, len(found)))

    def changed(kind: str, found: re.Match[str], new: str) -> Damage:
        return Damage(kind, side[: found.start()] + new + side[found.end() :])

    for found in places(r"(?<![_\d.{])\d(?![\d.])|(?<=frac\{)\d(?=\})|(?<=\}\{)\d(?=\})"):
        yield changed("digit", found, random_.choice([d for d in "123456789" if d != found[0]]))
    for found in places(r"(?<=[\w})])\s*[+-](?=\s*[\w\\({])"):
        yield changed("sign", found, "-" if "+" in found[0] else "+")
    for found in places(r"^\s*-\s*(?=[\w\\({])"):
        yield changed("sign", found, "")
    for found in places(r"(?<=_)\{?[12xyz]\}?"):
        inner = found[0].strip("{}")
        other = {"1": "2", "2": "1", "x": "y", "y": "x", "z": "x"}[inner]
        yield changed("index", found, found[0].replace(inner, other))
    for found in places(r"\^\{?[2-5]\}?"):
        power = int(found[0].strip("^{}"))
        yield changed("exponent", found, random_.choice(["", f"^{{{power + 1}}}"]))
    for found in places(rf"(?<![\^_{{])(?<!\\frac)(?<!d)(?<!\\partial )(?<!\\partial)(?:{_LETTER})(?!\s*[\^_'(])"):
        if found[0] != "d":
            yield changed("factor", found, " ")
    for found in places(
        r"[+-]\s*(?:[^\s+\-(){}\[\]=&\\]|\\[a-z]+(?![a-z])(?:\{\w+\})?|\^\{\w\}|_\{\w+\}|\\,| )+(?=[+\-]|\s*$|\))"
    ):
        yield changed("term", found, "")
    for found in places(r"\\(?:sin|cos)(?![a-z])"):
        yield changed("function", found, "\\cos" if "sin" in found[0] else "\\sin")
    for found in places(r"\\int_\{([^{}]*)\}\^\{([^{}]*)\}"):
        yield changed("limit", found, f"\\int_{{{found[2]}}}^{{{found[1]}}}")
    for found in places(_LETTER):
        letters = {each[0] for each in re.finditer(_LETTER, side)} - {found[0], "d"}
        if letters and found[0] != "d" and not side[: found.start()].rstrip().endswith(("partial", "dot", "{d")):
            yield changed("letter", found, random_.choice(sorted(letters)) + " ")


def documents(folder: Path = FOLDER, only: list[str] | None = None) -> dict[str, Path]:
    """Return the files of right documents by name; those that the folder lacks are derived."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = sorted(ROOT.glob("problems/library/*/*.yaml"))
    for source in sources if folder == FOLDER else []:
        file = folder / f"{source.stem}.tex"
        if (only is None or source.stem in only) and not file.exists():
            from derive.cli.options import main

            print(f"deriving {source.stem}", file=sys.stderr)
            main(["solve", f"library/{source.stem}", "--format", "fragment", "-o", str(file)])
    found = {file.stem: file for file in sorted(folder.glob("*.tex"))}
    return {name: file for name, file in found.items() if only is None or name in only}


def read(text: str, name: str, expected: Sequence[Expected] = ()) -> Audit:
    return audited(read_document(source_of(text, Format.TEX, f"{name}.tex")), expected=expected)


@cache
def derived(name: str) -> tuple[Expected, ...]:
    """The results of the derivation of a problem in the library."""
    from derive.building.expected import expected_results

    return tuple(expected_results(ROOT, f"library/{name}"))


def kind_of(claim: Claim) -> str:
    """Return what a right claim is: a step of a chain, or what the audit says of it."""
    assert claim.verdict is not None
    if claim.is_step:
        return "step"
    good = claim.verdict.outcome in (Outcome.HOLDS, Outcome.APPROXIMATES)
    return "derived" if good else str(claim.verdict.outcome)


def can_be_seen(right: Audit, claim: Claim) -> bool:
    """Whether the document itself shows a slip in a claim.

    It does not if the claim states something that no other row implies, and no later row uses it: the first value of a
    letter, a law, or a condition. A later row uses it if its verdict names the claim, or if the row is undecided and
    contains a letter that appears first in the claim.
    """
    assert claim.verdict is not None
    if claim.is_step or claim.verdict.outcome is not Outcome.DEFINES:
        return True
    if any(claim.number in each.verdict.given for each in right.claims if each.verdict is not None):
        return True
    before, new = letters_of(right.claims[: claim.number]), letters_of([claim])
    later = [e for e in right.claims[claim.number + 1 :] if e.verdict and e.verdict.outcome is Outcome.UNDECIDED]
    return bool((new - before) & letters_of(later))


def letters_of(claims: Sequence[Claim]) -> set[Any]:
    """Return the letters that are written in claims, without their dots."""
    sides = [side for each in claims for side in (each.left, each.right) if side is not None]
    return {letter.identity for letter in letters_in(*sides)}


def damaged_side(audit: Audit, claim: Claim, random_: random.Random) -> tuple[int, int]:
    """Return the span of the side that is damaged: the right one, or any of an equation."""
    both = [claim.right_span]
    if not claim.is_step and claim.left_span.start < claim.right_span.start:
        text = audit.document.source.text[claim.left_span.start : claim.left_span.end]
        if len(text) > 12 and not text.lstrip("&").strip().startswith("\\frac{d"):
            both.append(claim.left_span)
    span = random_.choice(both)
    return span.start, span.end


def says_something_else(before: Claim, after: Claim) -> bool:
    """Whether the damage changes what a claim says; an equation times a factor says the same."""
    if before.values is None or after.values is None:
        return True
    if any(not hasattr(each, "is_Add") for each in (*before.values, *after.values)):
        return str(before.values) != str(after.values)
    one, other = before.values[0] - before.values[1], after.values[0] - after.values[1]
    if differ(one, other) is not True:
        return False
    first, second = fingerprint(one), fingerprint(other)
    if first is None or second is None:
        return True
    ratios = [a / b for a, b in zip(first, second, strict=True) if b]
    return len(ratios) < len(first) or any(abs(each - ratios[0]) > 1e-9 * abs(each) for each in ratios)


def judged(audit: Audit, place: int) -> tuple[str, Claim | None]:
    """Return what the audit says about the row of a place in the text, and the claim there."""
    line = audit.document.source.line_of(place)
    here = [
        claim
        for claim in audit.claims
        if claim.right_span.start <= place <= claim.right_span.end
        or claim.left_span.start <= place <= claim.left_span.end
    ]
    outcomes = [claim.verdict.outcome for claim in here if claim.verdict is not None]
    wrong = [claim for claim in audit.claims if claim.verdict and claim.verdict.outcome is Outcome.DIFFERS]
    if Outcome.DIFFERS in outcomes:
        return "blamed", here[0]
    if any(line in (claim.verdict.or_lines if claim.verdict else ()) for claim in wrong):
        return "named", here[0] if here else None
    if wrong:
        return "elsewhere", here[0] if here else None
    if Outcome.UNDECIDED in outcomes or Outcome.UNREADABLE in outcomes or not here:
        return "undecided", here[0] if here else None
    unconfirmed = {claim.number for claim in audit.unconfirmed}
    return "unconfirmed" if any(claim.number in unconfirmed for claim in here) else "silent", here[0]


@dataclass(frozen=True)
class Trial:
    document: str
    line: int
    claim: str
    kind: str
    right: str
    damaged: str
    result: str
    because: str
    visible: bool = True


def trials(texts: dict[str, str], count: int, seed: int, each: int = 8, derivation: bool = False) -> Iterator[Trial]:
    """Yield the results of damages to documents in a random order.

    derivation   whether the documents are compared with the results of their problems
    """
    random_ = random.Random(seed)
    done = 0
    names = sorted(texts)
    while done < count:
        name = random_.choice(names)
        text = texts[name]
        expected = derived(name) if derivation else ()
        right = read(text, name, expected)
        wrong_before = {c.number for c in right.claims if c.verdict and c.verdict.outcome is Outcome.DIFFERS}
        if wrong_before:
            names.remove(name)
            continue
        claims = [c for c in right.claims if c.values is not None and c.relation in ("=", ":=", "~")]
        for claim in random_.sample(claims, min(each, len(claims))):
            start, end = damaged_side(right, claim, random_)
            written = text[start:end]
            options = [d for d in damages_of(written, random_) if d.text.strip() and d.text != written != "0"]
            if not options or text[start:end].count("{") != text[start:end].count("}") or "\\\\" in text[start:end]:
                continue
            kinds = sorted({d.kind for d in options})
            kind = random_.choice(kinds)
            damage = random_.choice([d for d in options if d.kind == kind])
            place = start + next(
                (i for i, (a, b) in enumerate(zip(text[start:end], damage.text, strict=False)) if a != b),
                min(end - start, len(damage.text)) - 1,
            )
            audit = read(text[:start] + damage.text + text[end:], name, expected)
            result, found = judged(audit, place)
            if found is None or (found.verdict is not None and found.verdict.outcome is Outcome.UNREADABLE):
                continue
            if found.values is not None and not says_something_else(claim, found):
                continue
            because = found.verdict.because if found.verdict is not None else ""
            yield Trial(
                name, right.document.source.line_of(start), kind_of(claim), damage.kind, text[start:end], damage.text,
                result, because, can_be_seen(right, claim),
            )  # fmt: skip
            done += 1
            if done >= count:
                return


def table(found: list[Trial], of: str) -> str:
    counted: dict[str, Counter[str]] = defaultdict(Counter)
    for trial in found:
        counted[getattr(trial, of)][trial.result] += 1
        counted["all"][trial.result] += 1
    lines = [f"{of:<12}" + "".join(f"{each:>12}" for each in (*RESULTS, "rows"))]
    for name, each in sorted(counted.items(), key=lambda item: (item[0] == "all", item[0])):
        total = each.total()
        lines.append(f"{name:<12}" + "".join(f"{each[r] / total:>12.1%}" for r in RESULTS) + f"{total:>12}")
    return "\n".join(lines)


def main(arguments: Any = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--documents", type=Path, default=FOLDER)
    parser.add_argument("--derivation", action="store_true", help="compare each document with its problem")
    parser.add_argument("--show", nargs="*", default=[], help="results of which each row is printed")
    given = parser.parse_args(arguments)
    started = time.process_time()
    found = []
    texts = {name: file.read_text(encoding="utf-8") for name, file in documents(given.documents).items()}
    for trial in trials(texts, given.count, given.seed, derivation=given.derivation):
        found.append(trial)
        if len(found) % 100 == 0:
            print(table(found, "kind"), flush=True)
        if trial.result in given.show:
            seen = "" if trial.visible else ", not visible"
            print(f"{trial.result}{seen} {trial.document}.tex:{trial.line} {trial.claim} {trial.kind}: {trial.because}")
            print(f"    {trial.right.strip()[:150]!r}\n    {trial.damaged.strip()[:150]!r}", flush=True)
    visible = [trial for trial in found if trial.visible]
    print(table(visible, "kind"), table(visible, "claim"), sep="\n\n")
    hidden = [trial for trial in found if not trial.visible]
    if hidden:
        print("\nDamages that the document itself does not show:", table(hidden, "claim"), sep="\n")
    print(f"\n{len(found)} damages, {time.process_time() - started:.0f} s")


if __name__ == "__main__":
    main()
