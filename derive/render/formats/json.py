"""The data of a page for other programs, which docs/json.md describes."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.printing.contract import contract

    return contract(solution)


FORMAT = Format("json", "json", _rendered)
