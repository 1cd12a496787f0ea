"""Proofs to be read: a verdict with what its certificate shows, as text, Markdown, LaTeX or HTML."""
