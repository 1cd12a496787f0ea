"""Actions."""

KINDS = {}
