"""Verdicts beside an independent system: `python -m properties.maxima --claims 400` (needs `maxima`, from Debian).

The claims of the catalogue, and random ones, are read here from their text alone, by a parser that shares nothing with
canon's, and handed to Maxima, which differentiates them and evaluates them in bigfloats at points of the domain that
are drawn here. What canon proves has to vanish there; what it refutes must not vanish at its own witness.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

FUNCTIONS: Final = {
    "sqrt": "sqrt", "cbrt": "c_root", "exp": "exp", "log": "log", "sin": "sin", "cos": "cos", "tan": "tan",
    "cot": "cot", "sec": "sec", "csc": "csc", "asin": "asin", "acos": "acos", "atan": "atan", "atan2": "atan2",
    "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "coth": "coth", "asinh": "asinh", "acosh": "acosh",
    "atanh": "atanh", "abs": "abs", "sign": "signum",
}  # fmt: skip
KINDS: Final = ("identity", "bracket", "conserved", "involution", "canonical", "fundamental_brackets")
DIGITS: Final = 120
FINER: Final = 400
POINTS: Final = 30
HEAD: Final = f"""display2d:false$ fpprec:{DIGITS}$ domain:complex$ radexpand:false$ ratprint:false$ c_root(x):=x^(1/3)$
linel:100000$ inflag:true$
number(e):=block([v:errcatch(bfloat(rectform(bfloat(e))))],if v=[] then false else first(v))$
small(v):=is(cabs(v)<1.0b-60)$
real(v):=is(numberp(imagpart(v)) and abs(imagpart(v))<1.0b-60)$
positive(c,s):=block([v:number(subst(s,c))], if v=false or not numberp(realpart(v)) then false
 else if not real(v) then false else is(realpart(v)>1.0b-60))$
rounded(s):=map(lambda([e],lhs(e)=bfloat(rhs(e))),s)$
finer(e,s):=block([fpprec:{FINER}], number(subst(rounded(s),e)))$
at(r,conds,s):=block([v,w,x:rounded(s),out:"vanishes"],
 if not every(lambda([c],positive(c,x)),conds) then return("outside"),
 for e in r do (v:number(subst(x,e)), w:finer(e,s),
  if v=false or w=false or not numberp(realpart(v)) or not numberp(imagpart(v)) then (out:"unknown",return(done)),
  if small(w) then false else if is(cabs(v-w)<cabs(w)/100) then out:"differs" else (out:"unknown",return(done))), out)$
simplified(e):=block([simp:true],expand(e,0,0))$
inside(e):=if atom(e) then [] else block([o:op(e),a:args(e),r], r:apply(append,map(inside,a)),
 if o="^" and not integerp(simplified(second(a))) or member(o,[log,c_root,sqrt]) then cons(first(a),r)
 else if member(o,[asin,acos,atanh]) then cons(1-first(a)^2,r) else if o=acosh then cons(first(a)-1,r) else r)$
pb(f,g,q,p):=sum(diff(f,q[i])*diff(g,p[i])-diff(f,p[i])*diff(g,q[i]),i,1,length(q))$
"""


class Skipped(Exception):
    """A claim with something that isn't translated."""


@dataclass(frozen=True)
class Question:
    """Residuals, formulas as written, conditions, in Maxima's words; the names with what is assumed of them."""

    residuals: tuple[str, ...]
    written: tuple[str, ...]
    conditions: tuple[str, ...]
    names: dict[str, str]


def translated(text: str, known: Mapping[str, str]) -> str:
    """A formula in Maxima's words, every name by what is `known` of it."""

    def word(match: re.Match[str]) -> str:
        name = match.group(0)
        called = text[match.end() :].lstrip().startswith("(")
        if name in known:
            if called:
                raise Skipped(f"an arbitrary function {name}")
            return f"({known[name]})"
        if called and name in FUNCTIONS:
            return FUNCTIONS[name]
        if name == "pi":
            return "%pi"
        raise Skipped(name)

    if re.search(r"\d\.?\d*[jJeE]|\d+j", text):
        raise Skipped("a number that is complex, or written with an exponent")
    exact = re.sub(r"\d+\.\d+", lambda m: f"({Fraction(m.group(0))})", text)
    return re.sub(r"[^\W\d]\w*", word, exact).replace("**", "^")


def question(file: Mapping[str, Any], claim: Mapping[str, Any]) -> Question:
    """A claim as residuals that vanish; **raises** `Skipped`."""
    kind, space = claim["kind"], file["phase_space"]
    if kind not in KINDS or "order" in claim or "tensor" in claim or "structure" in claim:
        raise Skipped(kind)
    domain = {**file.get("domain", {}), **claim.get("domain", {})}
    if "on" in domain or "space" in claim:
        raise Skipped("a surface")
    words = {name: _words(said) for name, said in file.get("symbols", {}).items()}
    if any(word in said for said in words.values() for word in ("function", "complex", "integer")):
        raise Skipped("functions, integers, complex names")
    given = file.get("transformation", {})
    backward = "q" in given
    old = [*space["q"], *space["p"]]
    new = [*space.get("Q", ()), *space.get("P", ())]
    names = {name: words.get(name, "") for name in (*old, *words, space.get("time", "t"))}
    if backward:
        names |= {name: words.get(name, "") for name in new}
    known = {name: f"c_{name}" for name in names}
    for name, formula in () if kind == "identity" else file.get("definitions", {}).items():
        known[name] = translated(formula, known)

    written: list[str] = []

    def read(formula: Any) -> str:
        written.append(translated(str(formula), known))
        return written[-1]

    q, p = ([known[name] for name in space[key]] for key in ("q", "p"))
    lists = f"[{','.join(q)}],[{','.join(p)}]"
    if kind == "identity":
        keys = [key for key in ("q", "p", "Q", "P") if key in given]
        images = {name: read(formula) for key in keys for name, formula in zip(space[key], given[key], strict=True)}
        known.update(images)
        for name in images:
            names.pop(name, None)
        for name, formula in file.get("definitions", {}).items():
            known[name] = translated(formula, known)
        residuals = [f"({read(claim['lhs'])})-({read(claim['rhs'])})"]
    elif kind == "bracket":
        residuals = [f"pb({read(claim['f'])},{read(claim['g'])},{lists})-({read(claim['equals'])})"]
    elif kind == "conserved":
        f, H = read(claim["f"]), read(file["hamiltonian"]["H"])
        residuals = [f"pb({f},{H},{lists})+diff({f},c_{space.get('time', 't')})"]
    elif kind == "involution":
        f = [read(one) for one in claim["functions"]]
        residuals = [f"pb({f[i]},{f[k]},{lists})" for i in range(len(f)) for k in range(i)]
    else:
        residuals = _of_map(given, claim, space, read, backward)
    where = [part for text in domain.get("where", ()) for part in _parts(str(text), read)]
    signs = {"positive": "{0}", "negative": "-({0})", "nonnegative": "{0}", "nonpositive": "-({0})"}
    where += [signs[word].format(known[name]) for name, said in words.items() for word in said.split() if word in signs]
    return Question(tuple(residuals), tuple(written), tuple(where), names)


def _words(said: Any) -> str:
    return said if isinstance(said, str) else " ".join(said)


def _of_map(given: Mapping[str, Any], claim: Mapping[str, Any], space: Any, read: Any, backward: bool) -> list[str]:
    if not given:
        raise Skipped("a map that isn't explicit")
    keys, variables = (("q", "p"), ("Q", "P")) if backward else (("Q", "P"), ("q", "p"))
    pairs = len(given[keys[0]])
    images = [read(formula) for key in keys for formula in given[key]]
    q, p = ([f"c_{name}" for name in space[key]] for key in variables)
    if len(q) != pairs:
        raise Skipped("a map to fewer pairs")
    lists = f"[{','.join(q)}],[{','.join(p)}]"
    scale = read(claim.get("scale", "1"))
    scale = f"1/({scale})" if backward else scale
    return [
        f"pb({images[i]},{images[j]},{lists})-({scale if j == i + pairs else 0})"
        for i in range(2 * pairs)
        for j in range(i + 1, 2 * pairs)
    ]


def _parts(text: str, read: Any) -> Iterator[str]:
    """What is positive where a chain of inequalities holds."""
    pieces = re.split(r"(<=|>=|!=|==|<|>)", text)
    for left, sign, right in zip(pieces[::2], pieces[1::2], pieces[2::2], strict=False):
        if sign not in "<>":
            raise Skipped(sign)
        low, high = (left, right) if sign == "<" else (right, left)
        yield f"({read(high)})-({read(low)})"


def point(rng: random.Random, names: Mapping[str, str]) -> dict[str, Fraction]:
    """A random point, with what is assumed of the names."""
    out = {}
    for name, said in names.items():
        size = Fraction(rng.randrange(1, 4000), rng.choice((1000, 1000, 1009, 400)))
        sign = -1 if "negative" in said.split() else 1 if "positive" in said or "nonnegative" in said else None
        out[name] = size * (sign or rng.choice((1, -1)))
    return out


def substitution(place: Mapping[str, Any]) -> str:
    """A point in Maxima's words."""
    return "[" + ",".join(f"c_{name}={Fraction(value)}" for name, value in place.items()) + "]"


def ask(questions: Sequence[tuple[Question, list[dict[str, Any]]]], seconds: float) -> list[list[str]]:
    """What Maxima finds at each of the points of each question: vanishes, differs, outside, or unknown."""
    lines = [HEAD]
    for k, (found, places) in enumerate(questions):
        lines.append(f"r:errcatch([{','.join(found.residuals)}])$ c:[{','.join(found.conditions)}]$")
        # as it is written: exp(2*log(u)) would be u^2 as soon as it is read
        lines.append(f"w:block([simp:false],errcatch(apply(append,map(inside,[{','.join(found.written)}]))))$")
        lines.append("w:map(simplified,w)$")
        lines.append("c:append(c,if w=[] then [] else first(w))$")
        for place in places:
            value = f'block([v:errcatch(at(first(r),c,{substitution(place)}))],if v=[] then "unknown" else first(v))'
            lines.append(f'print("@",{k},if r=[] then "unknown" else {value})$')
    text = "\n".join(lines) + "\n"
    done = subprocess.run(["maxima", "--very-quiet"], input=text, capture_output=True, text=True, timeout=seconds)
    out: list[list[str]] = [[] for _ in questions]
    for k, said in re.findall(r"@ (\d+) (\w+)", done.stdout):
        out[int(k)].append(said)
    return out


# -- the verdicts beside it ------------------------------------------------------------------------------


def texts(count: int, seed: int) -> Iterator[tuple[str, str]]:
    """(name, text) of the files of the catalogue, and of random claims."""
    from canon.catalogue import files
    from properties.soundness.cases import case
    from properties.soundness.known import known_case

    for path in sorted(map(str, files())):
        yield path.rpartition("catalogue/")[2], Path(path).read_text(encoding="utf-8")
    for k in range(count):
        made = (case, known_case)[k % 2](seed * 1_000_000 + k)
        if made is not None:
            yield f"seed {seed * 1_000_000 + k}", made.text


def claims(count: int, seed: int) -> Iterator[tuple[str, Any, Question]]:
    """(name, canon's own claim, what Maxima is asked) of claims, `count` of the catalogue and of the others."""
    from canon.claims.reader import read_text

    taken = Counter[bool]()
    for name, text in texts(3 * count, seed):
        ours = name.startswith("seed")
        if taken[ours] >= count:
            continue
        file = tomllib.loads(text)
        for k, raw in enumerate(file.get("claim", ())):
            try:
                found = question(file, raw)
            except (Skipped, KeyError, TypeError):
                continue
            claim = next((c for c in read_text(text).claims if c.index == k), None)
            if claim is not None and taken[ours] < count:
                taken[ours] += 1
                yield f"{name} #{k + 1}", claim, found


def compared(name: str, claim: Any, found: Question, seed: int) -> tuple[str, str, list[dict[str, Any]]]:
    """(name, canon's verdict, the points at which Maxima is to look)."""
    from canon.claims.verify import verify
    from canon.errors import InputError

    rng = random.Random(f"{name} {seed}")
    try:
        verdict = verify(claim, budget=5.0)
    except InputError:
        return name, "input error", []
    if verdict.status == "refuted":
        witness = verdict.witness or {}
        exact = {
            key: Fraction(str(value))
            for key, value in witness.items()
            if not isinstance(value, Mapping) and key in found.names
        }
        return name, "refuted", [exact] if exact else []
    return name, verdict.status, [point(rng, found.names) for _ in range(POINTS)] if verdict.status == "proved" else []


def judged(status: str, seen: Sequence[str]) -> str:
    """Whether Maxima agrees with a verdict, contradicts it, or can't tell."""
    wanted, other = ("vanishes", "differs") if status == "proved" else ("differs", "vanishes")
    return "contradicts" if other in seen else "agrees" if wanted in seen else "no point that it can tell"


def main() -> int:
    """Compare, and print one JSON object; exit status 1 where Maxima contradicts a verdict."""
    parser = argparse.ArgumentParser(prog="python -m properties.maxima", description=__doc__)
    parser.add_argument("--claims", type=int, default=200, help="of the catalogue, and as many random ones")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1200.0, help="that Maxima may take for 20 claims")
    options = parser.parse_args()
    asked, totals, contradictions = [], Counter[str](), []
    for name, claim, found in claims(options.claims, options.seed):
        asked.append((*compared(name, claim, found, options.seed), found))
    for start in range(0, len(asked), 20):
        part = asked[start : start + 20]
        for (name, status, places, _), seen in zip(
            part, ask([(q, at) for _, _, at, q in part], options.seconds), strict=True
        ):
            where = "random" if name.startswith("seed") else "catalogue"
            said = judged(status, seen) if places else "not asked: no point"
            totals[f"{where}, {status}: {said}"] += 1
            if said == "contradicts":
                contradictions.append(name)
        print(f"\r{start + len(part)} of {len(asked)}", end="", file=sys.stderr, flush=True)
    print(json.dumps({"totals": dict(sorted(totals.items())), "contradictions": contradictions}, indent=1))
    return 1 if contradictions else 0


if __name__ == "__main__":
    sys.exit(main())
