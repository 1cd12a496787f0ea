"""Derivatives, substitution and brackets on the tape, without going back to sympy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from canon.decide.tape import ONE, Node, Tape, Unsupported

HALF = Fraction(1, 2)


def derivative(tape: Tape, node: Node, variable: Node) -> Node:
    """The partial derivative of a node by a symbol node (each node differentiated once)."""
    known = tape.derivatives.setdefault(variable, {})
    if node in known:
        return known[node]
    stack = [node]
    while stack:
        top = stack[-1]
        if top in known:
            stack.pop()
            continue
        if variable not in tape.support(top):
            known[top] = tape.zero
            stack.pop()
            continue
        pending = [a for a in tape.arguments(top) if a not in known]
        if pending:
            stack.extend(pending)
            continue
        known[top] = _rule(tape, top, variable, known)
        stack.pop()
    return known[node]


def gradient(tape: Tape, node: Node, variables: Sequence[Node]) -> list[Node]:
    """The partial derivatives of a node by each of the symbol nodes."""
    return [derivative(tape, node, variable) for variable in variables]


def poisson_bracket(tape: Tape, f: Node, g: Node, q: Sequence[Node], p: Sequence[Node]) -> Node:
    """{f, g} = Σ ∂f/∂q ∂g/∂p − ∂f/∂p ∂g/∂q, with only the derivatives that it needs."""
    terms: list[tuple[Node, Fraction]] = []
    in_f, in_g = tape.support(f), tape.support(g)
    for x, y in zip(q, p, strict=True):
        if x in in_f and y in in_g:
            terms.append(_term(tape, derivative(tape, f, x), derivative(tape, g, y), ONE))
        if y in in_f and x in in_g:
            terms.append(_term(tape, derivative(tape, f, y), derivative(tape, g, x), -ONE))
    return tape.add(terms)


def _term(tape: Tape, a: Node, b: Node, sign: Fraction) -> tuple[Node, Fraction]:
    """sign · a · b as a node with its coefficient; no node is made for a product with a number."""
    value = tape.value(a)
    if value is not None:
        return b, sign * value
    value = tape.value(b)
    return (tape.times(a, b), sign) if value is None else (a, sign * value)


def substitute(tape: Tape, node: Node, mapping: Mapping[Node, Node]) -> Node:
    """The node with symbol (or constant) nodes replaced, all at once."""
    values: dict[Node, Node] = dict(mapping)
    for i in tape.reach([node]):
        if i not in values:
            values[i] = rebuild(tape, i, values)
    return values[node]


def rebuild(tape: Tape, node: Node, values: Mapping[Node, Node]) -> Node:
    """The node's operation applied to the new values of its arguments."""
    op = tape.ops[node]
    kind = op[0]
    if kind in "nsc":
        return node
    if all(values[a] == a for a in tape.arguments(node)):
        return node
    if kind == "+":
        return tape.add([(values[a], c) for a, c in op[2]], op[1])
    if kind == "*":
        return tape.mul([(values[a], e) for a, e in op[1]])
    if kind == "r":
        return tape.root(values[op[1]], Fraction(op[2], op[3]))
    if kind == "f":
        return tape.call(op[1], *(values[a] for a in op[2]))
    return tape.arbitrary(op[1], op[2], tuple(values[a] for a in op[3]))


def _rule(tape: Tape, node: Node, variable: Node, known: Mapping[Node, Node]) -> Node:
    if node == variable:
        return tape.one
    op = tape.ops[node]
    kind = op[0]
    if kind == "+":
        return tape.add([(known[a], c) for a, c in op[2]])
    if kind == "*":
        return _product_rule(tape, op[1], known)
    if kind == "r":
        return tape.mul(((node, 1), (op[1], -1), (known[op[1]], 1)), Fraction(op[2], op[3]))
    if kind == "f":
        inner = [known[a] for a in op[2]]
        terms = []
        for k, d in enumerate(inner):
            if d != tape.zero:
                terms.append((tape.times(_partial(tape, node, op[1], op[2], k), d), ONE))
        return tape.add(terms)
    if kind == "u":
        terms = []
        for k, a in enumerate(op[3]):
            if known[a] != tape.zero:
                orders = (*op[2][:k], op[2][k] + 1, *op[2][k + 1 :])
                terms.append((tape.times(tape.arbitrary(op[1], orders, op[3]), known[a]), ONE))
        return tape.add(terms)
    return tape.zero


def _product_rule(tape: Tape, factors: Sequence[tuple[Node, int]], known: Mapping[Node, Node]) -> Node:
    terms = []
    for k, (node, exponent) in enumerate(factors):
        if known[node] == tape.zero:
            continue
        rest = [(known[node], 1)]
        for k2, (other, power) in enumerate(factors):
            power = power - 1 if k2 == k else power
            if power:
                rest.append((other, power))
        terms.append((tape.mul(rest), Fraction(exponent)))
    return tape.add(terms)


def _partial(tape: Tape, node: Node, name: str, arguments: tuple[Node, ...], k: int) -> Node:
    """∂ name(arguments) / ∂ arguments[k]."""
    u = arguments[0]
    square = tape.power(u, 2)
    if name == "sin":
        return tape.call("cos", u)
    if name == "cos":
        return tape.negative(tape.call("sin", u))
    if name == "exp":
        return node
    if name == "log":
        return tape.power(u, -1)
    if name == "abs":
        if tape.is_complex(u):
            raise Unsupported("the derivative of the modulus of a complex name")
        return tape.mul(((node, 1), (u, -1)))
    if name == "atan":
        return tape.power(tape.add(((square, ONE),), 1), -1)
    if name in ("asin", "acos"):
        slope = tape.root(tape.add(((square, -ONE),), 1), -HALF)
        return slope if name == "asin" else tape.negative(slope)
    if name == "atan2":
        y, x = arguments
        radius = tape.add(((tape.power(x, 2), ONE), (tape.power(y, 2), ONE)))
        return tape.mul(((x, 1), (radius, -1))) if k == 0 else tape.mul(((y, 1), (radius, -1)), -1)
    return _special_partial(tape, node, name, arguments, k)


def _special_partial(tape: Tape, node: Node, name: str, arguments: tuple[Node, ...], k: int) -> Node:
    """Derivatives of the special functions (DLMF 4.13.4, 19.4, 22.13)."""
    if name == "integer_power" and k == 0:
        base, exponent = arguments
        return tape.mul(((exponent, 1), (node, 1), (base, -1)))
    if name == "lambertw":
        return tape.mul(((node, 1), (arguments[0], -1), (tape.add(((node, ONE),), 1), -1)))
    if name == "elliptic_k":
        m = arguments[0]
        e = tape.call("elliptic_e", m)
        rest = tape.add(((m, -ONE),), 1)
        return tape.add(((tape.mul(((e, 1), (m, -1), (rest, -1))), HALF), (tape.mul(((node, 1), (m, -1))), -HALF)))
    if name == "elliptic_e":
        m = arguments[0]
        return tape.mul(((tape.minus(node, tape.call("elliptic_k", m)), 1), (m, -1)), HALF)
    if name in ("elliptic_f", "elliptic_ei") and k == 0:
        phi, m = arguments
        delta = tape.add(((tape.times(m, tape.power(tape.call("sin", phi), 2)), -ONE),), 1)
        return tape.root(delta, -HALF if name == "elliptic_f" else HALF)
    if name in ("elliptic_f", "elliptic_ei"):
        phi, m = arguments
        f, e = tape.call("elliptic_f", phi, m), tape.call("elliptic_ei", phi, m)
        if name == "elliptic_ei":
            return tape.mul(((tape.minus(e, f), 1), (m, -1)), HALF)
        rest = tape.add(((m, -ONE),), 1)
        delta = tape.add(((tape.times(m, tape.power(tape.call("sin", phi), 2)), -ONE),), 1)
        last = tape.mul(((tape.call("sin", phi), 1), (tape.call("cos", phi), 1), (rest, -1), (tape.sqrt(delta), -1)))
        return tape.add(
            ((tape.mul(((e, 1), (m, -1), (rest, -1))), HALF), (tape.mul(((f, 1), (m, -1))), -HALF), (last, -HALF))
        )
    if name in ("elliptic_pi", "elliptic_pii"):
        return _third_kind_partial(tape, node, arguments, k)
    if name.startswith("jacobi_"):
        return _jacobi_partial(tape, name, arguments, k)
    raise Unsupported(f"the derivative of {name} by its argument {k + 1}")


def _third_kind_partial(tape: Tape, node: Node, arguments: tuple[Node, ...], k: int) -> Node:
    """Derivatives of Π(n, m) and Π(n, φ, m) (the formulas of canon.special)."""
    n, *phi, m = arguments
    apart, below_n, below_m = tape.minus(m, n), tape.add(((n, ONE),), -1), tape.add(((m, ONE),), -1)
    first = tape.call("elliptic_f" if phi else "elliptic_k", *phi, m)
    second = tape.call("elliptic_ei" if phi else "elliptic_e", *phi, m)
    if phi:
        sine, cosine = tape.call("sin", phi[0]), tape.call("cos", phi[0])
        square = tape.power(sine, 2)
        root = tape.sqrt(tape.add(((tape.times(m, square), -ONE),), 1))
        under = tape.add(((tape.times(n, square), -ONE),), 1)
        if k == 1:
            return tape.mul(((root, -1), (under, -1)))
        arc = tape.mul(((n, 1), (root, 1), (under, -1)) if k == 0 else ((m, 1), (root, -1)))
        second = tape.minus(second, tape.times(arc, sine, cosine))
    if k == 0:
        rest = tape.times(tape.minus(tape.power(n, 2), m), node)
        terms = (
            (tape.mul(((second, 1), (apart, -1), (below_n, -1))), HALF),
            (tape.mul(((first, 1), (n, -1), (below_n, -1))), HALF),
            (tape.mul(((rest, 1), (n, -1), (apart, -1), (below_n, -1))), HALF),
        )
        return tape.add(terms)
    inner = tape.plus(tape.mul(((second, 1), (below_m, -1))), node)
    return tape.mul(((inner, 1), (apart, -1)), -HALF)


def _jacobi_partial(tape: Tape, name: str, arguments: tuple[Node, ...], k: int) -> Node:
    """Derivatives of sn, cn, dn and epsilon by u (k = 0) and by m (the formulas of canon.special)."""
    u, m = arguments
    sn, cn, dn, epsilon = (tape.call(f"jacobi_{which}", u, m) for which in ("sn", "cn", "dn", "epsilon"))
    if k == 0:
        if name == "jacobi_sn":
            return tape.times(cn, dn)
        if name == "jacobi_cn":
            return tape.negative(tape.times(sn, dn))
        return tape.negative(tape.times(m, sn, cn)) if name == "jacobi_dn" else tape.power(dn, 2)
    rest = tape.add(((m, -ONE),), 1)
    if name == "jacobi_epsilon":
        terms = (
            (tape.times(sn, cn, dn), HALF), (tape.times(rest, u, sn, sn), -HALF), (tape.times(epsilon, cn, cn), -HALF),
        )  # fmt: skip
        return tape.times(tape.add(terms), tape.power(rest, -1))
    fall = tape.minus(tape.times(rest, u), epsilon)
    if name == "jacobi_dn":
        inner = tape.plus(tape.times(cn, fall), tape.times(sn, dn))
        return tape.mul(((sn, 1), (inner, 1), (rest, -1)), -HALF)
    inner = tape.plus(tape.times(dn, fall), tape.times(m, sn, cn))
    other, sign = (cn, HALF) if name == "jacobi_sn" else (sn, -HALF)
    return tape.mul(((other, 1), (inner, 1), (m, -1), (rest, -1)), sign)
