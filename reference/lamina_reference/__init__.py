"""Lamina's scenes in Mitsuba 3, and the comparison of both programs' pictures.

`variant.choose()` comes first: the other modules that use Mitsuba are bound to the variant that
is set when they are imported.
"""
