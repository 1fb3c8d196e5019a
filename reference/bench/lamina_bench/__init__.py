"""Renders six leaf scenes with Lamina and with its peers, and compares error and time."""
