"""Maps of colours in Mitsuba, as the texture `lamina_colours`.

Written from `docs/src/theory/spectra.md` ("RGB to spectra") and `docs/src/format/material.md`. A
map is one picture or several, side by side along u. A colour (r, g, b), linear sRGB, becomes the
sum of the three spectra of the table that the export carries: r red + g green + b blue.

Parameters of the plugin:

- `basis`: the file of the three spectra, `wavelength_nm,red,green,blue`;
- `repeats_u`, `repeats_v`: how often the pictures lie in what is 1 wide;
- `tinted`: whether the mesh's attribute `vertex_tint` is a factor on the colours;
- `slot_0`, `slot_1`, …: where a picture begins along u, what is taken from u, and a factor on red,
  green and blue; then, unless it is of one colour, what lies beside it across and down (`repeat`,
  `mirror` or `clamp`) and its file, an EXR whose first row is on top.

Import it after the variant is chosen; `register()` makes the plugin known.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np
import OpenImageIO as oiio

from lamina.mitsuba.lookup import Table, cell

Double = dr.float64_array_t(mi.UnpolarizedSpectrum)
CHANNELS = "RGB"


def wrapped(number: Any, count: int, wrap: str) -> Any:
    """The texel for a whole number of any size (a float)."""
    if wrap == "clamp":
        return dr.clip(number, 0.0, count - 1.0)
    period = float(count if wrap == "repeat" else 2 * count)
    number = number - period * dr.floor(number / period)
    if wrap == "mirror":
        number = dr.minimum(number, period - 1.0 - number)
    # Rounding of a large number may leave the period.
    return dr.clip(number, 0.0, count - 1.0)


def whole(number: Any) -> Any:
    """A whole number as an index."""
    return int(number) if isinstance(number, float) else mi.UInt32(number)


class Slot:
    """One picture, or one colour."""

    def __init__(self, text: str) -> None:
        words = text.split(maxsplit=7)
        self.begins, self.shift = (float(word) for word in words[:2])
        self.factor = [float(word) for word in words[2:5]]
        self.tables: list[Table] = []
        if len(words) == 5:
            return
        self.wrap = words[5], words[6]
        file = str(mi.file_resolver().resolve(words[7]))
        image = oiio.ImageInput.open(file)
        if image is None:
            raise RuntimeError(f"{file}: {oiio.geterror()}")
        spec = image.spec()
        pixels = np.asarray(image.read_image(oiio.FLOAT))
        image.close()
        names = list(spec.channelnames)
        self.width, self.height = spec.width, spec.height
        self.tables = [Table(pixels[:, :, names.index(name)]) for name in CHANNELS]

    def at(self, u: Any, v: Any, repeats: tuple[float, float]) -> list[Any]:
        """The colour at texture coordinates."""
        if not self.tables:
            return [mi.Float(factor) for factor in self.factor]
        x = (u - self.shift) * repeats[0] * self.width - 0.5
        y = (1.0 - v * repeats[1]) * self.height - 0.5
        x0, y0 = dr.floor(x), dr.floor(y)
        colour = [mi.Float(0.0)] * 3
        for dy, weight_y in ((0.0, 1.0 - (y - y0)), (1.0, y - y0)):
            row = whole(wrapped(y0 + dy, self.height, self.wrap[1]))
            for dx, weight_x in ((0.0, 1.0 - (x - x0)), (1.0, x - x0)):
                at = row * self.width + whole(wrapped(x0 + dx, self.width, self.wrap[0]))
                colour = [
                    sum + weight_x * weight_y * table.at(mi.Float, at)
                    for sum, table in zip(colour, self.tables, strict=True)
                ]
        return [factor * value for factor, value in zip(self.factor, colour, strict=True)]


class ColourTexture(mi.Texture):
    """Reflectances of a map of colours."""

    def __init__(self, props: mi.Properties) -> None:
        mi.Texture.__init__(self, props)
        resolve = mi.file_resolver().resolve
        text = Path(str(resolve(str(props.get("basis"))))).read_text(encoding="utf-8")
        rows = [line for line in text.splitlines() if line[:1].isdigit()]
        table = np.array([[float(number) for number in row.split(",")] for row in rows])
        self.first, self.step = table[0, 0], table[1, 0] - table[0, 0]
        self.count = len(table)
        self.basis = [Table(column, double=True) for column in table[:, 1:].T]
        self.repeats = float(props.get("repeats_u")), float(props.get("repeats_v"))
        self.is_tinted = bool(props.get("tinted"))
        self.slots: list[Slot] = []
        while f"slot_{len(self.slots)}" in props:
            self.slots.append(Slot(str(props.get(f"slot_{len(self.slots)}"))))

    def chosen(self, si: Any, values: list[Any]) -> Any:
        """That of a list of values, one for each slot, whose slot is at a hit."""
        value = values[0]
        for slot, other in zip(self.slots[1:], values[1:], strict=True):
            value = dr.select(si.uv.x >= slot.begins, other, value)
        return value

    def eval_3(self, si: Any, active: Any = True) -> Any:
        """The colour at a hit."""
        colours = [slot.at(si.uv.x, si.uv.y, self.repeats) for slot in self.slots]
        colour = [self.chosen(si, list(channel)) for channel in zip(*colours, strict=True)]
        if self.is_tinted:
            tint = si.shape.eval_attribute_3("vertex_tint", si, active)
            colour = [value * factor for value, factor in zip(colour, tint, strict=True)]
        return mi.Color3f(*colour)

    def eval(self, si: Any, active: Any = True) -> Any:
        """Reflectance at a hit, at its wavelengths."""
        colour = self.eval_3(si, active)
        at, share = cell(Double, (Double(si.wavelengths) - self.first) / self.step, self.count)
        above = [i + 1 for i in at] if isinstance(at, list) else at + 1
        reflected = Double(0.0)
        for value, basis in zip((colour.x, colour.y, colour.z), self.basis, strict=True):
            low, high = basis.at(Double, at), basis.at(Double, above)
            reflected = reflected + Double(value) * (low + share * (high - low))
        return mi.UnpolarizedSpectrum(reflected)

    def is_spatially_varying(self) -> bool:
        """It is a map."""
        return True

    def traverse(self, callback: Any) -> None:
        """It has no parameters that are changed after loading."""

    def to_string(self) -> str:
        """For messages."""
        return f"ColourTexture[{len(self.slots)} slots]"


def register() -> None:
    """Makes `lamina_colours` known to Mitsuba."""
    mi.register_texture("lamina_colours", ColourTexture)
