"""The claims of a document, in their order, and the facts about its letters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

from derive.audit.claims import Claim
from derive.documents.facts import Facts, facts_of
from derive.documents.layout import PROBLEM_WORDS, Document, Row, Statement
from derive.documents.parser import Unreadable, parsed
from derive.documents.syntax import (
    Node,
    Text,
)

_BRACKETS = re.compile(
    r"\bPoisson|\bcommutator|\bcommut(?:e|es)\b|\binner product|\bHilbert|\bHermitian|\badjoint", re.IGNORECASE
)
_NEW_SCOPE = re.compile(PROBLEM_WORDS, re.IGNORECASE)
_EXPLAINS = re.compile(r"[\s,;}~]*(?:where|with|in which|here)\b", re.IGNORECASE)
ENDS_SENTENCE = re.compile(r"[.!?](?:\s|$)|\n[ \t]*\n")


def claims_of(document: Document) -> tuple[list[Claim], Facts, list[tuple[Row, str]]]:
    """Return the claims of a document, the facts about its letters, and the rows that cannot be read."""
    nodes: dict[int, list[tuple[Node | None, str]]] = {}
    sides, equations, unread = [], [], []
    for row in document.rows:
        faults = [row.fault[0]] if row.fault else []
        scope = scope_of(document, row)
        for statement in row.statements:
            read: list[tuple[Node | None, str]] = []
            for side in statement.sides:
                try:
                    read.append((parsed(side.tokens), ""))
                except Unreadable as error:
                    read.append((None, error.message))
                    faults.append(error.message)
                except RecursionError:
                    read.append((None, "this formula is nested too deeply"))
                    faults.append("this formula is nested too deeply")
            nodes[id(statement)] = read
            sides += [node for node, _ in read if node is not None]
            first = nodes.get(id(_head(statement)), read)[0][0]
            for (one, _), (other, _) in pairwise(read):
                equations += [(one, other, scope)] if one is not None and other is not None else []
                equations += [(first, other, scope)] if first is not None and other is not None else []
        if faults:
            unread.append((row, faults[0]))
    facts = facts_of(sides, equations)
    facts.has_brackets = bool(_BRACKETS.search(document.source.text))
    facts.has_lagrange = "Lagrang" in document.source.text
    claims: list[Claim] = []
    last_of: dict[int, Claim] = {}
    for row in document.rows:
        for statement in row.statements:
            before = last_of.get(id(statement.follows)) if statement.follows is not None else None
            read = nodes[id(statement)]
            for index, relation in enumerate(statement.relations):
                if any(isinstance(node, Text) and node.text == "?" for node, _ in read[index : index + 2]):
                    continue  # the document leaves a blank here
                (left, left_fault), (right, right_fault) = read[index], read[index + 1]
                claim = Claim(
                    len(claims), row, statement, index, relation, left, right,
                    statement.sides[index].span, statement.sides[index + 1].span, left_fault or right_fault,
                    before if before is not None else None, tags=(row.tag,) if row.tag else (),
                )  # fmt: skip
                claims.append(claim)
                before = claim
            if before is not None:
                last_of[id(statement)] = before
    return claims, facts, unread


def scope_of(document: Document, row: Row) -> int:
    """Return the number of the heading that begins the problem or section of a row; -1 before the first one."""
    for index in range(row.block.heading, -1, -1):
        heading = document.headings[index]
        if heading.level <= 1 or _NEW_SCOPE.search(heading.text):
            return index
    return -1


def explanations(document: Document, claims: Sequence[Claim]) -> dict[int, list[Claim]]:
    """Return the claims after each display that explain its letters in the same sentence: `..., where rho = M/V`."""
    by_block: dict[int, list[Claim]] = {}
    for claim in claims:
        by_block.setdefault(id(claim.row.block), []).append(claim)
    found: dict[int, list[Claim]] = {}
    for display, first in pairwise(document.blocks):
        if not display.display or first.display or not _EXPLAINS.match(first.before):
            continue
        for block in document.blocks[document.blocks.index(first) :]:
            if block.display or (block is not first and ENDS_SENTENCE.search(block.before)):
                break
            found.setdefault(id(display), []).extend(by_block.get(id(block), []))
    return found


def _head(statement: Statement) -> Statement:
    while statement.follows is not None:
        statement = statement.follows
    return statement
