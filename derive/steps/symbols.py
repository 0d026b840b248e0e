"""Check the symbol of a result: its names, and whether it denotes a scalar, a vector or a tensor as the result does."""

from __future__ import annotations

from typing import Any

from sympy import MatrixBase, MatrixExpr, Symbol
from sympy.matrices.expressions import MatrixSymbol

from derive.errors import Complaint, Unverified

EMPTY = {"", "None", "True", "False"}  # texts that code may insert where an index is missing


def check_symbol(key: str, symbol: Any, result: Any) -> None:
    """Reject a symbol that no page can print, or that does not fit the kind of the result."""
    for letter in symbol.atoms(Symbol, MatrixSymbol) if hasattr(symbol, "atoms") else ():
        if not is_notation(str(letter.name)):
            raise Unverified(Complaint("unverified", f"`{key}`: {letter.name} is not a letter with indices"))
    shape = getattr(result, "shape", None)
    if isinstance(symbol, MatrixBase) and symbol.shape != shape:  # several results need several names
        raise Unverified(Complaint("unverified", f"`{key}`: {symbol} does not name each of its results"))
    if isinstance(symbol, MatrixExpr) and tuple(symbol.shape) != shape:
        what = "a vector" if symbol.shape[1] == 1 else "a tensor"
        raise Unverified(Complaint("unverified", f"`{key}`: {symbol} denotes {what}, but the result is not one"))
    if isinstance(symbol, Symbol) and shape is not None:
        raise Unverified(Complaint("unverified", f"`{key}`: {symbol} denotes a number, but the result is not one"))


def is_notation(name: str) -> bool:
    """Whether a name is a letter whose indices are not empty."""
    base, *indices = (part.rstrip("'\u2032") for part in name.split("_"))
    return base[:1].isalpha() and not EMPTY.intersection((base, *indices))
