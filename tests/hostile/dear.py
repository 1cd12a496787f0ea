"""Files of hundreds of formulas, each of them sound and dear to read: what is refused for their sum."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

HEAD: Final = '[phase_space]\nq = ["q", "x", "y"]\np = ["p", "px", "py"]\n'
SYMBOLS: Final = '[symbols]\nf = "function"\nn = "integer"\nz = "complex"\na = "positive"\n'
CLAIM: Final = '[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"\n'
MANY: Final = 990


def defined(formula: str) -> str:
    """A file with as many definitions as it may have, `#` a number that is another in each."""
    lines = "".join(f'd{k} = "{formula.replace("#", str(k))}"\n' for k in range(2, MANY))
    return f"{HEAD}{SYMBOLS}[definitions]\n{lines}{CLAIM}"


def chained(first: str, formula: str) -> str:
    """Definitions, `@` the one before."""
    lines = "".join(f'd{k} = "{formula.replace("#", str(k)).replace("@", f"d{k - 1}")}"\n' for k in range(1, MANY))
    return f'{HEAD}{SYMBOLS}[definitions]\nd0 = "{first}"\n{lines}{CLAIM}'


def claimed(body: Callable[[int], str], count: int, head: str = HEAD) -> str:
    """A file of so many claims."""
    return head + "".join(f"[[claim]]\n{body(k)}\n" for k in range(1, count))


def _listed(names: Iterator[str] | list[str]) -> str:
    return "[" + ", ".join(f'"{name}"' for name in names) + "]"


_WIDE = f"[phase_space]\nq = {_listed([f'q{k}' for k in range(999)])}\np = {_listed([f'p{k}' for k in range(999)])}\n"
_FORTY = [f"c{k}" for k in range(40)]
_PAIRS = ", ".join(f'"c{i},c{j}" = "{i + 2}*c{(i + j) % 40} - c{i}"' for i in range(40) for j in range(i))
_POLYNOMIAL = "+".join(f"{k}*q**{k}*p**{k % 9}" for k in range(1, 600))

DEAR: Final = {
    "derivatives": defined("D(sin(#*q*p)*exp(q*p), q, 3)"),
    "derivatives of gamma": defined("D(gamma(q + #), q, 3)"),
    "derivatives of any function": defined("D(D(f(q*#, p, x, y, q*p), q), p)"),
    "derivatives of high order": defined("D(sin(#*q), q, 20)"),
    "derivatives of kinks": defined("D(abs(q*p - #), q)"),
    "brackets": defined("bracket(sin(#*q*sin(q*p)), exp(q*p)*sin(p))"),
    "functions in functions": defined("sin(cos(tan(exp(q/#))))"),
    "functions that cancel": defined("asin(sin(#)) + acos(cos(#))"),
    "absolute values": defined("abs(z - #) + abs(a*q*(p - #))"),
    "of whole numbers": defined("cos(n*pi/#) + tan(n*q + #)"),
    "roots of numbers": defined("sqrt(#00000000000000000000000000000000000000000000000000037)*q"),
    "any functions": defined(" + ".join(f"f(#00{k}*q)" for k in range(60))),
    "powers in powers": defined("(" * 60 + "q + #" + " + 1)**2" * 60),
    "quotients in quotients": defined("q/(p + #/(" * 30 + "1" + "))" * 30),
    "powers of numbers": defined(" + ".join(f"3**(#*5 + {k})*q" for k in range(9))),
    "conditions in conditions": chained("1/q", "@ + 1/(q - #)"),
    "surfaces": f"{HEAD}[domain]\non = {_listed([f'(q + {k}*p + x)**5 - {k}' for k in range(MANY)])}\n{CLAIM}",
    "chains of inequalities": f"{HEAD}[domain]\nwhere = "
    + _listed(["<".join(f"q+{j * k}" for j in range(60)) for k in range(1, MANY)]) + f"\n{CLAIM}",
    "long sums": claimed(
        lambda k: f'kind = "bracket"\nf = "{_POLYNOMIAL.replace("+", f"+{k}*")}"\ng = "p"\nequals = "1"', 80
    ),
    "brackets in many variables": claimed(
        lambda k: f'kind = "bracket"\nf = "q1"\ng = "p1"\nequals = "bracket(q{k % 900}, p2)"', 7000, _WIDE
    ),
    "claims in many variables": _WIDE + CLAIM.replace('"q"', '"q1"').replace('"p"', '"p1"') * 12_000,
    "claims of unknown kinds": claimed(lambda k: f'kind = "brackt{k}"', 30_000),
    "claims that end too early": claimed(
        lambda k: f'kind = "bracket"\nf = "{"+".join(f"q*{j}" for j in range(60))}+"\ng = "p"\nequals = "{k}"', 2000
    ),
    "structure constants": claimed(
        lambda k: f'kind = "casimir"\nf = "{k}*c1"\ncoordinates = {_listed(_FORTY)}\nstructure = {{{_PAIRS}}}', 40
    ),
    "matrices": '[[claim]]\nkind = "matrix_algebra"\nequals = "so(3)"\n[claim.basis]\nA = ['
    + ", ".join(_listed([str(i * j % 7) for j in range(380)]) for i in range(380)) + "]\n",
}  # fmt: skip
"""Claim files, by what is dear in them."""

_SCENE = "[[body]]\nmass = 1\ncharge = 1\nposition = [1, 0, 0]\n[run]\nduration = 1\n"
SCENES: Final = {
    "potentials": _SCENE + "".join(
        f'[[effect]]\nkind = "potential"\nV = "sin({k}*x*sin(y)) + cos({k}*z*cos(x))"\n' for k in range(1, 900)
    ),
    "constants": "[constants]\n" + "".join(f'c{k} = "sin(pi*{k}/91) + gamma({k}/7)"\n' for k in range(1, 900)) + _SCENE,
}  # fmt: skip
"""Scenes of the same kind."""
