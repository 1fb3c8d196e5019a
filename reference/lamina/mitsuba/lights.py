"""Lights whose radiance changes over them, as textures in Mitsuba.

Written from `docs/src/format/light.md`, `docs/src/theory/daylight.md` and
`docs/src/theory/spectra.md`.

- `lamina_sky`: radiance by direction, on the sphere around a scene. `weights` is an EXR with the
  channels R, G, B, its columns around the horizon from `rotation` (rad, from +x towards +y), its
  rows from the zenith down. `spectra` is a table with a line a wavelength: nm, and the spectra
  that red, green and blue weigh, linear between lines. With a fifth column, the ground's, the rows
  end at the horizon, below which that is the radiance; above it the channel A weighs it.
- `lamina_sum`: the sum of all textures that it holds.
- `lamina_sun`: a disk that is darker towards its limb; `irradiance` on what faces it, and
  `half_diameter` in rad.
- `lamina_pattern`: `radiance` times a bell over uv with `edge_share` in the middle of the edges,
  times the texture `colours`, or times `picture`, an EXR with its upper border at v = 1, whose
  colours become spectra by `red`, `green` and `blue`.

Import it after the variant is chosen; `register()` makes the plugins known.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import drjit as dr
import mitsuba as mi
import numpy as np

from lamina.exr import read_channels
from lamina.mitsuba.lookup import Table, cell

PRIMARIES = ("red", "green", "blue")


class Weights:
    """Three or four maps, bilinear between texels; rows are clamped, columns too or wrapped."""

    def __init__(self, file: Path, wraps: bool) -> None:
        channels = read_channels(file)
        self.height, self.width = channels["R"].shape
        # A border, so that there is a cell everywhere.
        mode: Literal["wrap", "edge"] = "wrap" if wraps else "edge"
        self.tables = []
        for name in "RGBA"[: 4 if "A" in channels else 3]:
            plane = np.pad(channels[name], ((0, 0), (1, 1)), mode=mode)
            self.tables.append(Table(np.pad(plane, ((1, 1), (0, 0)), mode="edge")))

    def at(self, across: Any, down: Any) -> list[Any]:
        """The weights at shares of the width from the left and the height from the top."""
        x, a = cell(mi.Float, across * self.width + 0.5, self.width + 2)
        y, b = cell(mi.Float, down * self.height + 0.5, self.height + 2)
        corner = y * (self.width + 2) + x
        below = corner + (self.width + 2)
        found = []
        for table in self.tables:
            high = dr.lerp(table.at(mi.Float, corner), table.at(mi.Float, corner + 1), a)
            low = dr.lerp(table.at(mi.Float, below), table.at(mi.Float, below + 1), a)
            found.append(dr.lerp(high, low, b))
        return found


class Spectrum:
    """A spectrum of either sign, linear between wavelengths, with its end values outside."""

    STEP_NM = 0.25

    def __init__(self, nm: np.ndarray, values: np.ndarray) -> None:
        self.first = float(nm[0])
        self.count = max(int(np.ceil((nm[-1] - nm[0]) / self.STEP_NM)) + 1, 2)
        grid = self.first + self.STEP_NM * np.arange(self.count)
        self.table = Table(np.interp(grid, nm, values))

    def at(self, wavelengths: Any) -> Any:
        """Values at wavelengths in nm."""
        kind = mi.UnpolarizedSpectrum
        place, share = cell(kind, (wavelengths - self.first) / self.STEP_NM, self.count)
        above = place + 1 if not isinstance(place, list) else [i + 1 for i in place]
        return dr.lerp(self.table.at(kind, place), self.table.at(kind, above), share)


def resolved(props: mi.Properties, name: str) -> Path:
    """A file that a parameter names."""
    return Path(str(mi.file_resolver().resolve(str(props.get(name)))))


class Radiance(mi.Texture):
    """What the textures of lights have in common: they are sampled by their shapes' areas."""

    def __init__(self, props: mi.Properties) -> None:
        mi.Texture.__init__(self, props)

    def is_spatially_varying(self) -> bool:
        """Told so that the emitter samples its shape."""
        return False

    def mean(self) -> Any:
        """Not used by paths."""
        return mi.Float(1.0)

    def max(self) -> float:
        """Not used by paths."""
        return 1.0

    def to_string(self) -> str:
        """For messages."""
        return f"{type(self).__name__}[]"


class Sky(Radiance):
    """Radiance by direction."""

    def __init__(self, props: mi.Properties) -> None:
        Radiance.__init__(self, props)
        self.weights = Weights(resolved(props, "weights"), wraps=True)
        table = np.loadtxt(resolved(props, "spectra"), delimiter=",", skiprows=1)
        # Mitsuba's own spectra are never negative, as those of a sky are.
        self.spectra = [Spectrum(table[:, 0], values) for values in table.T[1:]]
        self.has_ground = len(self.spectra) > len(PRIMARIES)
        self.rotation = float(props.get("rotation"))

    def eval(self, si: Any, active: Any = True) -> Any:
        """Radiance that arrives from where the sphere was hit."""
        # The sphere's normals point inwards.
        outwards = -si.n
        turns = (dr.atan2(outwards.y, outwards.x) - self.rotation) / (2.0 * dr.pi)
        level = dr.sqrt(outwards.x * outwards.x + outwards.y * outwards.y)
        down = dr.atan2(level, outwards.z) / dr.pi
        rows = 2.0 if self.has_ground else 1.0
        weights = self.weights.at(turns - dr.floor(turns), down * rows)
        total = mi.UnpolarizedSpectrum(0.0)
        for weight, spectrum in zip(weights[:3], self.spectra[:3], strict=True):
            total += weight * spectrum.at(si.wavelengths)
        # A picture's colours outside of Rec. 709 are below 0 at some wavelengths; a sky never is.
        if self.has_ground:
            total = dr.maximum(total, 0.0)
            ground = self.spectra[-1].at(si.wavelengths)
            total = dr.select(down < 0.5, total + weights[3] * ground, ground)
        return dr.select(active, total, 0.0)


class Sum(Radiance):
    """The sum of textures."""

    def __init__(self, props: mi.Properties) -> None:
        Radiance.__init__(self, props)
        names = [name for name in props.property_names() if name != "to_world"]
        self.parts = [props.get_unbounded_texture(name) for name in names]

    def eval(self, si: Any, active: Any = True) -> Any:
        """The sum at a point."""
        total = mi.UnpolarizedSpectrum(0.0)
        for part in self.parts:
            total += part.eval(si, active)
        return total


class Sun(Radiance):
    """A disk with limb darkening."""

    def __init__(self, props: mi.Properties) -> None:
        Radiance.__init__(self, props)
        self.irradiance = props.get_unbounded_texture("irradiance")
        self.sin2 = float(np.sin(float(props.get("half_diameter"))) ** 2)

    def eval(self, si: Any, active: Any = True) -> Any:
        """Radiance by the distance from the disk's middle, its first coordinate."""
        wavelengths = dr.clip(si.wavelengths, 416.0, 1099.0)
        exponent = -0.023 + 292.0 / wavelengths
        mu2 = dr.maximum(1.0 - si.uv.x * si.uv.x, 0.0)
        middle = (exponent + 2.0) / (2.0 * dr.pi * self.sin2)
        darker = dr.exp(0.5 * exponent * dr.log(dr.maximum(mu2, 1e-12)))
        return self.irradiance.eval(si, active) * middle * darker


class Pattern(Radiance):
    """Radiance over the texture coordinates of a lamp."""

    def __init__(self, props: mi.Properties) -> None:
        Radiance.__init__(self, props)
        self.radiance = props.get_unbounded_texture("radiance")
        self.edge = float(np.log(float(props.get("edge_share"))))
        self.picture = self.colours = None
        if "colours" in props:
            self.colours = props.get_unbounded_texture("colours")
        if "picture" in props:
            self.picture = Weights(resolved(props, "picture"), wraps=False)
            self.spectra = [props.get_unbounded_texture(name) for name in PRIMARIES]

    def eval(self, si: Any, active: Any = True) -> Any:
        """Radiance at a point of the lamp."""
        x, y = 2.0 * si.uv.x - 1.0, 2.0 * si.uv.y - 1.0
        value = self.radiance.eval(si, active) * dr.exp(self.edge * (x * x + y * y))
        if self.colours is not None:
            return value * self.colours.eval(si, active)
        if self.picture is None:
            return value
        colour = mi.UnpolarizedSpectrum(0.0)
        weights = self.picture.at(si.uv.x, 1.0 - si.uv.y)
        for weight, spectrum in zip(weights[:3], self.spectra, strict=True):
            colour += weight * spectrum.eval(si, active)
        return value * colour


def register() -> None:
    """Makes the textures known to Mitsuba."""
    for name, texture in (
        ("lamina_sky", Sky),
        ("lamina_sum", Sum),
        ("lamina_sun", Sun),
        ("lamina_pattern", Pattern),
    ):
        mi.register_texture(name, texture)
