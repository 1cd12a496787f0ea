"""A corpus of attacks on the readers: formulas, claim files, scenes, certificates, and what is remembered.

Each is data alone: a name, and the text or bytes that are tried. Nothing here may be anything but an input error.
"""

from __future__ import annotations

from typing import Final

FORMULAS: Final = {
    "import": '__import__("os").system("echo gotcha")',
    "import without quotes": "__import__(os)",
    "dunder chain": "q.__class__.__mro__[1].__subclasses__()",
    "dunder of a call": "sin(q).func.__globals__",
    "dunder alone": "__builtins__",
    "getattr": "getattr(q, p)",
    "attribute of a number": "1 .real",
    "eval": "eval(q)",
    "exec": "exec(q)",
    "open": "open(q)",
    "lambda": "lambda x: q",
    "comprehension": "[q for q in (1, 2)]",
    "generator": "sum(q for q in p)",
    "set of a comprehension": "{q for q in p}",
    "walrus": "(q := p)",
    "f-string": 'f"{q}"',
    "string": "'q'",
    "bytes": "b'q'",
    "subscript": "q[0]",
    "slice": "q[::2]",
    "star arguments": "sin(*q)",
    "keyword argument": "sin(x=q)",
    "conditional": "q if p else q",
    "boolean": "q and p",
    "negation": "not q",
    "comparison": "q < p",
    "statement": "q; p",
    "assignment": "q = p",
    "decorator": "@q",
    "await": "await q",
    "ellipsis": "...",
    "floor division": "q // 2",
    "remainder": "q % 2",
    "bits": "q << 99999999",
    "exclusive or": "q ^ 2",
    "matrix product": "q @ p",
    "comment": "q # __import__",
    "line continued": "q + \\\n p",
    "NUL": "q\x00p",
    "bell": "q\x07",
    "right-to-left override": "q\u202e + p",
    "zero-width space": "q\u200b",
    "zero-width joiner": "q\u200dp",
    "Cyrillic letter": "q + р",
    "look-alike letter": "𝐪 + p",
    "look-alike digit": "q + ２",
    "Arabic digit": "q + ٣",
    "ligature": "ﬁ + q",
    "look-alike of a function": "ｓin(q)",
    "fraction sign": "q∕2",
    "surrogate": "q + \ud800",
    "private letter": "q + \ue000",
    "tower of powers": "9**9**9**9",
    "tower of powers from the left": "((9**9)**9)**99999",
    "huge power": "10**1000000000",
    "huge negative power": "10**(-1000000000)",
    "huge root": "2**(1/1000000007)",
    "root of a huge number": "sqrt(10**999999)",
    "huge exponent of a name": "(q + 1)**1000000000000000",
    "huge exponent of a number": "1e999999999",
    "product of powers": "*".join(["10**3000"] * 2000),
    "sum of huge fractions": "+".join(f"1/{10**300 + k}" for k in range(60)),
    "factorial by gamma": "gamma(100000000)",
    "exponential of an exponential": "exp(exp(exp(exp(1000))))",
    "digits": "9" * 1_000_000,
    "digits after the point": "0." + "3" * 1_000_000,
    "digits of an exponent": "1e" + "9" * 1_000_000,
    "parentheses": "(" * 100_000 + "q" + ")" * 100_000,
    "open parentheses": "(" * 19_000,
    "signs": "-" * 100_000 + "q",
    "few enough signs": "-" * 19_000 + "q",
    "calls": "sin(" * 4_000 + "q" + ")" * 4_000,
    "powers": "q" + "**q" * 6_000,
    "terms": "+".join(["q"] * 1_000_000),
    "name": "a" * 1_000_000,
    "short of the longest name": "a" * 19_000,
    "commas": "atan2(" + "q," * 9_000 + "q)",
    "derivative of high order": "D(q**3, q, 1000000000)",
    "derivative by a formula": "D(q, q + p)",
    "derivatives nested": "D(" * 90 + "sin(q*sin(q*p))" + ", q, 20)" * 90,
    "brackets nested": "bracket(" * 90 + "sin(q*sin(q*p))" + ", exp(q*p)*sin(p))" * 90,
    "derivative of a tower": "D(" + "sin(q*" * 80 + "q" + ")" * 80 + ", q, 20)",
    "expanding power": "(" + "+".join(f"q**{k}*p**{k % 7}" for k in range(1, 400)) + ")**999",
    "denested roots": "sqrt(" * 60 + "q" + "+2)" * 60,
    "no argument": "sin()",
    "many arguments": "sin(q, p, q)",
    "nothing": "",
    "spaces": " " * 19_000,
    "infinity": "inf",
    "not a number": "nan",
    "infinity by a pole": "1/0",
    "zoo": "zoo",
    "log of zero": "log(0)",
    "undefined everywhere": "sqrt(-1 - q**2)",
    "undeclared": "q + unheard_of",
    "keyword": "None",
    "sympy's own": "Symbol(q)",
    "sympy's sum": "Sum(q, p)",
    "sympy's lambdify": "lambdify(q, p)",
    "underscore in a number": "1_000",
    "octal": "0o17",
    "hexadecimal": "0xff",
    "complex without a number": "j",
}
"""Texts that are no formula, or one that is too much to ask for."""

_HEAD = '[phase_space]\nq = ["q"]\np = ["p"]\n'
_CLAIM = '[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"\n'


def _filled(entry: str, size: int = 999_000) -> str:
    """As many copies of an entry as fit into the largest file that is read."""
    return entry * (size // len(entry))


def _numbered(count: int, line: str) -> str:
    return "".join(line.format(k=k, before=k - 1) for k in range(1, count))


FILES: Final = {
    "nothing": b"",
    "NUL bytes": b"\x00" * 1000,
    "NUL in a string": (_HEAD + 'title = "a\x00b"\n' + _CLAIM).encode(),
    "NUL escaped": (_HEAD + '[definitions]\n"a\\u0000" = "q"\n' + _CLAIM).encode(),
    "Latin-1": (_HEAD + "title = 'é'\n" + _CLAIM).encode("latin-1"),
    "UTF-16": (_HEAD + _CLAIM).encode("utf-16"),
    "UTF-32": (_HEAD + _CLAIM).encode("utf-32"),
    "overlong UTF-8": b"title = '\xc0\xaf'",
    "surrogate in UTF-8": b"title = '\xed\xa0\x80'",
    "surrogate escaped": b'title = "\\ud800"',
    "JSON": b'{"phase_space": {"q": ["q"]}}',
    "XML": b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><a>&b;</a>',
    "YAML": b"!!python/object/apply:os.system ['echo gotcha']",
    "pickle": b"cos\nsystem\n(S'echo gotcha'\ntR.",
    "gzip": b"\x1f\x8b\x08\x00" + b"\x00" * 100,
    "ELF": b"\x7fELF" + bytes(range(256)) * 10,
    "key twice": (_HEAD + 'q = ["x"]\n' + _CLAIM).encode(),
    "table twice": (_HEAD + _HEAD + _CLAIM).encode(),
    "table and list": (_HEAD + _CLAIM + "[claim]\nkind = 'volume'\n").encode(),
    "unknown section": (_HEAD + "[python]\ncode = 'import os'\n" + _CLAIM).encode(),
    "dunder section": (_HEAD + "[__class__]\na = 1\n" + _CLAIM).encode(),
    "dunder name": (_HEAD.replace('"q"]', '"__class__.q"]') + _CLAIM).encode(),
    "unknown kind": (_HEAD + _CLAIM.replace('"bracket"', '"__import__"')).encode(),
    "a budget beyond all numbers": (_HEAD + _CLAIM + "budget = " + "9" * 400).encode(),
    "a claim is a string": (_HEAD + "claim = ['bracket']").encode(),
    "a section is a number": (b"phase_space = 3\n" + _CLAIM.encode()),
    "a formula is a date": (_HEAD + _CLAIM.replace('"1"', "1979-05-27")).encode(),
    "a formula is infinite": (_HEAD + _CLAIM.replace('"1"', "inf")).encode(),
    "a formula is a list": (_HEAD + _CLAIM.replace('"1"', "[1]")).encode(),
    "a formula is a table": (_HEAD + _CLAIM.replace('"1"', "{a = 1}")).encode(),
    "recursive definition": (_HEAD + '[definitions]\na = "a + q"\n' + _CLAIM.replace('"1"', '"a"')).encode(),
    "mutual definitions": (_HEAD + '[definitions]\na = "b"\nb = "a"\n' + _CLAIM.replace('"1"', '"a"')).encode(),
    "definitions that are high powers": (
        _HEAD + '[definitions]\na0 = "2"\n' + _numbered(50, 'a{k} = "a{before}**99"\n') + _CLAIM.replace('"1"', '"a49"')
    ).encode(),
    "names that shadow, and are then called": (
        '[phase_space]\nq = ["sin"]\np = ["p"]\n' + _CLAIM.replace('"q"', '"sin(p)"')
    ).encode(),
    "a name twice": ('[phase_space]\nq = ["q"]\np = ["q"]\n' + _CLAIM).encode(),
    "a parameter named as a coordinate": (_HEAD + '[symbols]\nq = "positive"\np = "function"\n' + _CLAIM).encode(),
    "look-alike names": ('[phase_space]\nq = ["q", "𝐪"]\np = ["p", "𝐩"]\n' + _CLAIM).encode(),
    "deep lists": ("a = " + "[" * 50_000 + "]" * 50_000).encode(),
    "deep tables": ("a = " + "{a = " * 50_000 + "1" + "}" * 50_000).encode(),
    "deep keys": ("a." * 50_000 + "a = 1").encode(),
    "deep quoted keys": ('"a".' * 50_000 + "a = 1").encode(),
    "deep headers": ("[" + "a." * 50_000 + "a]\n").encode(),
    "deep quoted headers": ("[" + '"a".' * 50_000 + "a]\n").encode(),
    "deep lists of claims": ("[[" + "claim." * 900 + "claim]]\n").encode() * 50,
    "10 MB of one string": b'title = "' + b"a" * 9_999_000 + b'"',
    "1 MB of words": ("a" * 999_000).encode(),
    "a thousand names": (
        "[phase_space]\nq = [" + ",".join(f'"q{k:06d}"' for k in range(1000)) + "]\np = ["
        + ",".join(f'"p{k:06d}"' for k in range(1000)) + "]\n" + _CLAIM
    ).encode(),
    "a basis of a thousand": (
        _HEAD + '[[claim]]\nkind = "algebra"\nequals = "so(3)"\n[claim.basis]\n' + _numbered(1000, 's{k} = "q"\n')
    ).encode(),
    "a lone carriage return": (_HEAD + _CLAIM).replace("\n", "\r").encode(),
}  # fmt: skip
"""Bytes that are no claim file, nor a scene."""

LARGE: Final = {
    "1 MB of one formula": (_HEAD + _CLAIM.replace('"1"', '"' + _filled("q+") + 'q"')).encode(),
    "1 MB of quoted dots": ('"a".' * 249_000).encode(),
    "1 MB of names": (
        "[phase_space]\nq = [" + ",".join(f'"q{k:06d}"' for k in range(45_000)) + "]\np = ["
        + ",".join(f'"p{k:06d}"' for k in range(45_000)) + "]\n" + _CLAIM
    ).encode(),
    "1 MB of components": (
        _HEAD + 'Q = ["Q"]\nP = ["P"]\n[transformation]\nQ = [' + _filled('"q",') + ']\nP = ["p"]\n' + _CLAIM
    ).encode(),
    "1 MB of digits": b"a = " + b"9" * 999_000,
    "dear conditions": (
        _HEAD + "[domain]\nwhere = [" + _numbered(800, '"bracket(sin(q*sin({k}*q*p)),exp(q*p)*sin(p)) > 0",')
        + "]\n" + _CLAIM
    ).encode(),
    "definitions that are derived": (
        _HEAD + '[definitions]\na0 = "sin(q*p)"\n' + _numbered(200, 'a{k} = "bracket(a{before}, a{before}*q**2)"\n')
        + _CLAIM.replace('"1"', '"a199"')
    ).encode(),
    "definitions that double": (
        _HEAD + '[definitions]\na0 = "q + sin(p)"\n'
        + _numbered(200, 'a{k} = "(a{before} + cos(a{before}))*sin(a{before})"\n') + _CLAIM.replace('"1"', '"a199"')
    ).encode(),
    "definitions that square": (
        _HEAD + '[definitions]\na0 = "q + 1/3"\n' + _numbered(200, 'a{k} = "a{before}**2 + p"\n')
        + _CLAIM.replace('"1"', '"a199"')
    ).encode(),
    "deep headers, many": "".join("[" + "a." * 11 + f"b{k}]\n" for k in range(30_000)).encode(),
    "deep keys, many": "".join("a." * 11 + f"b{k} = 1\n" for k in range(26_000)).encode(),
    "deep keys in a deep table": ("[" + "b." * 11 + "b]\n").encode()
    + "".join("a." * 11 + f"b{k} = 1\n" for k in range(26_000)).encode(),
    "10 MB of digits": b"a = " + b"9" * 9_999_000,
    "10 MB of claims": (_HEAD + _CLAIM * 160_000).encode(),
    "1 MB of a string without an end": b'title = "' + b"a" * 999_000,
    "1 MB of escapes": b'title = "' + b"\\n" * 499_000 + b'"',
    "1 MB of quotes": b'"' * 999_000,
    "1 MB of apostrophes and quotes": b"'" + b'"' * 999_000,
    "1 MB of comments": _filled("#\n").encode(),
    "1 MB of lines": b"\n" * 999_000,
    "1 MB of keys": "".join(f"k{k:06d} = 1\n" for k in range(80_000)).encode(),
    "1 MB of tables": "".join(f"[k{k:07d}]\n" for k in range(90_000)).encode(),
    "1 MB of dots": ("a." * 499_000).encode(),
    "1 MB of dotted keys": _filled("a." * 11 + "a\n").encode(),
    "1 MB of numbers": ("a = [" + _filled("1,") + "]").encode(),
    "1 MB of lists": ("a = [" + _filled("[],") + "]").encode(),
    "1 MB of tables in a list": ("a = [" + _filled("{},") + "]").encode(),
    "1 MB of digits after the point": b"a = 0." + b"9" * 999_000,
    "1 MB of short claims": (_HEAD + _filled("[[claim]]\n", 990_000)).encode(),
    "1 MB of symbols": (_HEAD + "[symbols]\n" + _numbered(60_000, 's{k} = "real"\n') + _CLAIM).encode(),
    "1 MB of assumptions": (_HEAD + "[symbols]\na = [" + _filled('"real",') + "]\n" + _CLAIM).encode(),
    "1 MB of definitions": (_HEAD + "[definitions]\n" + _numbered(60_000, 's{k} = "q"\n') + _CLAIM).encode(),
    "1 MB of conditions": (_HEAD + "[domain]\nwhere = [" + _filled('"q > 0",') + "]\n" + _CLAIM).encode(),
    "1 MB of equations": (_HEAD + "[domain]\non = [" + _filled('"q",') + "]\n" + _CLAIM).encode(),
    "1 MB of faulty conditions": (_HEAD + "[domain]\nwhere = [" + _filled('"q >",') + "]\n" + _CLAIM).encode(),
    "dear definitions": (
        _HEAD + "[definitions]\n" + _numbered(900, 'a{k} = "bracket(sin(q*sin(q*p)),exp(q*p)*sin({k}*p)/(q**{k}+p))"\n')
        + _CLAIM
    ).encode(),
    "1 MB of functions": (_HEAD + '[[claim]]\nkind = "involution"\nfunctions = [' + _filled('"q",') + "]\n").encode(),
    "1 MB of a basis": (
        _HEAD + '[[claim]]\nkind = "algebra"\nequals = "so(3)"\n[claim.basis]\n' + _numbered(70_000, 's{k} = "q"\n')
    ).encode(),
}  # fmt: skip
"""The same, of nearly the size that is read, or beyond it."""

CERTIFICATES: Final = {
    "nothing": b"",
    "deep lists": b"[" * 100_000,
    "deep tables": b'{"a":' * 100_000,
    "lists": b"[" + b"[]," * 200_000 + b"[]]",
    "digits": b"9" * 100_000,
    "a number beyond all": b'{"certificate": 1e999999999}',
    "not a number": b'{"certificate": NaN}',
    "a long number": b'{"certificate": ' + b"9" * 5000 + b"}",
    "a key twice": b'{"certificate": 1, "certificate": 1}',
    "UTF-16": '{"certificate": 1}'.encode("utf-16"),
    "surrogate": b'{"certificate": 1, "a": "\\ud800"}',
    "NUL": b'{"certificate": 1, "a": "\x00"}',
    "pickle": b"cos\nsystem\n(S'echo gotcha'\ntR.",
    "a list": b"[1]",
    "a word": b"true",
    "spaces": b" " * 8_000_001,
    "no more than a version": b'{"certificate": 1}',
    "a verdict alone": b'{"certificate": 1, "checksum": "0", "verdict": "proved"}',
}
"""Bytes that are no certificate."""

DEFINITIONS: Final = {
    "squared numbers": {"a0": "3", **{f"a{k}": f"a{k - 1}*a{k - 1}" for k in range(1, 60)}},
    "doubled formulas": {
        "a0": "x + sin(px)", **{f"a{k}": f"(a{k - 1} + cos(a{k - 1}))*sin(a{k - 1})" for k in range(1, 60)}
    },
    "brackets of brackets": {
        "a0": "sin(x*px)", **{f"a{k}": f"bracket(a{k - 1}, a{k - 1}*x**2)" for k in range(1, 60)}
    },
    "powers of powers": {"a0": "x + 1", **{f"a{k}": f"a{k - 1}**9999" for k in range(1, 60)}},
    "derivatives of derivatives": {
        "a0": "sin(x*sin(x*px))", **{f"a{k}": f"D(a{k - 1}*a{k - 1}, x, 20)" for k in range(1, 60)}
    },
}  # fmt: skip
"""Definitions, the last one `a59`, that make a formula too large to be checked."""
