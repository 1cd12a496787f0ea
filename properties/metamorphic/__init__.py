"""Claims of known truth written otherwise, by rules: `python -m properties.metamorphic`."""
