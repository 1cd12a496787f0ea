"""Numbers: formulas lowered to jax, derivatives beside their rounding, residuals and loops. Never verdicts."""
