"""Formulas as lists of numerical operations on complex numbers.

The derivative of a formula f at q is the imaginary part of f(q + ih), divided by a very small h (a complex step).

Equal parts of formulas are computed once. Operations on constants are evaluated when numbers replace the symbols; the
others are evaluated for a whole array of points at a time.

Source: Squire, Trapp, *SIAM Review* 40 (1998), 110 (derivatives by complex steps).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from random import Random
from typing import Any, TypeAlias
from zlib import crc32

import numpy as np
from numpy.typing import NDArray
from sympy import (
    Abs,
    Add,
    Expr,
    Mul,
    Pow,
    Rational,
    Symbol,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    exp,
    log,
    sign,
    sin,
    sinh,
    tan,
    tanh,
)

from derive.algebra.expressions import TIME, Prescribed, explicit
from derive.algebra.ordered_roots import OrderedRoot
from derive.algebra.ranges import POSITIVE, range_of

Numbers: TypeAlias = NDArray[np.complex128]
Operation: TypeAlias = tuple[Callable[..., Any], tuple[int, ...]]

LARGEST = 20_000  # largest number of nodes of a `Tape`


class NotComputable(Exception):
    """The witness cannot compute a value, for example of a function that is not in `FUNCTIONS`."""


def _absolute(x: Any) -> Any:
    return x * np.sign(np.real(x))


def _angle(y: Any, x: Any) -> Any:
    """The angle of the vector (x, y). Its imaginary part is the derivative of the angle along a complex step."""
    whole = np.arctan2(np.real(y), np.real(x))
    square = np.real(x) ** 2 + np.real(y) ** 2
    return whole + 1j * (np.imag(y) * np.real(x) - np.imag(x) * np.real(y)) / square


FUNCTIONS: Mapping[Any, Callable[..., Any]] = {
    sin: np.sin,
    cos: np.cos,
    tan: np.tan,
    sinh: np.sinh,
    cosh: np.cosh,
    tanh: np.tanh,
    asin: np.arcsin,
    acos: np.arccos,
    atan: np.arctan,
    atan2: _angle,
    exp: np.exp,
    log: np.log,
    Abs: _absolute,
    sign: lambda x: np.sign(np.real(x)) + 0j,
}


def _root_in_order(number: int, *coefficients: Any) -> Any:
    """Return, at each point, one root of a polynomial whose roots are all real; root 1 is the smallest."""
    rows = np.stack(np.broadcast_arrays(*map(np.asarray, coefficients)), axis=-1)
    found = [np.sort(np.roots(np.real(row)).real)[number - 1] for row in rows.reshape(-1, rows.shape[-1])]
    return np.asarray(found, dtype=complex).reshape(rows.shape[:-1])


def tested_by(prescribed: Prescribed) -> Callable[..., Any]:
    """Return a definite function of time that replaces a prescribed function X(t) or one of its derivatives.

    X(t) is replaced by c + A sin(w t + p) + B sin(v t + q). The numbers follow from the name of X, and the values are
    in the range of X. An equation of motion is unlikely to have this function as a solution by accident.
    """
    own, source = prescribed.function, Random(crc32(prescribed.function.name.encode()))
    known = range_of(own) or (POSITIVE if own.is_positive else None)
    middle = float(known.at(Rational(1, 2))) if known else source.uniform(-1, 1)
    ends = [end for end in (known.least, known.greatest) if end.is_finite] if known else []
    room = min([0.8, *(abs(float(end) - middle) for end in ends)])
    swings = [(room * source.uniform(0.2, 0.45), source.uniform(0.5, 1.5), source.uniform(0, 6)) for _ in range(2)]
    n = prescribed.order

    def value(t: Any) -> Any:
        whole = sum(size * w**n * np.sin(w * t + p + n * np.pi / 2) for size, w, p in swings)
        return whole + (middle if n == 0 else 0.0)

    return value


class Tape:
    """Formulas as operations.

    inputs   the symbols whose values vary from point to point

    All other symbols are constants, except prescribed functions: `tested_by` gives a definite function for each.
    """

    def __init__(self, formulas: Sequence[Any], inputs: Sequence[Symbol]):
        self.inputs = tuple(inputs)
        self._nodes: list[Operation | complex | Symbol] = []
        self._known: dict[Any, int] = {}
        self._of_inputs = [self._letter(letter) for letter in self.inputs]
        self._outputs = [self._node(explicit(each)) for each in formulas]

    @property
    def letters(self) -> set[Symbol]:
        """The constants that need numbers."""
        return {node for node in self._nodes if isinstance(node, Symbol)} - set(self.inputs)

    def bound(self, numbers: Mapping[Symbol, float]) -> Compiled:
        """Substitute a number for each constant, and return the operations that remain. Raises `NotComputable` if a
        constant has no number."""
        values: list[complex | None] = []
        varying: list[tuple[int, Callable[..., Any], tuple[int, ...]]] = []
        inputs = set(self._of_inputs)
        for i, node in enumerate(self._nodes):
            if i in inputs:
                values.append(None)
            elif isinstance(node, Symbol):
                if node not in numbers:
                    raise NotComputable(node.name)
                values.append(complex(numbers[node]))
            elif isinstance(node, complex):
                values.append(node)
            else:
                operation, args = node
                given = [values[j] for j in args]
                if any(each is None for each in given):
                    varying.append((i, operation, args))
                    values.append(None)
                else:
                    with np.errstate(all="ignore"):
                        values.append(complex(operation(*given)))
        return Compiled(values, varying, self._of_inputs, self._outputs)

    def _letter(self, letter: Symbol) -> int:
        return self._added(letter, letter)

    def _added(self, of: Any, node: Operation | complex | Symbol) -> int:
        if len(self._nodes) >= LARGEST:
            raise NotComputable("the formulas are too long")
        self._nodes.append(node)
        self._known[of] = len(self._nodes) - 1
        return self._known[of]

    def _node(self, formula: Expr) -> int:
        known = self._known.get(formula)
        if known is not None:
            return known
        if isinstance(formula, Prescribed):
            if TIME not in self.inputs:
                raise NotComputable(formula.name)
            return self._added(formula, (tested_by(formula), (self._node(TIME),)))
        if isinstance(formula, Symbol):
            return self._letter(formula)
        if formula.is_Number or formula.is_NumberSymbol or formula.is_number and not formula.args:
            return self._added(formula, complex(formula))
        of = formula.args[0] if isinstance(formula, OrderedRoot) else formula.args
        args = tuple(self._node(arg) for arg in of)
        return self._added(formula, self._operation(formula, args))

    def _operation(self, formula: Expr, args: tuple[int, ...]) -> Operation:
        if isinstance(formula, Add | Mul):
            operation = np.add if isinstance(formula, Add) else np.multiply
            last = args[0]
            for arg in args[1:-1]:
                last = self._added((formula, last, arg), (operation, (last, arg)))
            return operation, (last, args[-1])
        if isinstance(formula, Pow):
            return self._power(formula, args)
        if isinstance(formula, OrderedRoot):
            return partial(_root_in_order, int(formula.args[1])), args
        function = FUNCTIONS.get(formula.func)
        if function is None:
            raise NotComputable(type(formula).__name__)
        return function, args

    def _power(self, formula: Pow, args: tuple[int, ...]) -> Operation:
        exponent = formula.exp
        if exponent.is_Integer and abs(int(exponent)) <= 64:
            n = int(exponent)
            return (lambda x: x**n), args[:1]
        if exponent.is_Rational and exponent.q == 2 and exponent.p in (1, -1):
            return (np.sqrt if exponent.p == 1 else lambda x: 1 / np.sqrt(x)), args[:1]
        return np.power, args


class Compiled:
    """The operations of a tape, with numbers for its constants."""

    def __init__(
        self,
        values: Sequence[complex | None],
        varying: Sequence[tuple[int, Callable[..., Any], tuple[int, ...]]],
        inputs: Sequence[int],
        outputs: Sequence[int],
    ):
        self._values, self._varying = values, varying
        self._inputs, self._outputs = inputs, outputs

    def __call__(self, points: Numbers) -> Numbers:
        """The value of each formula at each point.

        Columns are points; the rows of `points` are inputs, and the rows of the result are formulas.
        """
        values: list[Any] = list(self._values)
        for i, row in zip(self._inputs, points, strict=True):
            values[i] = row
        with np.errstate(all="ignore"):
            for i, operation, args in self._varying:
                if len(args) == 2:  # faster than the general line below
                    one, other = args
                    values[i] = operation(values[one], values[other])
                else:
                    values[i] = operation(*[values[j] for j in args])
        count = points.shape[1]
        found = np.empty((len(self._outputs), count), dtype=np.complex128)
        for k, i in enumerate(self._outputs):
            found[k] = values[i]
        return found
