"""All plugins. Import this module after Mitsuba's variant is chosen."""

from __future__ import annotations

from lamina.mitsuba import (
    colour_texture,
    hapke_bsdf,
    lights,
    model_bsdf,
    plastic_bsdf,
    relief_bsdf,
)


def register() -> None:
    """Makes all plugins known to Mitsuba."""
    relief_bsdf.register()
    plastic_bsdf.register()
    model_bsdf.register()
    hapke_bsdf.register()
    colour_texture.register()
    lights.register()
