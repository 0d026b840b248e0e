r"""The commands of LaTeX that the parser knows, sorted by what they mean."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


GREEK = _words(
    "varphi varepsilon varrho varsigma varpi imath jmath wp digamma hslash phi epsilon vartheta theta hbar ell "
    "Delta Gamma Lambda Omega Phi Pi Psi Sigma Theta Xi alpha beta chi delta eta gamma iota kappa lambda mu nu omega "
    "pi psi rho sigma tau upsilon xi zeta"
)
SAME_LETTER = {
    "varphi": "phi",
    "varepsilon": "epsilon",
    "vartheta": "theta",
    "imath": "i",
    "jmath": "j",
    "hslash": "hbar",
}
FUNCTIONS = _words(
    "sin cos tan cot sec csc arcsin arccos arctan arccot sinh cosh tanh coth sech csch arcsinh arccosh arctanh asin "
    "acos atan ln log exp sgn sign det tr Tr min max arg cosec Re Im arsinh arcosh artanh"
)
# Functions that some authors write without a backslash: `arccos(x)`.
BARE_FUNCTIONS = _words("arcsin arccos arctan sinh cosh tanh sin cos tan cot exp log ln")
DOTS = {"dot": 1, "ddot": 2, "dddot": 3, "ddddot": 4}
MARKS = {
    "vec": "vec", "overrightarrow": "vec", "va": "vec", "underline": "vec", "hat": "hat", "widehat": "hat", "vu": "hat",
    "bar": "bar", "overline": "bar", "tilde": "tilde", "widetilde": "tilde", "boldsymbol": "vec", "mathbf": "vec",
    "bm": "vec", "vb": "vec", "vect": "vec", "vv": "vec", "mat": "vec", "uv": "hat",
    "unitvec": "hat", "pmb": "vec", "bold": "vec", "mathcal": "cal", "mathscr": "cal", "mathfrak": "frak",
    "mathbb": "bb", "check": "check", "breve": "breve", "overleftrightarrow": "tensor", "bf": "vec", "uvec": "hat",
    "uvect": "hat", "vectorbold": "vec", "vectorarrow": "vec", "vectorunit": "hat",
}  # fmt: skip
TEXTS = _words(
    "text textrm mathrm rm textit mathit mbox operatorname operatorname* textbf textnormal mathsf textsf hbox symrm "
    "symup mathup"
)
IGNORED = _words(
    ", ; : ! > thinspace medspace thickspace negthinspace quad qquad hfill displaystyle textstyle scriptstyle "
    "scriptscriptstyle limits nolimits nonumber notag big Big bigg Bigg bigl Bigl biggl Biggl bigr Bigr biggr Biggr "
    "bigm Bigm middle mathstrut strut allowbreak nobreak break relax vphantom kern unboldmath protect noindent "
    "boldmath mathord mathbin mathrel mathopen mathclose mathpunct mathinner mathop normalsize small large it up "
    "mathnormal qedhere"
)
IGNORED_WITH_ARGUMENT = _words(
    "vphantom hspace vspace phantom hphantom label tag color textcolor hskip ref eqref cite footnote"
)
DECORATED = _words(
    "underbrace overbrace boxed fbox cancel bcancel xcancel ensuremath mathchoice colorbox underbracket smash emph hl "
    "tightboxed Aboxed framebox raisebox"
)
OPENERS = {"(": ")", "[": "]", "{": "}", "lbrace": "}", "langle": ">", "lvert": "|", "lVert": "|", "|": "|", "<": ">",
           "lbrack": "]", "lfloor": "]", "lceil": "]", ".": ".", "Vert": "|", "vert": "|"}  # fmt: skip
CLOSERS = {")": ")", "]": "]", "}": "}", "rbrace": "}", "rangle": ">", "rvert": "|", "rVert": "|", "|": "|", ">": ">",
           "rbrack": "]", "rfloor": "]", "rceil": "]", ".": ".", "Vert": "|", "vert": "|"}  # fmt: skip
INTEGRALS = {"int": 1, "iint": 2, "iiint": 3, "oint": 1, "intop": 1, "idotsint": 1, "oiint": 2}
MATRICES = _words("matrix pmatrix bmatrix Bmatrix vmatrix Vmatrix smallmatrix array psmallmatrix")
ELLIPSES = _words("ldots cdots dots dotsb vdots ddots dotsm dotsc")
# Commands that many authors define in the same way; a definition in the document itself takes precedence.
DIFFERENTIALS = _words("dd diff differential d dif ud mathd")
IMAGINARY = _words("I ii iu")
AVERAGES = _words("braket ev expval mean avg expectationvalue ket bra mel innerproduct ip")
FREQUENT_DERIVATIVES = _words(
    "dv pdv derivative pderivative odv fdv deriv pd od pdiff pder pderiv parder partialderivative"
)
# The commands of the package siunitx, as units and as the signs between units.
UNIT_COMMANDS = {
    "newton": "N", "meter": "m", "metre": "m", "second": "s", "kilogram": "kg", "gram": "g", "joule": "J", "watt": "W",
    "radian": "rad", "hertz": "Hz", "pascal": "Pa", "kelvin": "K", "ampere": "A", "minute": "min", "hour": "h",
    "degree": "deg", "kilo": "k", "centi": "c", "milli": "m", "mega": "M", "per": "/", "squared": "^2", "cubed": "^3",
}  # fmt: skip
UNIT_WORDS = _words("sec min rad rpm RPM rev deg kg cm mm km ms Hz kHz hr yr mol Pa")
