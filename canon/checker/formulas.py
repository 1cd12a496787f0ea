"""The checker's own formulas: text to a graph of operations, its derivatives, and nothing simplified but 0 and 1."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from canon.checker import language
from canon.checker.functions import SLOPES, Unknown, Unreadable
from canon.checker.language import LONGEST

MOST, BITS = 50_000, 40_000
"""The most operations of a certificate, and bits of a number."""
Words = Mapping[str, Sequence[str]]
ZERO, ONE = 0, 1
"""The nodes of these numbers."""


class Formulas:
    """Operations ("n", value), ("s", name), ("+", a, b), ("*", a, b), ("^", a, n), ("f", name, orders, arguments).

    Equal ones are one number. ("f", "power", (), (a, b)) is a**b; `orders` count the derivatives of one of the declared
    `functions`; `pairs` are the names (q, p) by which `bracket` differentiates.
    """

    def __init__(
        self, functions: Sequence[str] = (), pairs: Sequence[tuple[str, str]] = (), words: Words | None = None
    ) -> None:
        self.ops: list[tuple[Any, ...]] = []
        self.functions, self.pairs, self.words = functions, pairs, words or {}
        self.is_complex = any("complex" in said for said in self.words.values())
        self.taken = {*self.words} - {*functions}  # names of what is no function
        self.unseen: list[int] = []  # what stands in texts, and is in no formula: of 0·log(x) the logarithm
        self._behind = dict[str, list[int]]()  # the same of abbreviations
        self._memo, self._slopes, self._counts = dict[Any, int](), dict[tuple[int, str], int](), dict[str, int]()
        self._bodies = dict[tuple[str, tuple[int, ...]], int]()
        for value in (0, 1):
            self.number(value)

    # -- operations ---------------------------------------------------------------------------------

    def node(self, *op: Any) -> int:
        """The number of an operation."""
        if op not in self._memo:
            if len(self.ops) > MOST:
                raise Unreadable("the formulas are too large")
            self._memo[op] = len(self.ops)
            self.ops.append(op)
        return self._memo[op]

    def number(self, value: Any) -> int:
        """A rational number."""
        value = Fraction(value)
        if max(value.numerator.bit_length(), value.denominator.bit_length()) > BITS:
            raise Unreadable("a number that is too long")
        return self.node("n", value)

    def value(self, a: int) -> Fraction | None:
        """The number that a node is, None for any other."""
        return self.ops[a][1] if self.ops[a][0] == "n" else None

    def add(self, *terms: int) -> int:
        """Their sum."""
        total = ZERO
        for b in terms:
            if total == ZERO or b == ZERO:
                total = b if total == ZERO else total
            else:
                x, y = self.value(total), self.value(b)
                total = self.node("+", total, b) if x is None or y is None else self.number(x + y)
        return total

    def mul(self, *factors: int) -> int:
        """Their product."""
        total = ONE
        for b in factors:
            if b == ZERO or total == ZERO:
                return ZERO
            if total == ONE or b == ONE:
                total = b if total == ONE else total
            else:
                x, y = self.value(total), self.value(b)
                total = self.node("*", total, b) if x is None or y is None else self.number(x * y)
        return total

    def sub(self, a: int, b: int) -> int:
        """a - b."""
        return self.add(a, self.mul(self.number(-1), b))

    def over(self, a: int, b: int) -> int:
        """a / b."""
        return self.mul(a, self.power(b, self.number(-1)))

    def power(self, a: int, b: int) -> int:
        """a**b."""
        x, n = self.value(a), self.value(b)
        if n is None or n.denominator != 1:
            return self.node("f", "power", (), (a, b))
        if abs(n) > 10_000 or (x and x.numerator.bit_length() * abs(n) > 1e5) or (x == 0 and n < 0):
            raise Unreadable(f"a power with the exponent {n} that is too large, or of 0")
        return self.number(x ** int(n)) if x is not None else a if n == 1 else self.node("^", a, int(n))

    def parts(self, a: int) -> tuple[int, ...]:
        """The nodes that a node is made of."""
        op = self.ops[a]
        return op[1:] if op[0] in "+*" else op[1:2] if op[0] == "^" else op[3] if op[0] == "f" else ()

    def reach(self, *targets: int) -> list[int]:
        """The nodes below the targets and these, each after those that it is made of."""
        seen, stack = set(targets), list(targets)
        while stack:
            new = [b for b in self.parts(stack.pop()) if b not in seen]
            seen.update(new)
            stack.extend(new)
        return sorted(seen)

    def rational(self, targets: Sequence[int]) -> tuple[list[int], list[int]]:
        """The sums, products, powers and numbers that the targets are made of, and the functions and names in these."""
        seen, stack = set(targets), list(targets)
        while stack:
            a = stack.pop()
            new = [b for b in self.parts(a) if b not in seen] if self.ops[a][0] != "f" else []
            seen.update(new)
            stack.extend(new)
        leaves = [a for a in sorted(seen) if self.ops[a][0] in "sf"]
        return [a for a in sorted(seen) if self.ops[a][0] not in "sf"], leaves

    def substitute(self, target: int, images: Mapping[str, int]) -> int:
        """The formula with names replaced, all at once."""
        new: dict[int, int] = {}
        for a in self.reach(target) if images else ():
            named = self.ops[a][0] == "s"
            new[a] = images.get(self.ops[a][1], a) if named else self.rebuilt(a, [new[b] for b in self.parts(a)])
        return new.get(target, target)

    def at(self, target: int, images: Mapping[str, int]) -> list[int]:
        """The functions that a formula is made of, with names replaced: of x·log x at 0 it is log 0, which 0 is not."""
        return [self.substitute(a, images) for a in self.reach(target) if self.ops[a][0] == "f"]

    def rebuilt(self, a: int, parts: Sequence[int]) -> int:
        """The operation of a node, applied to other nodes."""
        op = self.ops[a]
        if op[0] in "ns":
            return a
        if op[0] == "f" and op[1] != "power":
            return self.node("f", op[1], op[2], tuple(parts))
        rule = {"+": self.add, "*": self.mul, "^": self.power, "f": self.power}[op[0]]
        return rule(*parts, *([self.number(op[2])] if op[0] == "^" else []))

    def put_in(self, target: int, solution: Mapping[str, tuple[Sequence[str], int]]) -> int:
        """The formula with declared functions replaced, each by (names of its arguments, formula)."""
        new: dict[int, int] = {}
        for a in self.reach(target):
            op, parts = self.ops[a], [new[b] for b in self.parts(a)]
            if op[0] == "f" and op[1] in solution:
                names, body = solution[op[1]]
                for name, order in zip(names, op[2], strict=True):
                    for _ in range(order):
                        body = self.slope(body, name)
                new[a] = self.substitute(body, dict(zip(names, parts, strict=True)))
            else:
                new[a] = self.rebuilt(a, parts)
        return new[target]

    def body(self, text: str, orders: tuple[int, ...]) -> int:
        """A formula in a1, a2, … (a, where it is one), differentiated; its arguments are called #1, #2, …"""
        if (text, orders) not in self._bodies:
            marks = [f"#{k}" for k in range(1, len(orders) + 1)]
            nodes = [self.node("s", mark) for mark in marks]
            own = {"a": nodes[0], **{f"a{k}": node for k, node in enumerate(nodes, 1)}}
            body = language.read(self, text, own, plain=True)
            for mark, order in zip(marks, orders, strict=True):
                for _ in range(order):
                    body = self.slope(body, mark)
            self._bodies[text, orders] = body
        return self._bodies[text, orders]

    # -- derivatives --------------------------------------------------------------------------------

    def slope(self, target: int, name: str) -> int:
        """The partial derivative by a name."""
        for a in self.reach(target):
            if (a, name) not in self._slopes:
                op, parts = self.ops[a], self.parts(a)
                slopes = [self._slopes[b, name] for b in parts]
                if op[0] == "s":
                    self._slopes[a, name] = self.number(int(op[1] == name))
                elif op[0] == "*" and op[1] == ZERO:
                    self._slopes[a, name] = a if slopes[1] != ZERO else ZERO
                else:
                    terms = [self.mul(self._partial(a, k), d) for k, d in enumerate(slopes) if d != ZERO]
                    self._slopes[a, name] = self.add(*terms)
        return self._slopes[target, name]

    def _partial(self, a: int, k: int) -> int:
        """The derivative of an operation by the k-th node that it is made of."""
        op, parts = self.ops[a], self.parts(a)
        if op[0] == "+":
            return self.number(1)
        if op[0] == "*":
            return parts[1 - k]
        if op[0] == "^":
            return self.mul(self.number(op[2]), self.power(parts[0], self.number(op[2] - 1)))
        if op[1] in self.functions:
            return self.node("f", op[1], tuple(n + (j == k) for j, n in enumerate(op[2])), parts)
        if op[1] == "power":
            return self.mul(a, self.node("f", "log", (), parts[:1]) if k else self.over(parts[1], parts[0]))
        if op[1] in ("abs", "sign") and self._may_be_complex(parts[0]):
            raise Unknown(f"the derivative of {op[1]} beside complex numbers")
        if op[1] == "sign":  # 0 times what jumps: who asks whether a slope moves is told so
            return self.node("*", ZERO, a)
        slopes = SLOPES.get(f"{op[1]}/{len(parts)}", SLOPES[op[1]])
        if k >= len(slopes):
            raise Unknown(f"the derivative of {op[1]} by its argument {k + 1}")
        return language.read(self, slopes[k], dict(zip("uvw", parts, strict=False)), plain=True)

    def _may_be_complex(self, a: int) -> bool:
        """Whether a formula isn't seen to be real by its names and operations, in a file with complex numbers."""
        ops = [self.ops[b] for b in self.reach(a)]
        plain = all(op[0] != "f" for op in ops)
        real = all(op[0] != "s" or (op[1] != "1j" and "complex" not in self.words.get(op[1], ())) for op in ops)
        return not real or (self.is_complex and not plain)

    def bracket(self, a: int, b: int, pairs: Sequence[tuple[str, str]]) -> int:
        """Poisson's bracket."""
        d, mul = self.slope, self.mul
        return self.add(*(self.sub(mul(d(a, q), d(b, p)), mul(d(a, p), d(b, q))) for q, p in pairs))

    # -- text ---------------------------------------------------------------------------------------

    def tree(self, text: Any) -> tuple[ast.expr, bytes]:
        """The tree of a text, and the text with the marks that its names have there. Raises Unreadable."""
        return language.tree(text)

    def abbreviate(self, name: str, text: Any, names: dict[str, int]) -> None:
        """An abbreviation: what stands unseen in it stands where it is used."""
        before = len(self.unseen)
        names[name] = self.read(text, names)
        self._behind[name] = self.unseen[before:]
        del self.unseen[before:]

    def read(self, text: Any, names: Mapping[str, int]) -> int:
        """The formula of a text; `names` are abbreviations, any other name stands for itself."""
        return language.read(self, text, names)

    def apart(self, text: Any, names: Mapping[str, int]) -> int:
        """A formula that the claim doesn't state: what stands unseen in it bounds no domain of the claim's."""
        before = len(self.unseen)
        found = self.read(text, names)
        del self.unseen[before:]
        return found

    def behind(self, name: str) -> list[int]:
        """What stands unseen in an abbreviation."""
        return self._behind.get(name, [])

    def has_arguments(self, name: str, count: int) -> bool:
        """Whether a declared function has so many arguments: those that it is called with first."""
        return name in self.functions and self._counts.setdefault(name, count) == count

    def call(self, name: str, orders: Sequence[int], arguments: Sequence[int]) -> int:
        """The value of a function, a derivative or a bracket."""
        return language.call(self, name, orders, arguments)

    def text(self, a: int) -> str:
        """The formula as text."""
        texts: dict[int, str] = {}
        for b in self.reach(a):
            op, parts = self.ops[b], [texts[x] for x in self.parts(b)]
            if not parts:
                texts[b] = str(op[1]) if op[0] == "s" or op[1].denominator == 1 else f"({op[1]})"
            elif op[0] != "f" or op[1] == "power":
                sign = {"^": "**", "f": "**"}.get(op[0], op[0])
                texts[b] = f"({sign.join([*parts, *([str(op[2])] if op[0] == '^' else [])])})"
            else:
                texts[b] = f"{op[1]}{list(op[2]) if any(op[2]) else ''}({', '.join(parts)})"
            if len(texts[b]) > LONGEST:
                raise Unknown("a formula that is too long to be written down")
        return texts[a]
