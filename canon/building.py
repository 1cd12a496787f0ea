"""From the tree of a formula to its sympy expression, with the conditions under which it is smooth.

Each operation first adds the conditions of what was written and only then hands its values to sympy, which may merge
them.
"""

from __future__ import annotations

from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.calls import function
from canon.constants import check_constant_condition, check_constant_power
from canon.domain import Condition, function_conditions, hardened, leans_on_kinks, nonzero, power_conditions, stricter
from canon.errors import InputError
from canon.functions import FUNCTIONS, applied
from canon.measure import AGAIN, CALL, Measure, check_power, check_product, check_sum
from canon.slope import differentiated
from canon.syntax import Call, Name, Node, Number, Power, Product, Sum, children, place
from canon.vocabulary import CALLABLE, CONSTANTS, Vocabulary, written_functions, written_names

_ROOTS: Final = {"sqrt": sp.Rational(1, 2), "cbrt": sp.Rational(1, 3)}
_HIGHEST: Final = 20
_WRONG: Final = "the definition"
_SYMPY_GIVES_UP: Final = (ArithmeticError, AttributeError, LookupError, NotImplementedError, TypeError, ValueError)


class Builder:
    """Builds one text's expressions and gathers their conditions on the way."""

    def __init__(self, text: str, vocabulary: Vocabulary, measure: Measure | None = None) -> None:
        self.text = text
        self.vocabulary = vocabulary
        self.measure = (measure or Measure()).begin(text)
        self.conditions: dict[Condition, Condition] = {}
        self.names: set[str] = set()
        self.calls: set[tuple[str, int]] = set()
        self.slopes: set[tuple[str, str]] = set()
        self.granted: dict[tuple[Any, tuple[Any, ...]], None] = {}
        self.has_bracket = False

    def source(self, node: Node) -> str:
        """What was written for `node`, shortened if it is long."""
        start, end = node.span
        written = " ".join(self.text[start : min(end, start + 120)].split())
        return written if end - start <= 120 else written + "…"

    def value_of(self, root: Node) -> Any:
        """The value of a tree, its parts first; a loop, so that no depth of input exhausts the stack."""
        values: list[Any] = []
        stack: list[tuple[Node, bool]] = [(root, False)]
        while stack:
            node, ready = stack.pop()
            parts = self.parts(node)
            if not ready and parts:
                stack.append((node, True))
                stack.extend((part, False) for part in reversed(parts))
                continue
            arguments = values[len(values) - len(parts) :]
            del values[len(values) - len(parts) :]
            try:
                values.append(self.measure.admit(self.build(node, arguments)))
            except _SYMPY_GIVES_UP:
                at = place(self.text, node.span[0])
                raise InputError(f"{self.source(node)!r} {at} is out of sympy's reach") from None
            except InputError as error:
                at = place(self.text, node.span[0])
                message = error.message if " at column " in error.message or " at line " in error.message else ""
                raise InputError(message or f"{error.message} (in {self.source(node)!r} {at})") from None
        return values[0]

    def parts(self, node: Node) -> tuple[Node, ...]:
        """The parts that have a value: not the variable and the order of a derivative."""
        if isinstance(node, Call) and node.name == "D" and not self.vocabulary.declares("D"):
            return node.arguments[:1]
        return children(node)

    def build(self, node: Node, values: list[Any]) -> Any:
        if isinstance(node, Number):
            value = sp.Rational(node.value.numerator, node.value.denominator)
            return value * sp.I if node.imaginary else value
        if isinstance(node, Name):
            return self.name(node)
        self.measure.spend(20 * len(values) + 6 * sum(len(value.args) for value in values))
        if isinstance(node, Sum):
            check_sum(values)
            return sp.Add(*(v if plus else -v for v, plus in zip(values, node.added, strict=True)))
        if isinstance(node, Product):
            return self.product(node, values)
        if isinstance(node, Power):
            return self.power(values[0], values[1], self.source(node.base))
        return self.call(node, values)

    def add(self, conditions: tuple[Condition, ...]) -> None:
        for condition in conditions:
            check_constant_condition(condition)
        self.keep(conditions)

    def keep(self, conditions: tuple[Condition, ...], operation: Any = None, *arguments: Any) -> None:
        """Take conditions down; the operation, where it demands nothing, perhaps by what is assumed of names alone."""
        for condition in conditions:
            self.conditions[condition] = stricter(self.conditions.get(condition, condition), condition)
        if operation is not None and not conditions:
            self.granted[operation, arguments] = None

    def drop_kinks(self, values: list[Any]) -> None:
        """The kinks of these values may be passed no more: there is no slope, or a condition may rest on |x| > 0."""
        bent = {name for value in values for modulus in value.atoms(sp.Abs) for name in modulus.free_symbols}
        if bent:
            self.conditions = dict(zip(self.conditions, hardened(self.conditions.values(), bent), strict=True))

    def name(self, node: Name) -> Any:
        name, vocabulary = node.name, self.vocabulary
        where = place(self.text, node.span[0])
        if name in vocabulary.definitions:
            return self.definition(name, where)
        if name in vocabulary.symbols:
            self.use(name, where)
            return vocabulary.symbols[name]
        if name in vocabulary.functions:
            raise InputError(f"{name!r} {where} is a function: it needs its arguments")
        if name in CONSTANTS:
            return CONSTANTS[name]
        if name in CALLABLE:
            raise InputError(f"{name!r} {where} is a built-in function and not declared as a name")
        raise InputError(vocabulary.unknown(name, where, compared=self.measure.compares(vocabulary.words)))

    def use(self, name: str, where: str, through: str = "") -> None:
        """Record that `name` is used. **Raises** `InputError` if it is out of place."""
        reason = self.vocabulary.refused.get(name)
        if reason is not None:
            inside = f" (in the definition {through!r})" if through else ""
            raise InputError(f"{name!r} {where}{inside} is out of place: this is {reason}")
        self.names.add(name)

    def definition(self, name: str, where: str) -> Any:
        formula = self.vocabulary.definitions[name]
        if isinstance(formula, InputError):
            first = (
                formula.message
                if formula.message.startswith(_WRONG)
                else f"{_WRONG} {name!r} is wrong: {formula.message}"
            )
            raise InputError(first)
        self.measure.spend(len(formula.names) + 2 * len(formula.conditions) + len(formula.granted) // 4)
        for inner in sorted(formula.names):
            self.use(inner, where, name)
        if formula.has_bracket:
            self.use_bracket(where)
        self.calls |= formula.calls
        self.slopes |= formula.slopes
        self.granted |= dict.fromkeys(formula.granted)
        self.add(formula.conditions)
        return formula.expr

    def product(self, node: Product, values: list[Any]) -> Any:
        check_product(values)
        factors = list[Any]()
        for part, value, straight in zip(node.factors, values, node.multiplied, strict=True):
            if not straight:
                conditions = nonzero(value, self.source(part), is_complex=self.measure.is_complex)
                self.add(conditions)
                self.keep(conditions, sp.Pow, value, sp.Integer(-1))
                self.drop_kinks([value])
                check_power(value, sp.Integer(-1))
                self.measure.spend_on_power(value, -1)
            factors.append(value if straight else value**-1)
        return sp.Mul(*factors)

    def power(self, base: Any, exponent: Any, text: str) -> Any:
        def built() -> tuple[tuple[Condition, ...], Any]:
            if not exponent.is_Integer:
                self.measure.spend_on((base,) if exponent.is_Rational else (base, exponent, exponent))
            self.measure.spend_on_power(base, exponent)
            conditions = power_conditions(base, exponent, text, is_complex=self.measure.is_complex)
            self.add(conditions)
            check_power(base, exponent)
            check_constant_power(base, exponent)
            return conditions, base**exponent

        conditions, power = self.measure.once(("power", base, exponent, text), built)
        self.keep(conditions, sp.Pow, base, exponent)
        if leans_on_kinks(sp.Pow, (base, exponent)):
            self.drop_kinks([base, exponent])
        return power

    def call(self, node: Call, values: list[Any]) -> Any:
        name, where = node.name, place(self.text, node.span[0])
        vocabulary = self.vocabulary
        if name in vocabulary.functions:
            return self.arbitrary(name, values, where)
        if vocabulary.declares(name):
            raise InputError(f"{name!r} {where} is declared as a name, not as a function: write a product with *")
        if name not in CALLABLE:
            raise InputError(vocabulary.unknown(name, where, compared=self.measure.compares(vocabulary.words)))
        if name == "D":
            return self.derivative(node, values, where)
        if name == "bracket":
            return self.bracket(node, values, where)
        texts = tuple(self.source(argument) for argument in node.arguments)
        if name in _ROOTS:
            self.count(name, len(values), (1,), where)
            return self.power(values[0], _ROOTS[name], texts[0])
        function, counts = FUNCTIONS[name]
        self.count(name, len(values), counts, where)
        return self.function(function, values, texts)

    def count(self, name: str, given: int, wanted: tuple[int, ...], where: str) -> None:
        if given not in wanted:
            expected = " or ".join(str(n) for n in wanted)
            raise InputError(f"{name!r} {where} takes {expected} argument{'s'[: wanted != (1,)]}, not {given}")

    def function(self, function: Any, values: list[Any], texts: tuple[str, ...]) -> Any:
        def built() -> tuple[tuple[Condition, ...], Any]:
            self.measure.spend_on(values)
            conditions = function_conditions(function, tuple(values), texts, is_complex=self.measure.is_complex)
            self.add(conditions)
            is_complex = any(self.measure.is_complex(value) for value in values)
            return conditions, applied(function, values, is_complex, self.vocabulary.has_integers)

        conditions, value = self.measure.once((function, *values, texts), built)
        self.keep(conditions, function, *values)
        if leans_on_kinks(function, values):
            self.drop_kinks(values)
        return value

    def arbitrary(self, name: str, values: list[Any], where: str) -> Any:
        self.use(name, where)
        self.calls.add((name, len(values)))
        known, called = self.measure.built, (name, *values)
        self.measure.spend(AGAIN if called in known else CALL // 2)
        known[called] = value = function(name)(*values)
        self.keep((), AppliedUndef, value)
        sign = self.vocabulary.signs.get(name)
        if sign == "nonzero":
            self.add((Condition("nonzero", (value,)),))
        elif sign is not None:
            self.add((Condition("positive", (value if sign == "positive" else -value,)),))
        return value

    def derivative(self, node: Call, values: list[Any], where: str) -> Any:
        self.count("D", len(node.arguments), (2, 3), where)
        variable, order = node.arguments[1], 1
        symbol = self.vocabulary.symbols.get(variable.name) if isinstance(variable, Name) else None
        if symbol is None or not isinstance(variable, Name):
            raise InputError(f"D {where} is with respect to a name, not to {self.source(variable)!r}")
        self.use(variable.name, place(self.text, variable.span[0]))
        if symbol.is_integer:
            raise InputError(f"D {where} is with respect to {variable.name!r}, which is an integer")
        self.check_related(node.arguments[0], variable.name, where)
        self.slopes |= {(variable.name, f) for f in written_functions(node.arguments[0], self.vocabulary)}
        if len(node.arguments) == 3:
            times = node.arguments[2]
            if not isinstance(times, Number) or times.imaginary or times.value.denominator != 1:
                raise InputError(f"the order of D {where} is a whole number, not {self.source(times)!r}")
            order = int(times.value)
            if order > _HIGHEST:
                raise InputError(f"D {where} is of order {order}: at most {_HIGHEST}")
        self.drop_kinks(values)
        value = values[0]
        for _ in range(order):
            value = differentiated(value, symbol, self.measure)
        return value

    def check_related(self, body: Node, variable: str, where: str) -> None:
        """Old and new variables are independent as arguments of one function alone: by the map Q depends on q."""
        vocabulary, names = self.vocabulary, written_names(body, self.vocabulary)
        old, new = {x.name for pair in vocabulary.pairs for x in pair}, vocabulary.new
        for side, other, word in ((old, new, "new"), (new, old, "old")):
            if variable in side and names & other and not names & side:
                raise InputError(
                    f"D {where} is with respect to {variable!r}, but {min(names & other)!r} is one of the {word} "
                    f"variables, which depend on it by the map: write its formula"
                )

    def use_bracket(self, where: str) -> None:
        if self.vocabulary.no_bracket:
            raise InputError(f"'bracket' {where} is out of place: {self.vocabulary.no_bracket}")
        self.has_bracket = True

    def bracket(self, node: Call, values: list[Any], where: str) -> Any:
        self.count("bracket", len(values), (2,), where)
        self.use_bracket(where)
        for name in sorted(self.vocabulary.new & written_names(node, self.vocabulary)):
            raise InputError(f"'bracket' {where} is in the old variables, but {name!r} is a new one")
        f, g = values
        self.drop_kinks(values)
        terms = list[Any]()
        if inside := written_functions(node, self.vocabulary):
            self.slopes |= {(x.name, name) for pair in self.vocabulary.pairs for x in pair for name in inside}
        self.measure.spend(len(self.vocabulary.pairs) * (1 + len(inside)))
        moving = f.free_symbols | g.free_symbols
        for q, p in self.vocabulary.pairs:
            if q not in moving and p not in moving:
                continue
            df, dg = ([differentiated(h, x, self.measure) for x in (q, p)] for h in (f, g))
            terms += [df[0] * dg[1], -df[1] * dg[0]]
        return sp.Add(*terms)
