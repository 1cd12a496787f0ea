"""What a person or a program is shown of verdicts: tables on a terminal, JSON records."""
