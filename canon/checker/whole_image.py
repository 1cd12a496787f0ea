"""Is the image of a map of one pair, old variables by new ones, the whole plane, or all of it but the origin?

Both rules are of maps whose formulas have values for all Q, and for all P or all P > 0, whatever the parameters are;
nothing else is demanded of Q and P.

- Of an affine map the image is the plane where its determinant {q, p} is 0 nowhere.
- Let ∂²q/∂Q² = −α² q with a constant α that is 0 nowhere, p = κ ∂q/∂Q with a constant κ, and R = α² q² + (∂q/∂Q)² be
  P ∂R/∂P, with ∂R/∂P > 0, and α² p² + (∂p/∂Q)² not be 0, so that κ isn't either. By the first, (α q, ∂q/∂Q) turns round
  the circle R = const as Q runs through all numbers. R is a positive multiple of P. So the image is the plane without
  the origin.

The origin is on no closed orbit where H is smooth and has no slope there. A separatrix may tend to it, so that an
energy that is one value is to be another one.
"""

from __future__ import annotations

from collections.abc import Iterator

from canon.checker.defined import unseen
from canon.checker.followed import at_random, is_identity
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.shapes import has_complex
from canon.checker.statement import Statement

ENTIRE = ("sin", "cos", "exp", "sinh", "cosh")
UNSAID = {"real"}
ABOVE = {"real", "positive", "nonnegative"}


def is_whole(s: Statement) -> bool:
    """Whether the claim, of an action or a frequency, is seen to be about orbits in the image of the file's map."""
    if s.direction != "backward" or len(s.q) != 1 or len(s.Q) != 1 or s.surface or has_complex(s):
        return False
    if s.claim["kind"] not in ("action", "frequency") or _says_of_new_ones(s):
        return False
    texts, Q, P = [*s.old, *unseen(s)], s.Q[0], s.P[0]
    if _moves(s, s.time, *texts) or not {*s.words.get(Q, ())} <= UNSAID:
        return False
    if {*s.words.get(P, ())} <= UNSAID and _is_affine(s, texts):
        return True
    return {*s.words.get(P, ())} <= ABOVE and _rests_at_the_origin(s) and _has_other_energies(s) and _turns(s, texts)


def _moves(s: Statement, name: str, *formulas: int) -> bool:
    return any(s.f.ops[b] == ("s", name) for b in s.f.reach(*formulas))


def _says_of_new_ones(s: Statement) -> bool:
    """Whether a condition of the file's, as it is written, has a new variable in it."""
    images, s.images = s.images, {}
    written = [a for text in s.domain.get("where", []) for a, _ in s.relation(text)]
    s.images = images
    return any(_moves(s, name, *written, *s.f.unseen) for name in (*s.Q, *s.P))


def _is_affine(s: Statement, texts: list[int]) -> bool:
    """Whether all that moves with Q and P is a polynomial in them, and of first degree."""
    f, values, (q, p), news = s.f, at_random(s), s.old, (s.Q[0], s.P[0])
    if not all(_has_values(s, a, [], news) for a in f.reach(*texts)):
        return False
    bracket = f.bracket(q, p, [news])
    if not (is_nowhere_zero(s, bracket) or is_identity(values, f.sub(bracket, f.number(1)))):
        return False
    return all(is_identity(values, f.slope(f.slope(x, u), v)) for x in (q, p) for u in news for v in news)


def _turns(s: Statement, texts: list[int]) -> bool:
    f, values, (q, p), Q, P = s.f, at_random(s), s.old, s.Q[0], s.P[0]
    rates = {f.slope(f.ops[a][3][0], Q) for a in f.reach(*texts) if f.ops[a][:2] in (("f", "sin"), ("f", "cos"))}
    rates -= {f.number(0)}
    if len(rates) != 1:
        return False
    (rate,) = rates
    if _moves(s, Q, rate) or _moves(s, P, rate) or not is_nowhere_zero(s, rate):
        return False
    turned, square = f.slope(q, Q), f.mul(rate, rate)
    zeros = [f.add(f.slope(turned, Q), f.mul(square, q))]
    zeros += [f.sub(f.mul(f.slope(p, u), turned), f.mul(p, f.slope(turned, u))) for u in (Q, P)]
    for x in (q, p):
        circle = f.add(f.mul(square, x, x), f.power(f.slope(x, Q), f.number(2)))
        growth = f.slope(circle, P)
        zeros.append(f.sub(circle, f.mul(f.node("s", P), growth)))
        if not is_positive(s, growth, strict=True, real=True):
            return False
    roots = list(_roots(s, texts))
    return all(is_identity(values, a) for a in zeros) and all(_has_values(s, a, roots, (Q, P)) for a in f.reach(*texts))


def _roots(s: Statement, texts: list[int]) -> Iterator[int]:
    """Arguments of powers that are P times what is positive."""
    f, values, Q, P = s.f, at_random(s), s.Q[0], s.P[0]
    for a in f.reach(*texts):
        op = f.ops[a]
        base = op[3][0] if op[:2] == ("f", "power") else op[1] if op[0] == "^" and op[2] < 0 else None
        if base is None or not _moves(s, P, base) or _moves(s, Q, base):
            continue
        factor = f.slope(base, P)
        rest = f.sub(base, f.mul(f.node("s", P), factor))
        if _moves(s, P, factor) or not is_identity(values, rest):
            continue
        if is_positive(s, factor, strict=True, real=True):
            yield base


def _has_values(s: Statement, a: int, positive: list[int], news: tuple[str, str]) -> bool:
    """Whether one step of a formula has a value at all parameters, where these are positive at all new variables.

    What doesn't move with new variables is asked to have a sign: else it would bound the parameters.
    """
    f, op = s.f, s.f.ops[a]
    if op[0] in "ns+*" or (op[0] == "^" and op[2] > 0) or (op[0] == "f" and op[1] in ENTIRE):
        return True
    power = op[:2] == ("f", "power")
    if op[0] != "^" and not power:
        return False
    base = op[3][0] if power else op[1]
    if power and (f.value(op[3][1]) is None):
        return False
    if any(_moves(s, name, base) for name in news):
        # 1/√(2P) is the power −1 of a root of what is positive
        inner = f.ops[base]
        return base in positive or (not power and inner[:2] == ("f", "power") and inner[3][0] in positive)
    return is_positive(s, base, strict=True, real=True) if power else is_nowhere_zero(s, base)


def _rests_at_the_origin(s: Statement) -> bool:
    """Whether H is smooth in q and p everywhere, and has no slopes where they are 0."""
    f, (q,), (p,), values = s.f, s.q, s.p, at_random(s)
    for a in f.reach(s.H, *s.f.unseen):
        op = f.ops[a]
        sure = op[0] in "ns+*" or (op[0] == "^" and op[2] > 0) or (op[0] == "f" and op[1] in ENTIRE)
        if not sure and (_moves(s, q, a) or _moves(s, p, a)):
            return False
    origin = {q: f.number(0), p: f.number(0)}
    return all(is_identity(values, f.substitute(f.slope(s.H, x), origin)) for x in (q, p))


def _has_other_energies(s: Statement) -> bool:
    """Whether the claim's energy, if it is one value, isn't that of the origin."""
    f, fixed, name = s.f, s.claim.get("fixed", {}), s.claim["energy"]
    if name not in fixed:
        return True
    rules = {x: f.read(text, s.names) for x, text in fixed.items()}
    origin = f.substitute(s.H, {s.q[0]: f.number(0), s.p[0]: f.number(0)})
    gap = f.sub(rules[name], f.substitute(origin, {x: a for x, a in rules.items() if x != name}))
    signs = (gap, f.mul(f.number(-1), gap))
    return is_nowhere_zero(s, gap) or any(is_positive(s, a, strict=True, real=True) for a in signs)
