"""Poisson and Lagrange brackets, and the matrix J.

Sign: {f, g} = sum_i (df/dq_i dg/dp_i - df/dp_i dg/dq_i), so {q, p} = 1. Other conventions: `conventions`.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import sympy as sp

from canon.display import latex
from canon.errors import InputError
from canon.expected import instance_of, listed, text, whole_number
from canon.expression import Formula
from canon.mechanics.extent import recursion_told
from canon.mechanics.formulas import Expression, as_expression, check_symbols
from canon.mechanics.phase_space import PhaseSpace, check_space

MOST_DEGREES: Final = 500
"""The most degrees of freedom of a matrix that is made of nothing but their number: 10⁶ entries, a few seconds."""


def standard_j(n: int) -> sp.ImmutableMatrix:
    """J = [[0, 1], [-1, 0]] with n-by-n blocks: the matrix of the brackets of (q, p)."""
    n = whole_number(n, "n", 0, MOST_DEGREES)
    return sp.ImmutableMatrix(2 * n, 2 * n, lambda i, j: int(j == i + n) - int(i == j + n))


def poisson_bracket(f: Expression, g: Expression, space: PhaseSpace) -> sp.Expr:
    """{f, g} in the old variables of `space`. Goldstein, Poole and Safko (2002), eq. 9.67.

    **Raises:** `InputError` for functions of new variables.
    """
    check_space(space)
    with recursion_told():
        values = as_expression(f), as_expression(g)
        check_functions(values, space)
        return bracket_in(*values, space.q, space.p)


def check_functions(functions: Iterable[Formula | sp.Expr], space: PhaseSpace, where: str = "") -> None:
    """**Raises** `InputError` for what is no function of the old variables: {Q, P} of new ones isn't 0."""
    functions = tuple(functions)
    check_symbols(functions, space.vocabulary, where)
    for f in functions:
        for symbol in sorted((f.expr if isinstance(f, Formula) else f).free_symbols & {*space.new}, key=str):
            advice = "put the formula that it stands for in its place"
            raise InputError(f"{symbol} is one of the new variables, and brackets are in the old ones: {advice}", where)


def bracket_in(f: sp.Expr, g: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> sp.Expr:
    """{f, g} in the canonical variables `q`, `p`."""
    terms = []
    for x, y in zip(q, p, strict=True):
        terms.append(f.diff(x) * g.diff(y))
        terms.append(-f.diff(y) * g.diff(x))
    return sp.Add(*terms)


def lagrange_bracket(u: sp.Symbol, v: sp.Symbol, q: Sequence[Expression], p: Sequence[Expression]) -> sp.Expr:
    """[u, v] = sum_i (dq_i/du dp_i/dv - dp_i/du dq_i/dv), for q and p as functions of u, v and other variables.

    Goldstein, Poole and Safko (2002), eq. 9.79; the matrix of these is inverse (up to sign) to that of the {u, v}.
    """
    for name, value in (("u", u), ("v", v)):
        instance_of(value, sp.Symbol, name)
    q, p = listed(q, "formulas", "q"), listed(p, "formulas", "p")
    if len(q) != len(p):
        raise InputError(f"{len(q)} coordinates and {len(p)} momenta", "q, p")
    terms = []
    for x, y in zip(map(as_expression, q), map(as_expression, p), strict=True):
        terms.append(x.diff(u) * y.diff(v))
        terms.append(-y.diff(u) * x.diff(v))
    return sp.Add(*terms)


LONG_ENTRY: Final = 300
"""Entries with more operations are shown as they are."""


@dataclass(frozen=True)
class BracketMatrix:
    """The antisymmetric matrix of the brackets of some functions, with the names to show it by."""

    matrix: sp.ImmutableMatrix
    names: tuple[str, ...]

    def entry(self, first: str, second: str) -> Any:
        """The bracket of two of the functions by name; **raises** `InputError` for a name that is none of them."""
        for name in (first, second):
            if name not in self.names:
                raise InputError(f"{name!r} is none of {', '.join(self.names)}")
        return self.matrix[self.names.index(first), self.names.index(second)]

    def residual(self, expected: sp.MatrixBase) -> sp.ImmutableMatrix:
        """The matrix less what it should be."""
        return sp.ImmutableMatrix(self.matrix - expected)

    def _repr_latex_(self) -> str:
        head = " & ".join(["\\{\\cdot,\\cdot\\}", *self.names])
        rows = [
            " & ".join([name, *(latex(_shown(self.matrix[i, j])) for j in range(len(self.names)))])
            for i, name in enumerate(self.names)
        ]
        body = " \\\\ ".join([head + " \\\\ \\hline " + rows[0], *rows[1:]])
        return f"$\\begin{{array}}{{c|{'c' * len(self.names)}}} {body} \\end{{array}}$"


def _shown(entry: Any) -> Any:
    """An entry over one denominator, for reading: x**2/r**2 + y**2/r**2 is 1. What is long stays as it is."""
    if sp.count_ops(entry) > LONG_ENTRY:
        return entry
    above, below = sp.fraction(sp.together(entry))
    return sp.cancel(sp.expand(above) / below)


def bracket_matrix(functions: Sequence[Expression], space: PhaseSpace, names: Sequence[str] = ()) -> BracketMatrix:
    """The Poisson brackets of all pairs of `functions` in the old variables; each pair is computed once."""
    check_space(space)
    values = [as_expression(function) for function in listed(functions, "functions", "functions")]
    if not values:
        raise InputError("no functions to take brackets of")
    check_functions(values, space)
    size = len(values)
    upper = {
        (i, j): bracket_in(values[i], values[j], space.q, space.p) for i in range(size) for j in range(i + 1, size)
    }

    def entry(i: int, j: int) -> sp.Expr:
        if i == j:
            return sp.S.Zero
        return upper[int(i), int(j)] if i < j else -upper[int(j), int(i)]

    labels = listed(names, "names", "names")
    if labels and len(labels) != size:
        raise InputError(f"{len(labels)} names of {size} functions", "names")
    for label in labels:
        text(label, "names")
    labels = labels or tuple(latex(value) for value in values)
    return BracketMatrix(sp.ImmutableMatrix(size, size, entry), labels)


def lagrange_matrix(variables: Sequence[sp.Symbol], q: Sequence[Expression], p: Sequence[Expression]) -> BracketMatrix:
    """The Lagrange brackets of all pairs of `variables`, of which q and p are functions."""
    variables = listed(variables, "symbols", "variables")
    size = len(variables)
    values = sp.ImmutableMatrix(size, size, lambda i, j: lagrange_bracket(variables[i], variables[j], q, p))
    return BracketMatrix(values, tuple(latex(variable) for variable in variables))


def jacobi_sum(f: Expression, g: Expression, h: Expression, space: PhaseSpace) -> sp.Expr:
    """{f, {g, h}} + {g, {h, f}} + {h, {f, g}}, which Jacobi's identity says is zero."""
    values = [as_expression(value) for value in (f, g, h)]
    return sp.Add(
        *(
            poisson_bracket(values[i], poisson_bracket(values[(i + 1) % 3], values[(i + 2) % 3], space), space)
            for i in range(3)
        )
    )
