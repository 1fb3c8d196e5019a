"""All plugins of the comparison. Import it after Mitsuba's variant is chosen."""

from __future__ import annotations

from lamina.mitsuba import colour_texture, lights, plastic_bsdf, relief_bsdf


def register() -> None:
    """Makes them known to Mitsuba."""
    relief_bsdf.register()
    plastic_bsdf.register()
    colour_texture.register()
    lights.register()
