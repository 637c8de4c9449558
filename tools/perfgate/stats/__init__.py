"""Exact statistics on plain lists of numbers."""
