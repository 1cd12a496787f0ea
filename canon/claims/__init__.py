"""Claims of mechanics, one module a family, each stated as expressions that must vanish."""
