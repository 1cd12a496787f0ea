"""The algebra that a few functions generate by repeated brackets (the theorem of Jacobi and Poisson).

The bracket of two integrals of the motion is an integral; whether it is a new one, linearly independent of those known,
is shown at certified points, and that the last set closes is decided exactly. On the surfaces where H and Casimirs are
constant, with a number E0 for H, coefficients may be functions of these.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

import sympy as sp

from canon.budget import Budget
from canon.claims.algebra import Basis, decided_outcome
from canon.claims.algebra_identity import DEPENDS
from canon.claims.outcome import Residual
from canon.claims.question import Question
from canon.claims.structure_constants import Found, find_constants
from canon.claims.well_formed import check_budget, check_seed
from canon.decide.derivative import poisson_bracket
from canon.decide.region import Region
from canon.decide.tape import Node
from canon.display import text_in_html
from canon.domain import Domain
from canon.errors import BudgetExceeded, InputError
from canon.expected import instance_of, listed, table, text, whole_number
from canon.expression import Formula
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.formulas import Expression, as_expression, as_formula, check_symbols
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.stated_names import as_declared
from canon.mechanics.subject import Subject
from canon.verdict import Status

LARGEST = 40


@dataclass(frozen=True, slots=True)
class Closure:
    """What functions generate.

    **Arguments:** `basis`, each name with the function or the bracket that it is; `algebra`, where it closes;
    `status`, of the statement that it does, as that algebra ("undecided" where it doesn't within the steps); `name` of
    the algebra, "" where there is none; `note`, what is not known; `cases`, where the algebra depends on the sign of a
    value E, what the functions generate where E < 0, E = 0 and E > 0: functions that are independent elsewhere may be
    dependent at E = 0, and generate less.
    """

    basis: Mapping[str, str]
    algebra: LieAlgebra | None
    status: Status
    name: str
    note: str = ""
    cases: Mapping[str, Closure] = field(default_factory=dict)

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        lines = [f"{self.status}: {self.name or 'no algebra'}, of dimension {len(self.basis)}"]
        lines += [f"  {name} = {text}" for name, text in self.basis.items()]
        lines += [f"  {case}: {found.name}, of dimension {len(found.basis)}" for case, found in self.cases.items()]
        return "\n".join([*lines, *([f"  {self.note}"] if self.note else [])])


def closure(
    space: PhaseSpace,
    functions: Mapping[str, Expression],
    *,
    H: Expression | None = None,
    energy: sp.Symbol | str | None = None,
    over: Mapping[str, Expression] | None = None,
    steps: int = 4,
    budget: float = 30.0,
    seed: int = 0,
) -> Closure:
    """The Lie algebra that functions on phase space generate by their Poisson brackets.

    **Arguments:** `functions` by name; `over`, functions that commute with them all (H, Casimirs), each by the name of
    its value: linear dependence is then decided over functions of these, on the surfaces where they are constant, and
    structure constants may depend on their values, by powers or as polynomials. A name that is a parameter of the space
    has the sign assumed there, another one is real. `H` with `energy` is `over={energy: H}`, where
    it is called E if no name is given; `steps`, how deep brackets
    are nested; `budget` in seconds.

    **Returns:** a `Closure`; where brackets nested so deep still make something new, it says so. Where the name depends
    on the sign of one value in `over` that is no parameter of the space, each sign is a case of its own.

    **Raises:** `InputError` for functions that are linearly dependent, an energy without H, or something in `over` that
    doesn't commute with a function.
    """
    check_space(space)
    table(functions, "functions", "functions")
    whole_number(steps, "steps", 0)
    check_budget(budget)
    check_seed(seed)
    if H is None and energy is not None:
        raise InputError("closure on surfaces of constant energy needs H too, not only its value")
    if not functions:
        raise InputError("no functions to take brackets of")
    levels = {} if H is None else {"E" if energy is None else str(energy): as_formula(H, "H")}
    if energy is not None and not isinstance(energy, (sp.Symbol, str)):
        raise InputError(f"the name of the energy is a text or a parameter of the space, not {energy!r}", "energy")
    if isinstance(energy, sp.Symbol) and energy not in space.parameters:
        raise InputError(f"{energy} is no parameter of the phase space: declare it there, as negative='{energy}'")
    if over is not None:
        table(over, "functions", "over")
    for name in (*functions, *(over or ())):
        text(name, "functions, over")
    levels |= {name: as_formula(f, name) for name, f in (over or {}).items()}
    formulas = {name: as_formula(f, name) for name, f in functions.items()}
    work = Budget(budget)
    levels = {name: f for name, f in levels.items() if not _is_nothing(space, f, budget, seed)}
    found = _generated(space, formulas, levels, {}, steps, work, seed)
    declared = {symbol.name for symbol in space.parameters}
    free = [name for name in levels if name not in declared]
    if found.algebra is None or len(free) != 1 or not found.name.startswith(DEPENDS):
        return found
    cases: dict[str, Closure] = {}
    for sign, value in (("<", {"negative": free}), ("=", {}), (">", {"positive": free})):
        there = space if sign == "=" else _with_parameters(space, free, **value)
        try:
            case = _generated(there, formulas, levels, {free[0]: sp.S.Zero} if sign == "=" else {}, steps, work, seed)
        except InputError as error:
            case = Closure({}, None, "undecided", "", error.message)
        cases[f"{free[0]} {sign} 0"] = case
    return _by_cases(found, cases)


def _by_cases(found: Closure, cases: Mapping[str, Closure]) -> Closure:
    """What is known of all cases together."""
    known = {case: part for case, part in cases.items() if part.name}
    if not known:
        return found
    status: Status = "proved" if all(part.status == "proved" for part in cases.values()) else "supported"
    rest = [f"{case}: {part.note}" for case, part in cases.items() if part.note]
    name = "; ".join(f"{part.name} where {case}" for case, part in known.items())
    return replace(found, status=status, name=name, note="; ".join(rest), cases=dict(cases))


def _generated(
    space: PhaseSpace,
    formulas: Mapping[str, Formula],
    levels: Mapping[str, Formula],
    values: Mapping[str, sp.Expr],
    steps: int,
    budget: Budget,
    seed: int,
) -> Closure:
    """What the functions generate on the surfaces of constant levels, some of which have given `values`."""
    space = _with_parameters(space, [name for name in levels if name not in values])
    check_symbols([*formulas.values(), *levels.values()], space.vocabulary)
    domain = space.domain
    for name, level in levels.items():
        value = values[name] if name in values else space.symbol(name)
        domain = domain & Domain(level.conditions, (level.expr - value,))
    subject = Subject(space, domain=domain, functions=space.functions)
    claim = subject.claim("algebra", {"basis": dict(formulas)})
    question = Question(claim, budget, seed)
    region = question.region(*formulas.values())
    nodes = {name: question.load(f) for name, f in formulas.items()}
    texts = {name: str(f) for name, f in formulas.items()}
    try:
        note = _not_central(question, Region(region.requirements, (), region.symbols), nodes, levels)
        grown = _grown(question, region, nodes, steps)
        texts = {**grown.texts, **texts}
        if grown.found is None or note:
            return Closure(texts, None, "undecided", "", note or grown.note)
        outcome, algebra = decided_outcome(question, region, grown.basis, grown.found, None)
    except BudgetExceeded as error:
        return Closure(texts, None, "undecided", "", str(error))
    return Closure(texts, algebra, outcome.status, str(outcome.detail.get("algebra", "")), outcome.note)


def _is_nothing(space: PhaseSpace, f: Formula, budget: float, seed: int) -> bool:
    """Whether a function is identically 0, as Kepler's M·A, so that nothing can depend on its value."""
    check_symbols([f], space.vocabulary)
    question = Question(
        Subject(space, functions=space.functions).claim("identity", {"lhs": f, "rhs": f}), Budget(budget), seed
    )
    return question.decide([Residual("0", question.load(f))], question.region(f)).status == "proved"


def _with_parameters(
    space: PhaseSpace, names: Iterable[str], *, positive: Sequence[str] = (), negative: Sequence[str] = ()
) -> PhaseSpace:
    """The space with parameters of these names where it has none, real or of a sign."""
    known = {symbol.name for symbol in space.parameters}
    added = [name for name in names if name not in known]
    if not added:
        return space
    for name in added:
        if name in space.vocabulary or name in space.functions:
            raise InputError(f"{name!r} is a variable or a function, not the value of one", "over")
    new, kept = (space.Q, space.P) if space.Q else None, as_declared(space.parameters)
    return PhaseSpace(
        space.q, space.p, new=new, time=space.t, positive=positive, negative=negative,
        real=[*kept["real"], *(name for name in added if name not in (*positive, *negative))], complex=kept["complex"],
        functions=space.functions, domain=space.domain,
    )  # fmt: skip


def _not_central(question: Question, region: Region, nodes: Mapping[str, Node], levels: Mapping[str, Formula]) -> str:
    """Why it isn't known that the levels commute with the functions, "" where it is; **raises** where they don't."""
    tape, space = question.tape, question.space
    q, p = question.nodes(space.q), question.nodes(space.p)
    residuals = [
        Residual(f"{{{name}, {level}}}", poisson_bracket(tape, f, question.load(formula), q, p))
        for level, formula in levels.items()
        for name, f in nodes.items()
    ]
    if not residuals:
        return ""
    outcome = question.decide(residuals, region)
    if outcome.status == "proved":
        return ""
    label = outcome.failed.residual.label if outcome.failed is not None else "a bracket"
    if outcome.status == "refuted":
        raise InputError(f"{label} isn't 0: what the algebra is taken over commutes with all of it", "over")
    return f"whether {label} is 0 wasn't decided"


@dataclass(frozen=True)
class _Grown:
    basis: Basis
    texts: dict[str, str]
    found: Found | None
    note: str = ""


def _grown(question: Question, region: Region, nodes: dict[str, Node], steps: int) -> _Grown:
    """The functions with all brackets that are new, until none is."""
    tape, space = question.tape, question.space
    q, p = question.nodes(space.q), question.nodes(space.p)
    names = list(nodes)
    values = [nodes[name] for name in names]
    texts = dict.fromkeys(names, "")
    depth = dict.fromkeys(range(len(values)), 0)
    brackets: dict[tuple[int, int], Node] = {}
    while True:
        for a, b in combinations(range(len(values)), 2):
            if (a, b) not in brackets:
                brackets[a, b] = poisson_bracket(tape, values[a], values[b], q, p)
        pairs = sorted(brackets, key=lambda pair: (max(depth[pair[0]], depth[pair[1]]), pair))
        basis = Basis(tuple(names), tuple(values), {pair: brackets[pair] for pair in pairs}, (*q, *p))
        found = find_constants(question, region, values, [brackets[pair] for pair in pairs], (*q, *p))
        if found.outside is None:
            if found.nothing == "dependent":
                raise InputError(f"the functions {', '.join(names)} seem to be linearly dependent")
            known = found.unknown is None and not found.nothing
            note = found.nothing or "a structure constant was not recognised"
            return _Grown(basis, texts, found if known else None, "" if known else note)
        a, b = pairs[found.outside[0]]
        deeper = 1 + max(depth[a], depth[b])
        if deeper > steps or len(values) >= LARGEST or found.chosen:
            note = f"does not close within {steps} steps: {{{names[a]}, {names[b]}}} is new"
            return _Grown(basis, texts, None, note)
        depth[len(values)] = deeper
        name = _unused(f"f{len(values) + 1}", names)
        names.append(name)
        texts[name] = f"{{{names[a]}, {names[b]}}}"
        values.append(brackets[a, b])


def _unused(name: str, taken: list[str]) -> str:
    return name if name not in taken else _unused(name + "_", taken)


def closure_of_fields(
    fields: Mapping[str, list[Expression]], coordinates: list[sp.Symbol], **options: object
) -> Closure:
    """The Lie algebra that vector fields generate under [X, Y]^i = X^j ∂_j Y^i − Y^j ∂_j X^i.

    By their momentum functions p·X, for which {p·X, p·Y} = −p·[X, Y]; the sign is turned back.
    """
    table(fields, "vector fields", "fields")
    for x in listed(coordinates, "symbols", "coordinates"):
        instance_of(x, sp.Symbol, "coordinates")
    momenta = [f"p_{x.name}" for x in coordinates]
    space = PhaseSpace([x.name for x in coordinates], momenta)
    renamed = dict(zip(coordinates, space.q, strict=True))
    functions: dict[str, Expression] = {}
    for name, components in fields.items():
        text(name, "fields")
        components = listed(components, "components", f"fields, {name}")
        if len(components) != len(coordinates):
            raise InputError(f"{len(components)} components for {len(coordinates)} coordinates", name)
        functions[name] = sp.Add(
            *(p * as_expression(c, name).xreplace(renamed) for p, c in zip(space.p, components, strict=True))
        )
    found = closure(space, functions, **options)  # type: ignore[arg-type]
    if found.algebra is None:
        return found
    constants = {pair: {c: -value for c, value in row.items()} for pair, row in found.algebra.constants.items()}
    turned = {name: text.replace("{", "−[").replace("}", "]") for name, text in found.basis.items()}
    return replace(found, algebra=LieAlgebra(found.algebra.names, constants), basis=turned)
