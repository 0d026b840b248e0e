"""The data of a page for other programs; docs/json.md describes these data."""

from __future__ import annotations

from derive.render.formats import Format, Solution


def _rendered(solution: Solution) -> str:
    from derive.render.printing.contract import contract

    return contract(solution)


FORMAT = Format("json", "json", _rendered)
