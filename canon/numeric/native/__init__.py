"""Steps as native code: what XLA leaves in memory between two of its loops stays in registers here.

A step that is a straight line of elementary operations becomes one loop of machine code, by LLVM (the optional extra
`native`), for one orbit or for several in the lanes of registers. Everything else is left to XLA.
"""
