"""A campaign against the verdicts: random claims whose truth is known beforehand or found out by other means.

`python -m properties.soundness --maps 10000 --seed 1 --jobs 2 --json` states random claims as claim files, has them
decided, and counts the verdicts that are wrong. Nothing of the deciders is used to find out what is true: maps are
canonical by construction, and what is false is so at a point where the formulas, evaluated by mpmath as they were
written, differ in high precision.
"""
