"""Is it zero?  The exact and the enclosing arguments on which `proved` and `refuted` rest."""
