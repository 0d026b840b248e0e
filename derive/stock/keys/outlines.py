"""The drawing of a body that is described, where one can be made."""

from __future__ import annotations

from typing import Any

from derive.figures import drawing, outline
from derive.mechanics.bodies.body import EdgedBody, RoundBody
from derive.stock.keys.bodies import DescribedBody


def drawn(described: DescribedBody, answers: Any) -> None:
    """Its outline, under its name."""
    body = answers.body
    if isinstance(body, RoundBody | EdgedBody):
        drawing(described.called.replace(" ", "_") or "body", outline(body))
