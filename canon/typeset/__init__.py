"""Formulas as they are set: from the language of claim files to plain text, LaTeX and MathML."""
