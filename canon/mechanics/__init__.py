"""The objects of mechanics as immutable values with symbolic methods, one object a file.

Nothing here decides whether an expression is zero: residuals are returned, claims are stated, others judge.
"""
