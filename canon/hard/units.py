"""Units: a map's defect is a number without any, whether its bodies are electrons or planets."""

from __future__ import annotations

from typing import Any

from canon.hard.case import HardCase, Number, Quantities, each

TURN = (0.6, 0.8)


def _defect(m: Any, defect: Number, length: Number, momentum: Number) -> Quantities:
    """{Q, P} − 1 of Q = R (q + h p), P = (1 + δ) R p, R a rotation."""
    return ((defect,),)


def _step(q: Any, p: Any, defect: float, length: float, momentum: float) -> tuple[Any, Any]:
    """Such a step, with h p comparable to q."""
    import numpy as np

    R = np.array([[TURN[0], -TURN[1]], [TURN[1], TURN[0]]])
    return R @ (q + length / momentum * p), (1 + defect) * (R @ p)


def _ours(defect: float, length: float, momentum: float) -> float:
    """The worst {Q, P} of an audit, where q and p have these sizes."""
    import numpy as np

    from canon.claims.audit import audit

    z = np.random.default_rng(0).uniform(-1, 1, (8, 4)) * np.array([length, length, momentum, momentum])
    report = audit(lambda q, p: _step(q, p, defect, length, momentum), dimension=4, domain=z)
    return report.brackets["{Q,P}"].size


def _naive(defect: float, length: float, momentum: float) -> float:
    """The largest entry of M J Mᵀ − J, whatever its units."""
    import numpy as np

    identity, zero = np.eye(2), np.zeros(2)
    columns = [np.concatenate(_step(e, zero, defect, length, momentum)) for e in identity]
    columns += [np.concatenate(_step(zero, e, defect, length, momentum)) for e in identity]
    M = np.array(columns).T
    J = np.kron(np.array([[0.0, 1.0], [-1.0, 0.0]]), identity)
    return float(np.abs(M @ J @ M.T - J).max())


CASES = (
    HardCase(
        "electrons, protons and planets in SI units",
        "units",
        "the defect of a faulty step, as a residual beside its bound",
        ("defect", "length", "momentum"),
        ((0.5, 1e-10, 2e-24), (0.5, 10.0, 4e-20), (0.5, 1.5e11, 1.8e29)),
        _defect,
        each(_ours),
        each(_naive),
    ),
)
