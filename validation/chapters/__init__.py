"""Pieces of validation/run: cases, runs, verdicts, figures and the report."""
