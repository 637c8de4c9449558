"""Noise models, and how often the statistics are wrong or right under them."""
