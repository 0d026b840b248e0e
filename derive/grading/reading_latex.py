r"""The reading of an answer as LaTeX: `7/24 M a^2 w^2` is shown as `\frac{7}{24} M a^2 \omega^2`."""

from __future__ import annotations

from collections.abc import Callable

from derive.documents.syntax import (
    Abs,
    Add,
    Apply,
    Condition,
    Der,
    Diff,
    Frac,
    Fun,
    Group,
    Letter,
    Mat,
    Mul,
    Node,
    Num,
    Open,
    Pow,
    Root,
    Text,
    Vec,
)
from derive.documents.vocabulary import FUNCTIONS, GREEK
from derive.grading.names import INSTEAD, Names, bare

_MARKS = {"vec": r"\vec", "hat": r"\hat", "bar": r"\bar", "tilde": r"\tilde"}
RELATIONS = {"=": "=", "<": "<", ">": ">", "<=": r"\le", ">=": r"\ge", "!=": r"\ne", "~": r"\approx", ":=": "="}


def latex_of(node: Node, names: Names) -> str:
    """Return a node as LaTeX, with letters as the problem writes them."""
    return _Shown(names).of(node)


class _Shown:
    def __init__(self, names: Names):
        self.names = names

    def of(self, node: Node) -> str:
        name = f"of_{type(node).__name__.lower()}"
        method: Callable[[Node], str] = getattr(self, name, self.of_other)
        return method(node)

    def of_other(self, node: Node) -> str:
        return " ".join(self.of(kid) for kid in node.kids)

    def of_num(self, node: Num) -> str:
        return node.text

    def of_text(self, node: Text) -> str:
        return rf"\text{{{node.text}}}"

    def of_letter(self, node: Letter) -> str:
        base = node.base
        if not self.names.has(base, bare(node.sub)) and self.names.meant(node)[0] is not None:
            base = INSTEAD.get(base, base)
        shown = rf"\{base}" if base in GREEK or base in ("pi", "infty") else base
        for mark in node.marks:
            shown = f"{_MARKS.get(mark, '')}{{{shown}}}" if mark in _MARKS else shown
        if dots := node.dots + node.primes:
            shown = rf"\{'d' * (dots - 1)}dot{{{shown}}}"
        return shown + (f"_{{{_word(node.sub)}}}" if len(node.sub) > 1 else f"_{node.sub}" if node.sub else "")

    def of_add(self, node: Add) -> str:
        found = ""
        for i, (sign, term) in enumerate(node.terms):
            written = {"±": r"\pm", "∓": r"\mp"}.get(sign, sign)
            inner = self.of(term)
            inner = rf"\left({inner}\right)" if isinstance(term, Add) else inner
            found += (f" {written} " if i else "" if sign == "+" else f"{written} ".replace("- ", "-")) + inner
        return found

    def of_mul(self, node: Mul) -> str:
        found: list[str] = []
        for i, (mark, factor) in enumerate(node.factors):
            inner = self.of(factor)
            sign = {"cdot": r"\cdot", "times": r"\times"}.get(mark, "")
            if isinstance(factor, Add):
                inner = rf"\left({inner}\right)"
            if inner[:1].isdigit() and i and not sign:
                sign = r"\cdot"
            found += [sign, inner] if sign and i else [inner]
        return " ".join(found)

    def of_frac(self, node: Frac) -> str:
        return rf"\frac{{{self.bare(node.top)}}}{{{self.bare(node.bottom)}}}"

    def bare(self, node: Node) -> str:
        while isinstance(node, Group):
            node = node.inner
        return self.of(node)

    def of_pow(self, node: Pow) -> str:
        base = self.of(node.base)
        if not isinstance(node.base, Letter | Num | Group | Abs | Vec):
            base = rf"\left({base}\right)"
        exponent = self.bare(node.exponent)
        return f"{base}^{exponent}" if len(exponent) == 1 else f"{base}^{{{exponent}}}"

    def of_root(self, node: Root) -> str:
        index = f"[{self.of(node.index)}]" if node.index is not None else ""
        return rf"\sqrt{index}{{{self.bare(node.inner)}}}"

    def of_fun(self, node: Fun) -> str:
        if node.name == "degrees":
            return rf"{self.of(node.argument)}^\circ"
        if node.name == "factorial":
            return f"{self.of(node.argument)}!"
        name = rf"\{node.name}" if node.name in FUNCTIONS else rf"\operatorname{{{node.name}}}"
        power = f"^{{{self.of(node.power)}}}" if node.power is not None else ""
        argument = self.bare(node.argument)
        return f"{name}{power} {argument}" if isinstance(node.argument, Letter) else rf"{name}{power}({argument})"

    def of_apply(self, node: Apply) -> str:
        return f"{self.of(node.head)}({', '.join(map(self.of, node.arguments))})"

    def of_condition(self, node: Condition) -> str:
        return f"{self.of(node.left)} = {self.of(node.right)}"

    def of_der(self, node: Der) -> str:
        d = r"\partial" if node.partial else "d"
        order = sum(n for _, n in node.by)
        top = f"{d}^{order}" if order > 1 else d
        bottom = " ".join(f"{d}{self.of(by)}" + (f"^{n}" if n > 1 else "") for by, n in node.by)
        return rf"\frac{{{top} {self.of(node.of) if node.of is not None else ''}}}{{{bottom}}}"

    def of_diff(self, node: Diff) -> str:
        return f"d{self.of(node.of)}"

    def of_group(self, node: Group) -> str:
        inner = self.of(node.inner)
        if node.brackets == "{" or isinstance(node.inner, Letter | Num):
            return inner if not isinstance(node.inner, Add) else rf"\left({inner}\right)"
        return rf"\left({inner}\right)"

    def of_abs(self, node: Abs) -> str:
        return rf"\left|{self.of(node.inner)}\right|"

    def of_vec(self, node: Vec) -> str:
        return f"({', '.join(map(self.of, node.entries))})"

    def of_mat(self, node: Mat) -> str:
        rows = r" \\ ".join(" & ".join(map(self.of, row)) for row in node.rows)
        return rf"\begin{{pmatrix}} {rows} \end{{pmatrix}}"

    def of_open(self, node: Open) -> str:
        return self.of(node.alternatives[0])


def _word(sub: str) -> str:
    return rf"\{sub}" if sub in GREEK else sub
