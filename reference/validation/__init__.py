"""Comparisons of Lamina with other software; `reference/run` lists them."""
