"""Separation of variables in the Hamilton–Jacobi equation: coordinates, Stäckel's theorem, Levi-Civita's conditions."""
