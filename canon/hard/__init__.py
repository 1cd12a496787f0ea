"""Hard cases: where textbook formulas lose digits, measured beside canon's own routines and the peers'.

A case states a quantity as a function of numbers that are taken exactly, by a formula that needs no care in enough
digits. The same formula in double precision is the naive route; how the quantity answers to its inputs, measured in
fifty digits, is what conditioning allows. Nothing in a row is typed in.
"""
