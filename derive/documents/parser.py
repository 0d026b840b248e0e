r"""The tokens of one side of a statement as nodes: a recursive descent through sums, products, factors and scripts."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from derive.documents.macros import argument_at
from derive.documents.source import Span
from derive.documents.syntax import (
    Abs,
    Add,
    Apply,
    Cases,
    Condition,
    Der,
    Diff,
    EvalBar,
    Frac,
    Fun,
    Group,
    Int,
    Letter,
    Mat,
    Mul,
    Nabla,
    Node,
    Num,
    Open,
    Pow,
    Root,
    Sign,
    Sum,
    Text,
    Vec,
)
from derive.documents.tokens import Kind, Token, tokens_of, without_spaces
from derive.documents.vocabulary import (
    AVERAGES,
    BARE_FUNCTIONS,
    DECORATED,
    DIFFERENTIALS,
    DOTS,
    ELLIPSES,
    FREQUENT_DERIVATIVES,
    FUNCTIONS,
    GREEK,
    IGNORED,
    IGNORED_WITH_ARGUMENT,
    IMAGINARY,
    INTEGRALS,
    MARKS,
    MATRICES,
    OPENERS,
    SAME_LETTER,
    TEXTS,
    UNIT_COMMANDS,
    UNIT_WORDS,
)
from derive.units import UNIT_NAMES

DEEPEST = 60


class Unreadable(Exception):
    """A side cannot be read; `span` is the place in the tidied text."""

    def __init__(self, message: str, span: Span):
        super().__init__(message)
        self.message, self.span = message, span


def parsed(tokens: Sequence[Token]) -> Node:
    """Return the node of one side of a statement."""
    reader = _Reader(without_spaces(list(tokens)))
    if not reader.tokens:
        raise Unreadable("this side is empty", Span(0, 0))
    return reader.whole()


class _Reader:
    def __init__(self, tokens: list[Token], depth: int = 0):
        self.tokens, self.at, self.depth = _without_empty_braces(tokens), 0, depth
        self.in_integral = False
        if depth > DEEPEST:
            raise Unreadable(f"this formula is nested more than {DEEPEST} levels deep", tokens[0].span)

    # The next token

    def peek(self, ahead: int = 0) -> Token | None:
        at = self.at + ahead
        return self.tokens[at] if at < len(self.tokens) else None

    def needed(self) -> Token:
        if self.at >= len(self.tokens):
            raise Unreadable("something is missing here", self.tokens[-1].span if self.tokens else Span(0, 0))
        return self.tokens[self.at]

    def skip_spacing(self) -> None:
        while (token := self.peek()) is not None and token.kind is Kind.COMMAND:
            if token.text in IGNORED or token.text == " ":
                self.at += 1
            elif token.text in IGNORED_WITH_ARGUMENT:
                self.at = argument_at(self.tokens, self.at + 1)[1]
            elif token.text == "rule":  # \rule[-1em]{0pt}{2em}, which increases the height of a row
                self.at += 1
                if self.next_is_mark("["):
                    close = next((i for i in range(self.at, len(self.tokens)) if self.tokens[i].is_mark("]")), self.at)
                    self.at = close + 1
                for _ in range(2):
                    self.at = argument_at(self.tokens, self.at)[1]
            else:
                break

    def next_is_mark(self, *marks: str) -> bool:
        token = self.peek()
        return token is not None and token.is_mark(*marks)

    def next_is(self, *names: str) -> bool:
        token = self.peek()
        return token is not None and token.is_command(*names)

    def argument(self) -> list[Token]:
        """Return the tokens of the next argument. As in TeX, only the first digit of a number without braces is the
        argument."""
        self.skip_spacing()
        token = self.peek()
        if token is None:
            raise Unreadable("an argument is missing", self.tokens[-1].span if self.tokens else Span(0, 0))
        if token.kind is Kind.NUMBER and len(token.text) > 1:
            at = token.span.start
            self.tokens[self.at : self.at + 1] = [
                replace(token, text=digit, span=Span(at + i, at + i + 1) if not token.origin else token.span)
                for i, digit in enumerate(token.text)
            ]
            token = self.tokens[self.at]
        if token.kind is Kind.COMMAND and token.text in {*DOTS, *MARKS, *TEXTS, "frac", "sqrt"}:
            begins = self.at
            self.at += 1
            for _ in range(2 if token.text == "frac" else 1):
                _, self.at = argument_at(self.tokens, self.at)
            return self.tokens[begins : self.at]
        value, self.at = argument_at(self.tokens, self.at)
        return value

    def inside(self, tokens: list[Token], span: Span) -> Node:
        if not tokens:
            raise Unreadable("something is missing here", span)
        reader = _Reader(tokens, self.depth + 1)
        reader.in_integral = self.in_integral
        node = reader.whole()
        return node

    def whole(self) -> Node:
        if over := next((i for i, each in self.outside() if each.is_command("over", "atop")), None):
            top, bottom = self.tokens[:over], self.tokens[over + 1 :]
            span = self.tokens[0].span.to(self.tokens[-1].span)
            return self.fraction(top, bottom, span)
        node = self.sum()
        if self.at < len(self.tokens):
            token = self.tokens[self.at]
            shown = ("\\" if token.kind is Kind.COMMAND else "") + token.text
            raise Unreadable(f"`{shown}` was not expected here", token.span)
        return node

    def outside(self) -> list[tuple[int, Token]]:
        found, depth = [], 0
        for i, token in enumerate(self.tokens):
            depth += (token.kind is Kind.OPEN) - (token.kind is Kind.CLOSE)
            depth += token.is_command("left", "begin") - token.is_command("right", "end")
            if depth == 0:
                found.append((i, token))
        return found

    # Sums and products

    def sum(self) -> Node:
        self.skip_spacing()
        terms: list[tuple[str, Node]] = []
        begins = self.peek()
        sign = self.sign() or "+"
        first_sign = sign
        while True:
            self.skip_spacing()
            term = self.product()
            terms.append((sign, term))
            self.skip_spacing()
            new_sign = self.sign()
            if new_sign is None:
                break
            sign = new_sign
        if len(terms) == 1 and first_sign == "+":
            return terms[0][1]
        assert begins is not None
        return Add(begins.span.to(terms[-1][1].span), tuple(terms))

    def sign(self) -> str | None:
        """Return the next sign, or None; several signs in a row are combined."""
        sign = None
        while (token := self.peek()) is not None:
            if token.is_mark("+", "-"):
                new = token.text
            elif token.is_command("pm", "mp"):
                new = "±" if token.text == "pm" else "∓"
            else:
                break
            sign = new if sign in (None, "+") else {"-": {"-": "+", "+": "-"}.get(new, new)}.get(str(sign), sign)
            self.at += 1
            self.skip_spacing()
        return sign

    def product(self) -> Node:
        factors: list[tuple[str, Node]] = []
        mark = ""
        while True:
            self.skip_spacing()
            token = self.peek()
            if token is None:
                break
            if token.is_command("cdot", "times", "ast", "wedge", "vdot", "cross", "bullet", "star") or token.is_mark(
                "*"
            ):
                if not factors:
                    raise Unreadable("a factor is missing before this sign", token.span)
                mark = {"times": "times", "cross": "times", "wedge": "times"}.get(token.text, "cdot")
                self.at += 1
                self.skip_spacing()
                if (sign := self.sign()) is not None:  # `a \cdot -b`
                    factor = self.factor()
                    factors.append((mark, Add(factor.span, ((sign, factor),))))
                    mark = ""
                    continue
                if self.ends():
                    raise Unreadable("a factor is missing after this sign", token.span)
                continue
            if (token.is_mark("/") or token.is_command("div", "slash")) and factors:
                self.at += 1
                self.divide(factors)
                continue
            if self.ends():
                if self.is_bar_with_limits() and factors:
                    factors = [("", self.evaluated(_product(factors)))]
                    continue
                break
            factor = self.factor()
            if isinstance(factor, Der) and factor.of is None:
                factor = self.with_operand(factor)
            factors.append((mark, factor))
            mark = ""
        if not factors:
            token = self.peek()
            span = token.span if token else (self.tokens[-1].span if self.tokens else Span(0, 0))
            raise Unreadable("a term is missing here", span)
        return _product(factors)

    def ends(self) -> bool:
        token, rest = self.peek(), self.tokens[self.at : self.at + 4]
        if token is None or (len(rest) < 4 and all(each.is_command(*IGNORED) for each in rest)):
            return True  # only ignored commands follow, such as \bigr or \notag
        if token.kind in (Kind.CLOSE, Kind.CELL):
            return True
        if token.kind is Kind.MARK:
            return not (token.text in "([|?" and not (token.text == "|" and self.bar_closes()))
        if token.is_command("eval"):
            return self.is_bar_with_limits()
        return token.is_command("right", "}", "rbrace", "rangle", "rvert", "rVert", "end", "pm", "mp", "\\")

    bars = 0

    def bar_closes(self) -> bool:
        return self.bars > 0 or self.is_bar_with_limits()

    def is_bar_with_limits(self) -> bool:
        token, after = self.peek(), self.peek(1)
        bar = token is not None and (token.is_mark("|") or token.is_command("vert", "|", "eval"))
        return bar and after is not None and after.kind is Kind.SCRIPT and self.bars == 0

    def evaluated(self, inner: Node) -> Node:
        self.at += 1
        lower, upper = self.scripts()
        return EvalBar(inner.span, inner, lower, upper)

    def scripts(self) -> tuple[Node | None, Node | None]:
        lower = upper = None
        while (token := self.peek()) is not None and token.kind is Kind.SCRIPT:
            self.at += 1
            node = self.limit(self.argument(), token.span)
            lower, upper = (node, upper) if token.text == "_" else (lower, node)
        return lower, upper

    def limit(self, tokens: list[Token], span: Span) -> Node:
        """Return a limit, such as `h`, or a condition, such as `z = h`."""
        tokens = without_spaces(tokens)
        equals = _equals_sign(tokens)
        if equals:
            tokens = _split(tokens, lambda each: each.is_mark(";"))[0] or tokens  # `j = 1; j \ne i`
            letters = _split(tokens[:equals], lambda each: each.is_mark(","))
            if len(letters) > 1 and all(letters):
                left: Node = Vec(span, tuple(self.inside(each, span) for each in letters))
            else:
                left = self.inside(tokens[:equals], span)
            right = self.inside(tokens[equals + 1 :], span)
            return Condition(left.span.to(right.span), left, right)
        letters = _split(tokens, lambda each: each.is_mark(","))
        try:
            if len(letters) > 1 and all(len(each) == 1 for each in letters):
                return Vec(span, tuple(self.inside(each, span) for each in letters))  # `\sum_{i,j}`
            return self.inside(tokens, span)
        except Unreadable:
            return Text(span, "".join(each.text for each in tokens))

    def divide(self, factors: list[tuple[str, Node]]) -> None:
        """Read the denominator after a slash; if several factors follow, keep both readings, `(a/b)c` and `a/(bc)`."""
        self.skip_spacing()
        if self.divided_differentials(factors):
            return
        top = _product(factors)
        if self.ends():
            raise Unreadable("a denominator is missing here", self.tokens[min(self.at, len(self.tokens) - 1)].span)
        first = self.factor()
        run = [first]
        while not self.ends():
            self.skip_spacing()
            token = self.peek()
            if token is None or token.is_command("cdot", "times", "div") or token.is_mark("/", "*"):
                break
            if isinstance(first, Group):
                break
            run.append(self.factor())
        near = Frac(top.span.to(first.span), top, first)
        if len(run) == 1:
            factors[:] = [("", near)]
            return
        # a function after other factors is not in the denominator: `g/l \sin x` is g/l times the sine
        end = next((at for at, each in enumerate(run) if at and isinstance(each, Fun)), len(run))
        rest: list[tuple[str, Node]] = [("", each) for each in run]
        span = top.span.to(run[-1].span)
        below = Frac(top.span.to(run[end - 1].span), top, _product(rest[:end]))
        readings = Mul(span, (("", near), *rest[1:])), _product([("", below), *rest[end:]])
        factors[:] = [("", readings[0] if end == 1 else Open(span, "slash", readings))]

    def divided_differentials(self, factors: list[tuple[str, Node]]) -> bool:
        r"""Read the denominator of `\partial f/\partial x` or `df/dt`, if a differential is before the slash."""
        mark, top = factors[-1]
        differential = top.alternatives[0] if isinstance(top, Open) and top.kind == "letter d" else top
        if not isinstance(differential, Diff):
            return False
        begins = self.at
        by: list[tuple[Node, int]] = []
        while not self.ends() and (self.next_is("partial") if differential.partial else self.is_differential()):
            bottom: Node = self.factor()
            if isinstance(bottom, Open) and bottom.kind == "letter d":
                bottom = bottom.alternatives[0]
            order = 1
            exponent = bottom.exponent if isinstance(bottom, Pow) else None
            if isinstance(bottom, Pow) and isinstance(exponent, Num) and exponent.text.isdigit():
                bottom, order = bottom.base, int(exponent.text)
            if not isinstance(bottom, Diff) or bottom.partial != differential.partial or order > 9:
                break
            by.append((bottom.of, order))
            if not differential.partial:
                break
        if not by:
            self.at = begins
            return False
        alone = isinstance(differential.of, Text)
        made = Der(top.span.to(by[-1][0].span), differential.partial, tuple(by), None if alone else differential.of)
        factors[-1] = (mark, self.with_operand(made) if alone else made)
        return True

    def with_operand(self, operator: Der) -> Node:
        """Return a derivative whose operand is the bracket after it or, without a bracket, the rest of the product."""
        self.skip_spacing()
        if self.ends():
            return operator
        token = self.peek()
        if token is not None and (token.is_mark("(", "[") or token.is_command("left", "{")):
            operand = self.factor()
        else:
            factors: list[tuple[str, Node]] = []
            while not self.ends():
                self.skip_spacing()
                token = self.peek()
                if token is None or token.is_mark("/") or self.ends():
                    break
                mark = ""
                if token.is_command("cdot", "times"):
                    mark = token.text
                    self.at += 1
                    self.skip_spacing()
                    if self.ends():
                        break
                factor = self.factor()
                if isinstance(factor, Der) and factor.of is None:
                    factor = self.with_operand(factor)
                factors.append((mark, factor))
            operand = _product(factors)
        return replace(operator, of=operand, span=operator.span.to(operand.span))

    # Factors

    def factor(self) -> Node:
        """Return a differential, an atom with its scripts and primes, or a letter with the bracket after it."""
        self.skip_spacing()
        token = self.peek()
        if token is None:
            raise Unreadable("a factor is missing here", self.tokens[-1].span)
        if self.is_differential():
            return self.differential()
        atom = self.atom()
        node = self.scripted(atom)
        if isinstance(node, Letter) and self.next_is("!"):  # `U\!\left(`
            self.skip_spacing()
        if isinstance(node, Letter) and self.opens_bracket():
            return self.maybe_applied(node)
        if isinstance(node, Pow) and isinstance(node.base, Letter) and self.opens_bracket() and self.is_call():
            applied = self.maybe_applied(node.base)
            if isinstance(applied, Apply):
                return Pow(node.span.to(applied.span), applied, node.exponent)
            return Mul(node.span.to(applied.span), (("", node), ("", self.second(applied))))
        return node

    @staticmethod
    def second(applied: Node) -> Node:
        """Return the bracket in a node of `maybe_applied`, so that it can be a factor of a product."""
        product = applied.alternatives[1] if isinstance(applied, Open) else applied
        return product.factors[1][1] if isinstance(product, Mul) else product

    def is_call(self) -> bool:
        """Whether the bracket that follows contains a comma: `f^2(x, y)`."""
        depth = 0
        for token in self.tokens[self.at :]:
            depth += token.is_mark("(") - token.is_mark(")")
            if depth == 0:
                return False
            if depth == 1 and token.is_mark(","):
                return True
        return False

    def opens_bracket(self) -> bool:
        token, after = self.peek(), self.peek(1)
        if token is None:
            return False
        if token.is_mark("[") and self.at and self.tokens[self.at - 1].kind is not Kind.CLOSE:
            return self.closes_after_letter()  # a functional: `S[q]`
        return token.is_mark("(") or (token.is_command("left") and after is not None and after.is_mark("("))

    def closes_after_letter(self) -> bool:
        """Whether square brackets contain one letter with its marks and scripts."""
        close = next((i for i in range(self.at, len(self.tokens)) if self.tokens[i].is_mark("]")), 0)
        inner = self.tokens[self.at + 1 : close]
        if not inner or len(inner) > 8 or any(each.kind is Kind.MARK for each in inner):
            return False
        try:
            return isinstance(self.inside(inner, inner[0].span), Letter)
        except Unreadable:
            return False

    def maybe_applied(self, head: Letter) -> Node:
        group = self.bracketed()
        inner = group.entries if isinstance(group, Vec) else (group.inner,) if isinstance(group, Group) else None
        if inner is None:
            return Mul(head.span.to(group.span), (("", head), ("", self.scripted(group))))
        applied = Apply(head.span.to(group.span), head, inner)
        if isinstance(group, Vec) or isinstance(inner[0], Condition):
            return self.scripted(applied)
        begins = self.at
        as_function = self.scripted(applied)
        self.at = begins
        as_product = self.scripted(group)
        span = head.span.to(as_product.span)
        return Open(span, "apply", (as_function, Mul(span, (("", head), ("", as_product)))))

    def is_differential(self) -> bool:
        """Whether `d`, or a command for it, begins a differential. Outside of an integral, a plain `d` has two
        readings."""
        token = self.peek()
        if token is None:
            return False
        if token.is_command(*DIFFERENTIALS):
            return not self.has_two_groups(1)
        upright = token.is_command("mathrm", "rm", "text", "operatorname") and self.word_at(1) == "d"
        plain = token.kind is Kind.LETTER and token.text == "d"
        if not (upright or plain):
            return False
        after_at = argument_at(self.tokens, self.at + 1)[1] if upright and token.text != "rm" else self.at + 1
        if upright and token.text == "rm":
            after_at += 1
        after = self.tokens[after_at] if after_at < len(self.tokens) else None
        while after is not None and after.is_command(",", "!", ";"):
            after_at += 1
            after = self.tokens[after_at] if after_at < len(self.tokens) else None
        if after is None:
            return False
        if after.kind is Kind.SCRIPT and after.text == "^" and (self.in_integral or upright):
            return True  # d^3 r
        letter = after.kind is Kind.LETTER or (
            after.kind is Kind.COMMAND and (after.text in GREEK or after.text in MARKS or after.text in DOTS)
        )
        return letter and (upright or self.in_integral or after.kind is Kind.COMMAND or after.text != "d")

    def has_two_groups(self, ahead: int = 0) -> bool:
        at = self.at + ahead
        if at >= len(self.tokens) or self.tokens[at].kind is not Kind.OPEN:
            return False
        _, after = argument_at(self.tokens, at)
        return after < len(self.tokens) and self.tokens[after].kind is Kind.OPEN

    def word_at(self, ahead: int) -> str:
        value, _ = argument_at(self.tokens, self.at + ahead)
        return "".join(each.text for each in value if each.kind is not Kind.SPACE)

    def differential(self) -> Node:
        token = self.tokens[self.at]
        self.at += 1
        plain = token.kind is Kind.LETTER
        if not plain and token.text not in DIFFERENTIALS:
            _, self.at = argument_at(self.tokens, self.at)
        order = 1
        if (script := self.peek()) is not None and script.kind is Kind.SCRIPT and script.text == "^":
            self.at += 1
            raised = self.argument()
            order = int(raised[0].text) if len(raised) == 1 and raised[0].text.isdigit() else 1
        if token.text in DIFFERENTIALS and (brace := self.peek()) is not None and brace.kind is Kind.OPEN:
            of = self.inside(self.argument(), token.span)
        else:
            self.skip_spacing()
            of = self.subscripted(self.atom())
        made = Diff(token.span.to(of.span), of, order)
        if plain and not self.in_integral:
            d = Letter(token.span, "d")
            power = self.scripted(of)
            span = made.span.to(power.span)
            differential = made if power is of else Pow(span, made, _exponent(power))
            return Open(span, "letter d", (differential, Mul(span, (("", d), ("", power)))))
        return self.scripted(made)

    def subscripted(self, atom: Node) -> Node:
        """Return a letter with its subscripts and primes, but without superscripts: the letter after `d`."""
        while isinstance(atom, Letter) and (token := self.peek()) is not None and token.kind is Kind.SCRIPT:
            if token.text != "_":
                break
            self.at += 1
            label = self.label(self.argument())
            atom = replace(atom, sub=_joined(atom.sub, label), span=atom.span.to(self.tokens[self.at - 1].span))
        while isinstance(atom, Letter) and self.next_is_mark("'"):
            self.at += 1
            atom = replace(atom, primes=atom.primes + 1)
        return atom

    def scripted(self, node: Node) -> Node:
        """Return a node with the subscript, superscript and primes that follow it."""
        while (token := self.peek()) is not None:
            if token.kind is Kind.OPEN and self.peek(1) is not None and self.tokens[self.at + 1].kind is Kind.CLOSE:
                self.at += 2  # `x_1{}^2`
                continue
            following = self.peek(1)
            if token.is_command(",", "!", ":", ";") and following is not None and following.kind is Kind.SCRIPT:
                self.at += 1  # `90\,^\circ`
                continue
            if token.is_mark("'"):
                self.at += 1
                node = self.primed(node, 1, token.span)
                continue
            if token.is_command("indices") and isinstance(node, Letter):
                self.at += 1
                node = replace(node, label=_joined(node.label, self.label(self.argument())))
                continue
            if token.is_mark("!") and not isinstance(node, Text):
                self.at += 1
                node = Fun(node.span.to(token.span), "factorial", node)
                continue
            if token.kind is not Kind.SCRIPT:
                break
            if isinstance(node, Group | Mat | Abs) and self.has_both_scripts():
                lower, upper = self.scripts()
                if isinstance(lower, Text):
                    node = self.with_power(self.labelled(node, lower.text), upper, token.span)
                else:
                    node = EvalBar(node.span, node, lower, upper)
                continue
            self.at += 1
            value = self.argument()
            script = replace(token, span=token.span.to(self.tokens[self.at - 1].span))
            node = self.with_subscript(node, value, script) if token.text == "_" else self.raised(node, value, script)
        return node

    def has_both_scripts(self) -> bool:
        first = self.at
        self.at += 1
        try:
            self.argument()
            token = self.peek()
            return token is not None and token.kind is Kind.SCRIPT and token.text != self.tokens[first].text
        except Unreadable:
            return False
        finally:
            self.at = first

    def primed(self, node: Node, count: int, span: Span) -> Node:
        if isinstance(node, Letter):
            return replace(node, primes=node.primes + count, span=node.span.to(span))
        raise Unreadable("a prime is allowed only after a letter", span)

    def with_subscript(self, node: Node, value: list[Token], script: Token) -> Node:
        label = self.label(value)
        if isinstance(node, Letter):
            return replace(node, sub=_joined(node.sub, label), span=node.span.to(script.span))
        if isinstance(node, Pow) and isinstance(node.base, Letter):
            return replace(node, base=replace(node.base, sub=_joined(node.base.sub, label)))
        if isinstance(node, Group | Abs | Vec | Mat):
            if any(each.is_mark("=") for each in value):
                return EvalBar(node.span, node, self.limit(value, script.span), None)
            return self.labelled(node, label)
        if isinstance(node, Der | Frac | Fun | Root | Apply | Open):
            return self.labelled(node, label)
        raise Unreadable("a subscript is not allowed here", script.span)

    def labelled(self, node: Node, label: str) -> Node:
        inner = node.inner if isinstance(node, Group) else node
        if isinstance(inner, Letter):
            return replace(inner, sub=_joined(inner.sub, label))
        return EvalBar(node.span, node, Text(node.span, label), None)

    def raised(self, node: Node, value: list[Token], script: Token) -> Node:
        plain = without_spaces(value)
        if plain and all(each.is_command("prime") or each.is_mark("'") for each in plain):
            return self.primed(node, len(plain), script.span)
        if plain and any(each.is_command("prime") for each in plain[:1]):
            rest = [each for each in plain if not each.is_command("prime")]
            node = self.primed(node, len(plain) - len(rest), script.span)
            return self.with_power(node, self.inside(rest, script.span), script.span)
        if plain and (plain[0].is_command("circ", "degree", "textdegree") or "".join(t.text for t in plain) == "o"):
            return Fun(node.span.to(plain[0].span), "degrees", node)
        if plain and (
            plain[0].is_command(*TEXTS, "dagger", "ast", "star", "top", "intercal")
            or plain[0].is_mark("*", "+")
            or (len(plain) == 1 and plain[0].is_mark("-"))
        ):
            label = self.label(plain)
            if isinstance(node, Letter):
                return replace(node, label=_joined(node.label, label))
            if isinstance(node, Group | Mat | Vec | Frac):
                return EvalBar(node.span.to(script.span), node, Text(script.span, label), None)
            message = "a superscript that is a label is allowed only on a letter, bracket, vector, matrix or fraction"
            raise Unreadable(message, script.span)
        if plain and plain[0].is_mark("(") and plain[-1].is_mark(")") and isinstance(node, Letter):
            return replace(node, label=_joined(node.label, self.label(plain[1:-1])))
        power = self.inside(plain, script.span)
        return self.with_power(node, power, script.span)

    def with_power(self, node: Node, power: Node | None, span: Span) -> Node:
        if power is None:
            return node
        if isinstance(node, Pow):
            raise Unreadable("two superscripts follow each other", span)
        made = Pow(node.span.to(span), node, power)
        if isinstance(node, Num) and isinstance(power, Num) and power.text == "0":
            return Open(made.span, "superscript", (Fun(made.span, "degrees", node), made))
        if isinstance(node, Letter) and isinstance(power, Letter) and not power.sub and not power.dots:
            return Open(made.span, "superscript", (made, replace(node, label=_joined(node.label, power.base))))
        if isinstance(node, Letter) and isinstance(power, Mul) and _is_word(power):
            word = "".join(each.base for _, each in power.factors if isinstance(each, Letter))
            return Open(made.span, "superscript", (made, replace(node, label=_joined(node.label, word))))
        return made

    def label(self, tokens: list[Token]) -> str:
        """Return a subscript as a word: `1`, `xx`, `cm`, `i+1`."""
        words = []
        at = 0
        while at < len(tokens):
            token = tokens[at]
            at += 1
            if token.kind is Kind.COMMAND and token.text in {*TEXTS, *MARKS, *DOTS}:
                value, at = argument_at(tokens, at)
                words.append(self.label(value))
            elif (
                token.kind is Kind.COMMAND
                and (token.text in IGNORED or token.text == " ")
                or token.kind in (Kind.OPEN, Kind.CLOSE, Kind.SPACE)
            ):
                continue
            else:
                words.append(SAME_LETTER.get(token.text, token.text))
        return "".join(words)

    # Atoms

    def atom(self) -> Node:
        token = self.needed()
        if token.kind is Kind.NUMBER:
            self.at += 1
            return Num(token.span, token.text)
        if token.kind is Kind.LETTER:
            name = self.bare_function()
            self.at += len(name) or 1
            return self.function(token, name) if name else Letter(token.span, token.text)
        if token.kind is Kind.OPEN:
            return self.braced(token)
        if token.is_mark("(", "["):
            return self.bracketed()
        if token.is_mark("|"):
            return self.between_bars()
        if token.is_mark("<"):
            return self.bracketed()
        if token.is_mark("?"):
            self.at += 1
            return Text(token.span, "?")
        if token.kind is Kind.COMMAND:
            return self.command(token)
        raise Unreadable(f"`{token.text}` was not expected here", token.span)

    def bare_function(self) -> str:
        """Return the name of a function without a backslash: `sin(x)`, `sin^2 x`, or `sin` before a Greek letter."""
        run: list[Token] = []
        for token in self.tokens[self.at :]:
            if token.kind is not Kind.LETTER or (run and run[-1].span.end != token.span.start):
                break
            run.append(token)
        before = self.peek(-1) if self.at else None
        joined = before is not None and before.kind is Kind.LETTER and before.span.end == run[0].span.start
        word, after = "".join(each.text for each in run), self.peek(len(run))
        opens = after is not None and (after.is_mark("(") or after.text == "^" or after.is_command("left", *GREEK))
        return word if word in BARE_FUNCTIONS and opens and not joined else ""

    def braced(self, token: Token) -> Node:
        value = self.argument()
        if not value:
            raise Unreadable("these braces are empty", token.span)
        if value[0].is_command("rm", "bf", "mathrm") and value[0].text != "mathrm":
            return self.command_word(value[0], value[1:])
        inner = self.inside(value, token.span)
        return inner if isinstance(inner, Letter | Num | Frac | Fun | Root | Group) else Group(inner.span, inner, "{")

    def command(self, token: Token) -> Node:
        name = token.text
        self.at += 1
        if name in ("frac", "dfrac", "tfrac", "cfrac", "sfrac", "nicefrac", "flatfrac"):
            top, bottom = self.argument(), self.argument()
            return self.fraction(top, bottom, self.since(token))
        if name == "sqrt" or name == "root":
            return self.root(token)
        if name in FREQUENT_DERIVATIVES or (name == "diff" and self.has_two_groups()):
            return self.short_derivative(token)
        if name in FUNCTIONS:
            return self.function(token, name)
        if name in GREEK:
            base = SAME_LETTER.get(name, name)
            return self.difference(token) if name == "Delta" else Letter(token.span, base)
        if name in DOTS:
            return self.dotted(token, DOTS[name])
        if name in MARKS:
            return self.marked(token, MARKS[name])
        if name in TEXTS:
            return self.command_word(token, self.argument())
        if name in INTEGRALS:
            return self.integral(token)
        if name in ("sum", "prod"):
            return self.summed(token)
        if name == "lim":
            _lower, _ = self.scripts()
            return Text(token.span, "lim")
        if name in ("left", "{", "lbrace", "langle", "lvert", "lVert", "|", "vert", "Vert"):
            self.at -= 1
            return self.between_bars() if name in ("|", "vert", "Vert") else self.bracketed()
        if name in ("abs", "norm", "qty", "pqty", "bqty", "Bqty", "vqty", "paren"):
            return self.quantity(token)
        if name in DECORATED:
            if name == "raisebox":
                self.argument()
            node = self.inside(self.argument(), token.span)
            if name in ("underbrace", "overbrace", "underbracket"):
                while (script := self.peek()) is not None and script.kind is Kind.SCRIPT:
                    self.at += 1
                    self.argument()
            return node if isinstance(node, Letter | Num) else Group(node.span, node, "{")
        if name in ("underset", "overset", "stackrel"):
            self.argument()
            return self.inside(self.argument(), token.span)
        if name in ("cancelto",):
            return self.inside(self.argument(), token.span)
        if name == "begin":
            return self.environment(token)
        if name in ("infty",):
            return Letter(token.span, "infty")
        if name in ("nabla", "grad", "curl", "laplacian"):
            return self.nabla(token)
        if name == "partial":
            return self.curly_differential(token)
        if name in AVERAGES:
            return self.average(token)
        if name in IMAGINARY:
            return Letter(token.span, "imaginary unit")
        if name == "order":
            self.skip_spacing()
            group = self.bracketed() if self.next_is_mark("(") else self.inside(self.argument(), token.span)
            return Fun(self.since(token), "order", group)
        if name == "var":
            return Letter(token.span, "delta")
        if name == "eval":
            inner = self.inside(self.argument(), token.span)
            lower, upper = self.scripts()
            return EvalBar(self.since(token), inner, lower, upper)
        if name in ELLIPSES:
            return Text(token.span, "...")
        if name in ("circ", "degree"):
            return Text(token.span, "degrees")
        if name in ("ell", "hbar", "prime", "angle", "triangle"):
            return Letter(token.span, name)
        if name in ("SI", "qty*", "si", "unit", "num", "ang"):
            return self.with_unit(token)
        if name in ("i", "j", "k"):
            return Letter(token.span, name)
        if name == "%":
            return Frac(token.span, Num(token.span, "1"), Num(token.span, "100"))
        if name in ("&", "#", "$", "_"):
            raise Unreadable(f"`\\{name}` is not allowed in a formula", token.span)
        raise Unreadable(f"`\\{name}` is not known", token.span)

    def difference(self, token: Token) -> Node:
        after = self.peek()
        if after is not None and (after.kind is Kind.LETTER or (after.kind is Kind.COMMAND and after.text in GREEK)):
            self.at += 1
            name = SAME_LETTER.get(after.text, after.text)
            return Letter(token.span.to(after.span), f"Delta {name}")
        return Letter(token.span, "Delta")

    def follows_number(self, token: Token) -> bool:
        """Whether a number that is not a subscript or superscript precedes a command; spacing commands between them are
        ignored."""
        before = next((i for i in range(self.at - 1, -1, -1) if self.tokens[i] is token), 0) - 1
        while before >= 0 and self.tokens[before].is_command(",", ";", " ", "!", ":"):
            before -= 1
        script = before > 0 and self.tokens[before - 1].kind is Kind.SCRIPT
        return before >= 0 and self.tokens[before].kind is Kind.NUMBER and not script

    def since(self, token: Token) -> Span:
        last = self.tokens[self.at - 1].span
        return Span(token.span.start, max(last.end, token.span.end))

    def with_unit(self, token: Token) -> Node:
        if token.text in ("si", "unit"):
            return Text(token.span, "unit " + self.unit(self.argument()))
        number = self.inside(self.argument(), token.span)
        if token.text == "ang":
            return Fun(number.span, "degrees", number)
        if token.text == "num":
            return number
        unit = Text(token.span, "unit " + self.unit(self.argument()))
        return Mul(self.since(token), (("", number), ("", unit)))

    def unit(self, tokens: list[Token]) -> str:
        r"""Return a unit as plain text: `m/s^2` for `\metre\per\second\squared`, and `m s^-2` for `m.s^{-2}`."""
        word = ""
        for token in without_spaces(tokens):
            if token.kind in (Kind.OPEN, Kind.CLOSE):
                continue
            piece = UNIT_COMMANDS.get(token.text, token.text) if token.kind is Kind.COMMAND else token.text
            apart = token.kind is Kind.COMMAND and word and piece[0] not in "/^" and word[-1] not in "/kcM"
            word += f" {piece}" if apart else piece.replace(".", " ")
        return word

    def fraction(self, top: list[Token], bottom: list[Token], span: Span) -> Node:
        top, bottom = without_spaces(top), without_spaces(bottom)
        derivative = self.derivative(top, bottom, span)
        if derivative is not None:
            return derivative
        return Frac(span, self.inside(top, span), self.inside(bottom, span))

    def derivative(self, top: list[Token], bottom: list[Token], span: Span) -> Node | None:
        r"""Return `\frac{d^n f}{dx^n}` as a derivative, or None if it is a fraction."""
        head = _head_of(bottom)
        if head is None or _head_of(top) != head:
            return None
        width = _width_of_head(bottom)
        by: list[tuple[Node, int]] = []
        reader = _Reader(bottom, self.depth + 1)
        while reader.at < len(reader.tokens):
            if _head_of(reader.tokens[reader.at :]) != head:
                reader.skip_spacing()
                if reader.at >= len(reader.tokens):
                    break
                if _head_of(reader.tokens[reader.at :]) != head:
                    return None
            reader.at += width
            reader.skip_spacing()
            if reader.at >= len(reader.tokens):
                return None
            try:
                letter = reader.subscripted(reader.atom())
                order = 1
                token = reader.peek()
                if token is not None and token.kind is Kind.SCRIPT and token.text == "^":
                    reader.at += 1
                    raised = reader.argument()
                    if all(each.is_command("prime") for each in raised) and isinstance(letter, Letter):
                        letter = replace(letter, primes=len(raised))
                    elif len(raised) == 1 and raised[0].text.isdigit():
                        order = int(raised[0].text)
                    elif (
                        len(raised) == 1
                        and isinstance(letter, Letter)
                        and (raised[0].text in GREEK or raised[0].kind is Kind.LETTER)
                    ):
                        letter = replace(letter, label=reader.label(raised))
                    else:
                        return None
            except Unreadable:
                return None
            if isinstance(letter, Group):
                letter = letter.inner
            if not isinstance(letter, Letter):
                return None
            by.append((letter, order))
        if not by:
            return None
        rest = top[_width_of_head(top) :]
        if rest and rest[0].kind is Kind.SCRIPT and rest[0].text == "^":
            _, after = argument_at(rest, 1)
            rest = rest[after:]
        of = self.inside(rest, span) if rest else None
        return Der(span, head == "partial", tuple(by), of)

    def short_derivative(self, token: Token) -> Node:
        r"""Read `\dv[n]{f}{x}` of the package physics; `\dv{x}` is an operator."""
        order = 1
        if self.next_is_mark("*"):
            self.at += 1
        if self.next_is_mark("["):
            self.at += 1
            number = self.peek()
            order = int(number.text) if number is not None and number.text.isdigit() else 1
            while not self.next_is_mark("]") and self.peek() is not None:
                self.at += 1
            self.at += 1
        first = self.inside(self.argument(), token.span)
        groups: list[Node] = []
        while (brace := self.peek()) is not None and brace.kind is Kind.OPEN and len(groups) < 3:
            groups.append(self.inside(self.argument(), token.span))
        of, letters = (first, groups) if groups else (None, [first])
        partial = token.text.startswith("p")
        return Der(self.since(token), partial, tuple((each, order) for each in letters), of)

    def curly_differential(self, token: Token) -> Node:
        r"""Read `\partial f` before a slash, or the operator `\partial_x`."""
        order = 1
        while (script := self.peek()) is not None and script.kind is Kind.SCRIPT:
            self.at += 1
            value = self.argument()
            if script.text == "_":
                letter = self.inside(value, script.span)
                if not isinstance(letter, Letter):
                    raise Unreadable("this is not a variable of differentiation", script.span)
                return Der(self.since(token), True, ((letter, order),), None)
            order = int(value[0].text) if len(value) == 1 and value[0].text.isdigit() else 1
        self.skip_spacing()
        if self.ends():
            return Diff(token.span, Text(token.span, "partial"), order, partial=True)
        atom = self.atom()
        of = self.subscripted(atom) if isinstance(atom, Letter) else atom
        return Diff(token.span.to(of.span), of, order, partial=True)

    def nabla(self, token: Token) -> Node:
        kind = {"curl": "times", "laplacian": "squared"}.get(token.text, "")
        while (script := self.peek()) is not None and script.kind is Kind.SCRIPT:
            self.at += 1
            value = self.argument()
            kind = "squared" if script.text == "^" and "".join(each.text for each in value) == "2" else kind
        self.skip_spacing()
        if self.next_is("cdot", "times", "vdot", "cross") and not kind:
            kind = "cdot" if self.next_is("cdot", "vdot") else "times"
            self.at += 1
            self.skip_spacing()
        if self.ends():
            return Text(token.span, "nabla")
        of = self.factor()
        return Nabla(token.span.to(of.span), kind, of)

    def average(self, token: Token) -> Node:
        """Read an average or a product of states as one letter, whose value is not known."""
        words = [self.label(self.argument())]
        while (brace := self.peek()) is not None and brace.kind is Kind.OPEN:
            words.append(self.label(self.argument()))
        return Letter(self.since(token), "<" + "|".join(words) + ">")

    def root(self, token: Token) -> Node:
        index = None
        if self.next_is_mark("["):
            close = next((i for i in range(self.at, len(self.tokens)) if self.tokens[i].is_mark("]")), None)
            if close is not None:
                index = self.inside(self.tokens[self.at + 1 : close], token.span)
                self.at = close + 1
        inner = self.inside(self.argument(), token.span)
        return Root(self.since(token), inner, index)

    def dotted(self, token: Token, count: int) -> Node:
        inner = self.inside(self.argument(), token.span)
        while isinstance(inner, Group):
            inner = inner.inner
        if isinstance(inner, Letter):
            return replace(inner, dots=inner.dots + count, span=self.since(token))
        time = Letter(token.span, "t")
        return Der(self.since(token), False, ((time, count),), inner)

    def marked(self, token: Token, mark: str) -> Node:
        if self.next_is_mark("*"):
            self.at += 1
        value = self.argument()
        if len(value) == 1 and value[0].is_command("nabla"):
            return self.nabla(value[0])
        inner = self.inside(value, token.span)
        while isinstance(inner, Group):
            inner = inner.inner
        if isinstance(inner, Letter):
            return replace(inner, marks=inner.marks | {mark}, span=self.since(token))
        if isinstance(inner, Mul) and _is_word(inner):
            word = "".join(each.base for _, each in inner.factors if isinstance(each, Letter))
            return Letter(self.since(token), word, marks=frozenset({mark}))
        if isinstance(inner, Num):
            return Letter(self.since(token), inner.text, marks=frozenset({mark}))
        if isinstance(inner, Open) and inner.kind == "letter d" and isinstance(inner.alternatives[0], Diff):
            inner = inner.alternatives[0]
        if isinstance(inner, Diff) and isinstance(inner.of, Letter):  # `\mathbf{dr}`
            return replace(inner, of=replace(inner.of, marks=inner.of.marks | {mark}), span=self.since(token))
        if isinstance(inner, Pow | Mul | Add | Open | Apply):
            return Group(inner.span, inner, "{")
        raise Unreadable(f"the argument of `\\{token.text}` must be a letter", token.span)

    def command_word(self, token: Token, value: list[Token]) -> Node:
        r"""Read `\mathrm{...}` or `\operatorname{...}`: a function, a letter, a unit, or a word."""
        plain = without_spaces(value)
        word = "".join(each.text for each in plain)
        span = self.since(token)
        if word in UNIT_WORDS or ("/" in word and all(each in UNIT_NAMES for each in word.split("/"))):
            return Text(span, f"unit {word}{self.power_of_unit()}")
        if self.follows_number(token) and word != "diag" and (unit := _unit(plain)):
            return Text(span, unit if unit == "degrees" else unit + self.power_of_unit())
        if word in FUNCTIONS or word.lower() in ("arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "atan2", "sgn"):
            return self.function(token, word)
        if len(plain) == 1 and plain[0].kind is Kind.LETTER:
            return Letter(span, word)
        if len(plain) == 1 and plain[0].kind is Kind.COMMAND and plain[0].text in GREEK:
            return Letter(span, SAME_LETTER.get(word, word))
        if len(plain) > 1 and all(each.kind is Kind.LETTER for each in plain):
            letters = tuple(("", Letter(each.span, each.text)) for each in plain)
            return Open(span, "word", (Letter(span, word), Mul(span, letters)))
        if plain and plain[0].kind is Kind.NUMBER:
            return self.inside(plain, span)
        return Text(span, " ".join(each.text for each in value if each.kind is not Kind.SPACE))

    def power_of_unit(self) -> str:
        r"""Read the power after a unit in words: `\text{rad/s}^2`."""
        token = self.peek()
        if token is None or token.kind is not Kind.SCRIPT or token.text != "^":
            return ""
        self.at += 1
        return "^" + "".join(each.text for each in without_spaces(self.argument()))

    def function(self, token: Token, name: str) -> Node:
        name = {"cosec": "csc", "Tr": "tr", "asin": "arcsin", "acos": "arccos", "atan": "arctan", "arsinh": "arcsinh",
                "arcosh": "arccosh", "artanh": "arctanh", "sgn": "sign"}.get(name, name)  # fmt: skip
        power = base = None
        while (script := self.peek()) is not None and script.kind is Kind.SCRIPT:
            self.at += 1
            value = self.inside(self.argument(), script.span)
            power, base = (value, base) if script.text == "^" else (power, value)
        number, close, after = self.peek(1), self.peek(2), self.peek(3)
        if self.next_is_mark("[") and number is not None and close is not None and after is not None:
            opens = after.is_mark("(") or after.is_command("left") or after.kind is Kind.OPEN
            if number.kind is Kind.NUMBER and close.is_mark("]") and opens and power is None:
                power = Num(number.span, number.text)  # `\sin[2](x)` of the package physics is a square
                self.at += 3
        self.skip_spacing()
        while self.next_is(*IGNORED):
            self.skip_spacing()
        following = self.peek()
        if following is None or (self.ends() and not following.is_mark("-", "+")):
            raise Unreadable(f"the argument of `\\{name}` is missing", token.span)
        bracket = following.is_mark("(", "[") or following.is_command("left", "{")
        if bracket or following.kind is Kind.OPEN:
            argument = self.bracketed() if bracket else self.braced(following)
            if following.kind is Kind.OPEN and (after := self.peek()) is not None and after.kind is Kind.SCRIPT:
                argument = self.scripted(argument)  # `\sin {\theta}_1`
            elif (
                (after := self.peek()) is not None and after.kind is Kind.SCRIPT and after.text == "^" and power is None
            ):
                # `\cos(x)^2` is the square of the cosine
                self.at += 1
                power = self.inside(self.argument(), after.span)
            inner = argument.inner if isinstance(argument, Group) else argument
            return Fun(token.span.to(argument.span), name, inner, power, base)
        sign = self.sign()
        run = self.run_of_argument()
        if not run:
            raise Unreadable(f"the argument of `\\{name}` is missing", token.span)

        def of(count: int) -> Fun:
            argument: Node = _product([("", each) for each in run[:count]])
            if sign is not None:
                argument = Add(argument.span, ((sign, argument),))
            return Fun(token.span.to(argument.span), name, argument, power, base)

        shortest = next((i + 1 for i, each in enumerate(run) if not _is_number(each)), len(run))
        if shortest == len(run):
            return of(len(run))
        span = token.span.to(run[-1].span)
        alternatives = []
        for count in range(len(run), shortest - 1, -1):
            rest: tuple[tuple[str, Node], ...] = tuple(("", each) for each in run[count:])
            alternatives.append(Mul(span, (("", of(count)), *rest)) if rest else of(count))
        return Open(span, "extent", tuple(alternatives))

    def run_of_argument(self) -> list[Node]:
        run: list[Node] = []
        while not self.ends():
            token = self.peek()
            assert token is not None
            if token.kind is Kind.COMMAND:
                if token.text in (",", ";", ":", "quad", "qquad", "!") and run:
                    break
                if token.text in FUNCTIONS or token.text in INTEGRALS or token.text in ("sum", "cdot", "times", "left"):
                    break
                if token.text in TEXTS and self.word_at(1) in (*FUNCTIONS, "d"):
                    break
                if token.text in ("frac", "dfrac", "tfrac", "sqrt") and run and not _is_number(run[-1]):
                    break
            if token.is_mark("(", "[", "|", "/"):
                break
            if run and self.in_integral and self.is_differential():
                break
            if len(run) >= 4:
                break
            begins = self.at
            node = self.factor()
            if (
                isinstance(node, Pow) and run and isinstance(run[0], Letter)
            ):  # `\sin\theta r^2`: the argument ends before the power
                self.at = begins
                break
            if _is_product_with_bracket(node):  # `\sin\theta (a + b)`: the argument ends before the bracket
                self.at = begins
                node = self.scripted(self.atom())
                run.append(node)
                break
            run.append(node)
            if isinstance(node, Pow | Open | Apply | Group | Text | Der | Diff):
                break
            if isinstance(node, Frac) and not _is_number(node):
                break
        if (slash := self.peek()) is not None and slash.is_mark("/") and run:
            self.at += 1
            bottom = self.factor()
            top = _product([("", each) for each in run])
            run = [Frac(top.span.to(bottom.span), top, bottom)]
        return run

    def integral(self, token: Token) -> Node:
        lower, upper = self.scripts() if self.has_scripts() else (None, None)
        count = INTEGRALS[token.text]
        signs: list[Node] = [Sign(token.span, lower, upper, token.text.startswith("o")) for _ in range(count)]
        items: list[Node] = signs
        before, self.in_integral = self.in_integral, True
        try:
            while True:
                self.skip_spacing()
                self.factors_of_integral(items)
                missing = sum(isinstance(each, Sign) for each in items) - sum(_orders(each) for each in items)
                following = self.peek()
                if missing > 0 and following is not None and following.is_mark("+", "-") and self.differential_ahead():
                    self.sum_in_integral(items)
                    continue
                break
        finally:
            self.in_integral = before
        return Int(token.span.to(items[-1].span if items[-1].span.end > token.span.end else token.span), tuple(items))

    def has_scripts(self) -> bool:
        self.skip_spacing()
        token = self.peek()
        return token is not None and token.kind is Kind.SCRIPT

    def factors_of_integral(self, items: list[Node]) -> None:
        """Read the factors up to the end of the product, and merge inner integrals into this one."""
        while not self.ends():
            self.skip_spacing()
            token = self.peek()
            if token is None:
                break
            if token.is_command("cdot", "times", "vdot", "cross") or token.is_mark("*"):
                mark = "times" if token.text in ("times", "cross") else "cdot"
                self.at += 1
                self.skip_spacing()
                if self.ends():
                    raise Unreadable("a factor is missing after this sign", token.span)
                right = self.factor()
                left = items.pop() if items and not isinstance(items[-1], Sign | Diff) else None
                items.append(right if left is None else Mul(left.span.to(right.span), (("", left), (mark, right))))
                continue
            if token.is_mark("/"):
                self.at += 1
                bottom = self.factor()
                top = items.pop() if items and not isinstance(items[-1], Sign | Diff) else Num(token.span, "1")
                items.append(Frac(top.span.to(bottom.span), top, bottom))
                continue
            factor = self.factor()
            if isinstance(factor, Der) and factor.of is None:
                factor = self.with_operand(factor)
            if isinstance(factor, Int):
                items += factor.items
            elif isinstance(factor, Frac) and (split := _with_differential_on_top(factor)) is not None:
                items += split
            else:
                items.append(factor)

    def differential_ahead(self) -> bool:
        """Whether a differential follows outside of brackets."""
        depth = 0
        for at in range(self.at, len(self.tokens)):
            token = self.tokens[at]
            depth += token.kind is Kind.OPEN or token.is_mark("(", "[")
            depth -= token.kind is Kind.CLOSE or token.is_mark(")", "]")
            if depth < 0:
                return False
            if depth == 0 and token.is_command(*INTEGRALS):
                return False
            if depth == 0 and (token.is_command("dd") or (token.kind is Kind.LETTER and token.text == "d")):
                return True
            if depth == 0 and token.is_command("mathrm"):
                value, _ = argument_at(self.tokens, at + 1)
                if "".join(each.text for each in value) == "d":
                    return True
        return False

    def sum_in_integral(self, items: list[Node]) -> None:
        r"""Read the rest of an integrand that is a sum without brackets: `\int a + b \, dx`."""
        last_sign = max(i for i, each in enumerate(items) if isinstance(each, Sign | Diff))
        first = items[last_sign + 1 :]
        del items[last_sign + 1 :]
        terms: list[tuple[str, Node]] = [("+", _product([("", each) for each in first]))] if first else []
        rest: list[Node] = []
        while (sign := self.sign()) is not None:
            rest = []
            self.factors_of_integral(rest)
            cut = next((i for i, each in enumerate(rest) if isinstance(each, Diff)), len(rest))
            terms.append(
                (sign, _product([("", each) for each in rest[:cut]] or [("", Num(self.tokens[self.at - 1].span, "1"))]))
            )
            if cut < len(rest):
                rest = rest[cut:]
                break
            rest = []
        items.append(Add(terms[0][1].span.to(terms[-1][1].span), tuple(terms)))
        items += rest

    def summed(self, token: Token) -> Node:
        lower, upper = self.scripts() if self.has_scripts() else (None, None)
        body = self.product()
        index = None
        if isinstance(lower, Condition):
            index, lower = lower.left, lower.right
        elif lower is not None:
            index, lower = lower, None
        return Sum(token.span.to(body.span), token.text, index, lower, upper, body)

    # Brackets

    def closing_of(self, opener: Token) -> tuple[int, bool]:
        """Return the position of the bracket that closes the current one, and `True`; if there is none, the number of
        tokens, and `False`.
        """
        depth = 0
        for at in range(self.at, len(self.tokens)):
            token = self.tokens[at]
            if at > self.at and self.tokens[at - 1].is_command("left", "right") and not opener.is_command("left"):
                continue
            if opener.is_command("left"):
                depth += token.is_command("left") - token.is_command("right")
                if depth == 0:
                    return at, True
                continue
            if (
                token.kind is Kind.OPEN
                or token.is_mark("(", "[")
                or token.is_command("{", "langle", "lbrace", "left", "lvert", "lVert")
                or token.is_mark("<")
                and opener.is_mark("<")
            ):
                depth += 1
            elif (
                (
                    token.kind is Kind.CLOSE
                    or token.is_mark(")", "]")
                    or token.is_command("}", "rangle", "rbrace", "right", "rvert", "rVert")
                )
                or token.is_mark(">")
                and opener.is_mark("<")
            ):
                depth -= 1
                if depth == 0:
                    return at, True
        return len(self.tokens), False

    def bracketed(self) -> Node:
        r"""Read a bracket: a group, a list, an average, or the absolute value after `\left|`."""
        opener = self.needed()
        close, found = self.closing_of(opener)
        if not found:
            raise Unreadable("this bracket is not closed", opener.span)
        begins = self.at + 1
        kind = opener.text
        if opener.is_command("left"):
            kind = self.tokens[begins].text if begins < len(self.tokens) else "("
            begins += 1
        inner = self.tokens[begins:close]
        self.at = close + 1
        last = self.tokens[close]
        if opener.is_command("left") and self.at < len(self.tokens):
            last = self.tokens[self.at]
            self.at += 1
        span = opener.span.to(last.span)
        if kind == "." and last.text in ("|", "vert", "rvert"):
            content = self.inside(inner, span)
            lower, upper = self.scripts()
            return EvalBar(span, content, lower, upper)
        if kind in ("|", "vert", "lvert", "Vert", "lVert"):
            return self.of_bars(inner, span)
        if not inner:
            raise Unreadable("this bracket is empty", span)
        return self.contents(inner, span, OPENERS.get(kind, ")") if kind != "." else ".")

    def contents(self, tokens: list[Token], span: Span, closing: str) -> Node:
        if closing == ">" and not any(each.is_mark(",") for each in tokens):
            return Letter(span, f"<{self.label(tokens)}>")  # an average
        pieces = _split(tokens, lambda each: each.is_mark(",", ";"))
        if len(pieces) > 1:
            return Vec(span, tuple(self.limit(each, span) if each else Text(span, "") for each in pieces), closing)
        node = self.limit(tokens, span) if _equals_sign(tokens) else self.inside(tokens, span)
        if isinstance(node, Mat):
            return node
        return Group(span, node, closing)

    def of_bars(self, tokens: list[Token], span: Span) -> Node:
        node = self.inside(tokens, span)
        if isinstance(node, Mat):
            return replace(node, determinant=True)
        return Abs(span, node)

    def between_bars(self) -> Node:
        opener = self.tokens[self.at]
        depth = 0
        close = None
        for at in range(self.at + 1, len(self.tokens)):
            token = self.tokens[at]
            depth += (token.kind is Kind.OPEN) - (token.kind is Kind.CLOSE)
            depth += token.is_mark("(", "[") - token.is_mark(")", "]")
            if depth < 0:
                break
            if depth == 0 and token.text == opener.text and token.kind is opener.kind:
                close = at
                break
        if close is None:
            raise Unreadable("this bar is not closed", opener.span)
        inner = self.tokens[self.at + 1 : close]
        span = opener.span.to(self.tokens[close].span)
        self.at = close + 1
        return self.of_bars(inner, span)

    def quantity(self, token: Token) -> Node:
        r"""Read `\abs{...}`, `\qty(...)` and similar commands of the package physics."""
        if self.next_is_mark("*"):
            self.at += 1
        following = self.peek()
        if following is not None and following.kind is Kind.OPEN:
            value = self.argument()
            node = self.contents(value, self.since(token), "}") if value else self.inside(value, token.span)
        else:
            node = self.bracketed()
        return Abs(node.span, node) if token.text in ("abs", "norm", "vqty") else node if isinstance(
            node, Group | Vec | Mat
        ) else Group(node.span, node, ")")  # fmt: skip

    def environment(self, token: Token) -> Node:
        name_tokens, after = argument_at(self.tokens, self.at)
        name = "".join(each.text for each in name_tokens).rstrip("*")
        depth, close = 1, None
        for at in range(after, len(self.tokens)):
            depth += self.tokens[at].is_command("begin") - self.tokens[at].is_command("end")
            if depth == 0:
                close = at
                break
        if close is None:
            raise Unreadable(f"`\\begin{{{name}}}` is not closed", token.span)
        inner = self.tokens[after:close]
        _, self.at = argument_at(self.tokens, close + 1)
        if name in ("cases", "dcases", "rcases"):
            return self.cases(inner, self.since(token))
        if name not in MATRICES:
            raise Unreadable(f"the environment `{name}` is not read inside a formula", token.span)
        if name == "array":
            _, skip = argument_at(inner, 0)
            inner = inner[skip:]
        rows: list[tuple[Node, ...]] = []
        for row in _split(inner, lambda each: each.is_command("\\", "cr", "newline")):
            row = [each for each in row if not each.is_command("hline")]
            if row and row[0].is_mark("[") and rows:
                end = next((i for i, each in enumerate(row) if each.is_mark("]")), -1)
                row = row[end + 1 :]
            if not row:
                continue
            rows.append(tuple(
                self.inside(cell, token.span) if cell else Text(token.span, "")
                for cell in _split(row, lambda each: each.kind is Kind.CELL)
            ))  # fmt: skip
        if not rows:
            raise Unreadable("this matrix is empty", token.span)
        return Mat(self.since(token), tuple(rows), name in ("vmatrix",))

    def cases(self, tokens: list[Token], span: Span) -> Node:
        values, conditions = [], []
        for row in _split(tokens, lambda each: each.is_command("\\", "cr", "newline")):
            cells = _split(row, lambda each: each.kind is Kind.CELL)
            value = without_spaces(cells[0])
            while value and (value[-1].is_mark(",", ";") or value[-1].is_command("quad", "qquad", ",")):
                value.pop()
            if value:
                values.append(self.inside(value, span))
                conditions.append(" ".join(each.text for cell in cells[1:] for each in without_spaces(cell)))
        if not values:
            raise Unreadable("these cases are empty", span)
        return Cases(span, tuple(values), tuple(conditions))


def _without_empty_braces(tokens: list[Token]) -> list[Token]:
    found: list[Token] = []
    for token in tokens:
        empty = token.kind is Kind.CLOSE and bool(found) and found[-1].kind is Kind.OPEN
        if empty and not (len(found) > 1 and found[-2].kind is Kind.SCRIPT):
            found.pop()
        else:
            found.append(token)
    return found


def _is_number(node: Node) -> bool:
    if isinstance(node, Frac):
        return isinstance(node.top, Num) and isinstance(node.bottom, Num)
    return isinstance(node, Num)


def _is_product_with_bracket(node: Node) -> bool:
    """Whether a letter before a bracket cannot be a function of the contents of the bracket."""
    if not isinstance(node, Open) or node.kind != "apply":
        return False
    call = node.alternatives[0]
    while isinstance(call, Pow | EvalBar):
        call = call.base if isinstance(call, Pow) else call.inner
    return isinstance(call, Apply) and not isinstance(call.arguments[0], Letter | Num | Condition)


def _equals_sign(tokens: Sequence[Token]) -> int | None:
    depth = 0
    for at, token in enumerate(tokens):
        depth += (token.kind is Kind.OPEN) - (token.kind is Kind.CLOSE)
        if depth == 0 and token.is_mark("="):
            return at
    return None


def _product(factors: Sequence[tuple[str, Node]]) -> Node:
    if len(factors) == 1 and not factors[0][0]:
        return factors[0][1]
    return Mul(factors[0][1].span.to(factors[-1][1].span), tuple(factors))


def _split(tokens: Sequence[Token], separates: Callable[[Token], bool]) -> list[list[Token]]:
    """Split tokens at the separators outside of brackets, braces and environments."""
    pieces: list[list[Token]] = [[]]
    depth = 0
    for token in tokens:
        if token.kind is Kind.OPEN or token.is_command("begin", "left", "{") or token.is_mark("(", "["):
            depth += 1
        elif token.kind is Kind.CLOSE or token.is_command("end", "right", "}") or token.is_mark(")", "]"):
            depth -= 1
        if depth <= 0 and separates(token):
            pieces.append([])
        else:
            pieces[-1].append(token)
    return pieces


def _head_of(tokens: Sequence[Token]) -> str | None:
    if not tokens:
        return None
    if tokens[0].kind is Kind.LETTER and tokens[0].text == "d":
        return "d"
    if tokens[0].is_command("partial"):
        return "partial"
    if tokens[0].is_command(*DIFFERENTIALS):
        return "d"
    if tokens[0].is_command("mathrm", "text", "operatorname", "rm"):
        value, _ = argument_at(tokens, 1)
        if "".join(each.text for each in value) == "d":
            return "d"
    return None


def _width_of_head(tokens: Sequence[Token]) -> int:
    return argument_at(tokens, 1)[1] if tokens[0].is_command("mathrm", "text", "operatorname", "rm") else 1


def _is_word(product: Mul) -> bool:
    return all(
        not mark
        and isinstance(each, Letter)
        and len(each.base) == 1
        and not each.sub
        and not each.dots
        and not each.marks
        for mark, each in product.factors
    )


def _unit(tokens: Sequence[Token]) -> str:
    r"""Return a unit after a number, `unit kg m^2` for `\mathrm{kg\,m^{2}}`; an empty text if it is not a unit."""
    pieces = ["" if each.kind in (Kind.OPEN, Kind.CLOSE) else each.text for each in tokens]
    if "".join(pieces) in ("^circ", "^degree"):
        return "degrees"
    text = "".join(" " if each in (",", ";", "cdot") else each for each in pieces)
    return f"unit {text}" if re.fullmatch(r"[A-Za-z][A-Za-z ]*(\^-?\d)?([ /]+[A-Za-z]+(\^-?\d)?)*", text) else ""


def _joined(first: str, second: str) -> str:
    return f"{first},{second}" if first and second else first or second


def _exponent(node: Node) -> Node:
    return node.exponent if isinstance(node, Pow) else Num(node.span, "1")


def _orders(node: Node) -> int:
    return node.order if isinstance(node, Diff) else 0


def _with_differential_on_top(fraction: Frac) -> list[Node] | None:
    r"""Return `\frac{dx}{1+x^2}` as `\frac{1}{1+x^2}` and `dx`; None if the top does not end with a differential."""
    top = fraction.top
    factors = [each for _, each in top.factors] if isinstance(top, Mul) else [top]
    if not isinstance(factors[-1], Diff):
        return None
    rest = factors[:-1]
    number: Node = _product([("", each) for each in rest]) if rest else Num(fraction.span, "1")
    return [replace(fraction, top=number), factors[-1]]


__all__ = ["FUNCTIONS", "Unreadable", "parsed", "tokens_of"]
