"""Drift over many commits."""
