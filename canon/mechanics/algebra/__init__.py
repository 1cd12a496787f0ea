"""Lie algebras by their structure constants: the value, its theory over the rationals, and its name over the reals."""
