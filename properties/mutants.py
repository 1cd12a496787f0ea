"""Mutants of a module: its text with one change.

A comparison (< and <=, == and !=, is and is not, in and not in), an operation (+ and -, * and /, | and &), a whole
number by one, `and` and `or`, a `not` or a minus sign left out, another condition negated, True and False, `all` and
`any`, `min` and `max`, a returned value replaced by None.

Left alone is what only says how much is tried or in which words: numbers that a module names (MOST_TERMS = 400) and
comparisons with them; arguments named as in `EFFORT`, `strict=` among them; defaults of arguments and fields; what is
raised; annotations and decorators.
"""

from __future__ import annotations

import ast
import copy
from typing import Any, Final, NamedTuple

SWAPPED: Final[dict[type, type]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
    ast.BitOr: ast.BitAnd, ast.BitAnd: ast.BitOr,
}  # fmt: skip
CALLED: Final = {"all": "any", "any": "all", "min": "max", "max": "min"}
EFFORT: Final = (
    "strict",
    "bits",
    "precision",
    "prec",
    "limit",
    "most",
    "depth",
    "budget",
    "digits",
    "tries",
    "maxsize",
)


class Mutant(NamedTuple):
    """A change: what it is, the line of the statement that it is in, and whether that stands outside of functions."""

    said: str
    line: int
    outside: bool


def changes(node: ast.AST) -> list[ast.AST]:
    """The nodes that may stand in a node's place."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in SWAPPED:
        return [_with(node, ops=[SWAPPED[type(node.ops[0])]()])]
    if isinstance(node, (ast.BinOp, ast.BoolOp)) and type(node.op) in SWAPPED:
        return [_with(node, op=SWAPPED[type(node.op)]())]
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        return [_with(node, value=not node.value)]
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return [_with(node, value=node.value + 1)]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.Not, ast.USub)):
        return [node.operand]
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLED:
        return [_with(node, func=_with(node.func, id=CALLED[node.func.id]))]
    if isinstance(node, ast.Return) and node.value is not None and not isinstance(node.value, ast.Constant):
        # the value stays in the text, so that the function has the same inner functions and names
        return [_with(node, value=ast.BoolOp(ast.And(), [ast.Constant(None), node.value]))]
    if isinstance(node, (ast.If, ast.While, ast.IfExp)) and _is_value(node.test):
        return [_with(node, test=ast.UnaryOp(ast.Not(), node.test))]
    if isinstance(node, ast.comprehension) and any(_is_value(test) for test in node.ifs):
        return [_with(node, ifs=[ast.UnaryOp(ast.Not(), t) if _is_value(t) else t for t in node.ifs])]
    return []


def _is_value(test: ast.AST) -> bool:
    """Whether a condition is none of those that are changed for themselves."""
    return not isinstance(test, (ast.Compare, ast.BoolOp, ast.UnaryOp, ast.Constant))


def _with(node: Any, **parts: Any) -> Any:
    other = copy.copy(node)
    for name, part in parts.items():
        setattr(other, name, part)
    return ast.copy_location(other, node) if hasattr(node, "lineno") else other


def _is_number(node: ast.AST | None) -> bool:
    """Whether an expression is written with numbers alone."""
    return node is not None and all(
        isinstance(n, (ast.Constant, ast.BinOp, ast.UnaryOp, ast.Tuple, ast.operator, ast.unaryop, ast.expr_context))
        and not (isinstance(n, ast.Constant) and not isinstance(n.value, (int, float)))
        for n in ast.walk(node)
    )


class _Changing(ast.NodeTransformer):
    """Lists the mutants of a module, and makes the `number`-th."""

    def __init__(self, tree: ast.Module, number: int | None) -> None:
        self.number, self.found = number, list[Mutant]()
        self.line, self.inside, self.in_class = 0, False, False
        given = [(s.targets[0], s.value) for s in tree.body if isinstance(s, ast.Assign)]
        given += [(s.target, s.value) for s in tree.body if isinstance(s, ast.AnnAssign)]
        self.limits = {name.id for name, value in given if isinstance(name, ast.Name) and _is_number(value)}

    def visit(self, node: ast.AST) -> Any:
        if self._left_alone(node):
            return node
        before = self.line, self.inside, self.in_class
        if isinstance(node, ast.FunctionDef):  # a lambda outside of functions has no statement that could be reached
            self.inside = True
        if isinstance(node, ast.ClassDef):
            self.in_class = True
        if isinstance(node, ast.stmt):
            self.line = node.lineno
        try:
            if isinstance(node, ast.FunctionDef):
                node.body = [self.visit(statement) for statement in node.body]
                return node
            if isinstance(node, ast.ClassDef):
                node.body = [self.visit(s) if isinstance(s, ast.FunctionDef) else s for s in node.body]
                return node
            if isinstance(node, ast.Lambda):
                node.body = self.visit(node.body)
                return node
            if isinstance(node, ast.AnnAssign):
                node.value = self.visit(node.value) if node.value else None
                return node
            other = node
            for change in changes(node):
                if len(self.found) == self.number:
                    other = change
                self.found.append(Mutant(_said(node, change, self.line), self.line, not self.inside))
            return other if other is not node else self.generic_visit(node)
        finally:
            self.line, self.inside, self.in_class = before

    def _left_alone(self, node: ast.AST) -> bool:
        if isinstance(node, (ast.Raise, ast.Assert)):
            return True
        if isinstance(node, ast.keyword) and node.arg in EFFORT:
            return True
        if isinstance(node, ast.Compare):
            return any(isinstance(n, ast.Name) and n.id in self.limits for n in (node.left, *node.comparators))
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and not self.inside:
            return _is_number(node.value)
        return isinstance(node, ast.stmt) and not self.inside and not isinstance(
            node, (ast.FunctionDef, ast.ClassDef, ast.Assign, ast.AnnAssign)
        )  # fmt: skip


def _said(node: ast.AST, change: ast.AST, line: int) -> str:
    """A change in words; of statements with a body, their first line."""
    if isinstance(node, (ast.If, ast.While)):
        return f"line {line}: if {ast.unparse(node.test)[:90]} -> if not"
    if isinstance(node, ast.Return):
        return f"line {line}: {ast.unparse(node)[:90]} -> return None"
    before, after = ast.unparse(node).strip(), ast.unparse(change).strip()
    return f"line {getattr(node, 'lineno', line)}: {before[:90]} -> {after[:90]}"


def mutants(text: str) -> list[Mutant]:
    """All mutants of a module, in an order that `mutated` knows."""
    tree = ast.parse(text)
    changing = _Changing(tree, None)
    changing.visit(tree)
    return changing.found


def mutated(text: str, number: int) -> ast.Module:
    """The module with its change of this number."""
    tree = ast.parse(text)
    return ast.fix_missing_locations(_Changing(tree, number).visit(tree))


class _Marked(ast.NodeTransformer):
    """Before each statement, a call with its line."""

    def generic_visit(self, node: ast.AST) -> ast.AST:
        super().generic_visit(node)
        for field in ("body", "orelse", "finalbody"):
            statements = getattr(node, field, None)
            if isinstance(statements, list) and statements and not isinstance(node, (ast.Module, ast.ClassDef)):
                setattr(node, field, [other for s in statements for other in (self._mark(s), s)])
        return node

    def _mark(self, statement: ast.stmt) -> ast.stmt:
        called = ast.Call(ast.Name("__reached__", ast.Load()), [ast.Constant(statement.lineno)], [])
        return ast.copy_location(ast.Expr(called), statement)


def marked(text: str) -> ast.Module:
    """The module with a call of `__reached__` before each statement of a function, of its line."""
    return ast.fix_missing_locations(_Marked().visit(ast.parse(text)))
