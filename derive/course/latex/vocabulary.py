"""The known commands of LaTeX, by purpose: commands that are read, only printed, or rejected with an explanation."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sympy import Expr, acos, asin, atan, cos, cosh, cot, exp, log, sin, sinh, tan, tanh

_SMALL = """alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi rho varrho
    sigma varsigma tau upsilon phi varphi chi psi omega"""
_CAPITAL = "Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega"
GREEK_COMMANDS = frozenset([*_SMALL.split(), *_CAPITAL.split(), "ell", "hbar"])

LATEX_FUNCTIONS: Mapping[str, Callable[[Expr], Expr]] = {
    "sin": sin,
    "cos": cos,
    "tan": tan,
    "cot": cot,
    "arcsin": asin,
    "arccos": acos,
    "arctan": atan,
    "sinh": sinh,
    "cosh": cosh,
    "tanh": tanh,
    "exp": exp,
    "ln": log,
}

RELATIONS: Mapping[str, str] = {
    "=": "=",
    "<": "<",
    ">": ">",
    "\\lt": "<",
    "\\gt": ">",
    "\\le": "<=",
    "\\leq": "<=",
    "\\leqslant": "<=",
    "\\ge": ">=",
    "\\geq": ">=",
    "\\geqslant": ">=",
    "\\ne": "!=",
    "\\neq": "!=",
    "\\approx": "~",
    "\\simeq": "~",
}

RELATIONS_IN_PROSE: Mapping[str, str] = {**RELATIONS, "\\ll": "<<", "\\gg": ">>", "\\to": "->"}
FRACTIONS = frozenset(["frac", "tfrac", "dfrac", "cfrac"])
DOTS: Mapping[str, int] = {"dot": 1, "ddot": 2}
ARROW_COMMANDS = frozenset(["vec", "overrightarrow"])
BOLD_COMMANDS = frozenset(["boldsymbol", "bm", "mathbf", "bf"])
FONTS = frozenset(["mathrm", "mathit", "mathsf", "operatorname", "mathnormal"])
DECORATIONS = ARROW_COMMANDS | BOLD_COMMANDS | FONTS | {"hat"}
WORDS = frozenset(["text", "textrm", "textit", "mbox"])

MATRICES = frozenset(["pmatrix", "bmatrix", "matrix", "array", "Bmatrix", "smallmatrix"])
ALIGNMENTS = frozenset(["aligned", "align", "align*", "split", "equation", "equation*", "gathered", "alignedat"])

# commands that are ignored, because they change only the look of a formula
SPACES = frozenset(
    [",", "!", ";", ":", " ", ">", "quad", "qquad", "thinspace", "enspace", "limits", "nolimits", "displaystyle"]
    + ["textstyle", "scriptstyle", "mathopen", "mathclose", "mathord", "nonumber", "notag", "rm", "it", "\n", "/"]
)
SIZES = frozenset(f"{size}{side}" for size in ("big", "Big", "bigg", "Bigg") for side in ("", "l", "r", "m"))

OPENING: Mapping[str, str] = {"(": ")", "[": "]", "{": "}", "|": "|", ".": "|", "lvert": "|", "lbrace": "}"}
CLOSING: Mapping[str, str] = {")": ")", "]": "]", "}": "}", "|": "|", "rvert": "|", "rbrace": "}", ".": "."}

INSTEAD: Mapping[str, str] = {
    "·": "\\cdot",
    "×": "\\times",
    "⋅": "\\cdot",
    "−": "-",
    "–": "-",
    "²": "^2",
    "³": "^3",
    "√": "\\sqrt{...}",
    "≤": "\\le",
    "≥": "\\ge",
    "≠": "\\ne",
    "≈": "\\approx",
    "±": "\\pm",
    "∓": "\\mp",
    "°": "^\\circ",
    "∫": "\\int",
    "′": "\\dot{...}",
}
REFUSED: Mapping[str, tuple[str, str | None]] = {
    "log": ("the base of `\\log` is not clear", "write `\\ln`"),
    "tag": ("an equation number is not part of the equation", "leave it out"),
    "label": ("a label is not part of the equation", "leave it out"),
    "sec": ("`\\sec` cannot be read", "write `1/\\cos`"),
    "csc": ("`\\csc` cannot be read", "write `1/\\sin`"),
    "iint": ("a multiple integral sign cannot be read", "write one `\\int` with limits for each variable"),
    "iiint": ("a multiple integral sign cannot be read", "write one `\\int` with limits for each variable"),
    "oint": ("an integral without limits cannot be read", None),
    "sum": ("a sum over an index cannot be read", "write its terms"),
    "Rightarrow": ("only one formula can be read at a time", None),
    "implies": ("only one formula can be read at a time", None),
    "ldots": ("an ellipsis cannot be read", "write out what the ellipsis stands for"),
    "cdots": ("an ellipsis cannot be read", "write out what the ellipsis stands for"),
    "dots": ("an ellipsis cannot be read", "write out what the ellipsis stands for"),
}

# commands that prose and quotations may contain, although the grammar does not read them
ONLY_PRINTED = frozenset(
    ["iint", "iiint", "oint", "sum", "prod", "cdots", "ldots", "min", "max", "lim", "propto", "equiv", "sim", "in"]
    + ["Rightarrow", "perp", "parallel", "angle", "nabla", "langle", "rangle", "bar", "tilde"]
)

# the arguments of a command: `{` is an argument in braces, `[` is an optional argument in brackets
ARGUMENTS: Mapping[str, str] = {
    "sqrt": "[{",
    **dict.fromkeys(FRACTIONS, "{{"),
    **dict.fromkeys([*DOTS, *DECORATIONS, *WORDS], "{"),
}
KNOWN = frozenset(
    [*GREEK_COMMANDS, *LATEX_FUNCTIONS, *ARGUMENTS, *(mark[1:] for mark in RELATIONS if mark[0] == "\\")]
    + ["pi", "cdot", "times", "pm", "mp", "int", "left", "right", "circ", "lvert", "rvert", "lbrace", "rbrace"]
    + ["imath", "jmath", "partial", "prime", "ll", "gg", "to", "infty"]
)
