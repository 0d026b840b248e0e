"""The text of a page, block by block, for programs that read its JSON (see docs/json.md).

A sentence has the equation numbers of its page, and also the keys of the equations. An additional equation changes the
numbers of all later equations, but not their keys.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from derive.page.signs import name_before, sign_behind_name
from derive.page.tree import Block, Display, Document, Folded, Illustration, Paragraph
from derive.page.wording import Inline, Ref
from derive.render.notation.layout import Layout, Operator, row
from derive.render.notation.notation import Notation
from derive.render.printing.text_page import inline_text
from derive.steps.step import Step


def named_result(step: Step, notation: Notation) -> Layout:
    """Return a result with its symbol: `T = 7/24 M a² ω²`; a relation is returned unchanged."""
    result = notation.result(step.result)
    if step.symbol is None:
        return result
    return row(notation.layout(name_before(step)), Operator(sign_behind_name(step, step.chain[-1])), result)


class Said:
    """The words of one page, as plain text."""

    def __init__(self, document: Document, notation: Notation):
        self.document, self.notation = document, notation

    def text(self, nodes: Sequence[Inline]) -> str:
        return inline_text(nodes, self.notation, self.document.numbers)

    def sentence(self, nodes: Sequence[Inline]) -> dict[str, Any]:
        """Return running text, and the keys of the equations to which it refers, in the order of the text."""
        return {"text": self.text(nodes), "refers_to": [node.key for node in nodes if isinstance(node, Ref)]}

    def blocks(self, blocks: Sequence[Block]) -> list[dict[str, Any]]:
        return [each for block in blocks for each in self._block(block)]

    def _block(self, block: Block) -> list[dict[str, Any]]:
        match block:
            case Paragraph(nodes):
                return [self.sentence(nodes)]
            case Display(groups):
                return [{"equation": group.key, "number": str(group.number)} for group in groups]
            case Illustration(key):
                return [{"drawing": key}]
            case Folded(blocks):
                return self.blocks(blocks)
