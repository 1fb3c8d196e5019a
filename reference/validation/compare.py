"""Two pictures of one scene: are they the same but for noise?

Both come with the variance of the mean of every pixel and band. The null hypothesis is that
both programs have the same expectation in every pixel. Three tests, all of which must pass:

1. **Mean**: per band, the difference of the pictures' means over its standard error, |z| < 3;
   and the standard error is at most 0.2 % of the mean, so that an error of 0.5 % shows.
2. **Pixels**: per pixel and band z = difference / √(sum of variances); its two-sided p-value is
   compared with Šidák's level 1 - (1 - 0.01)^(1/n) over the n pixels and bands; at least 99.75 %
   of them must pass.
3. **Regions**: a grid of 4 × 4 regions, the mean difference of each over its standard error;
   the largest |z| over regions and bands is compared with the two-sided level of 3 σ, 0.0027,
   corrected by Šidák for their number (about 4.1 for 16 regions in 4 bands).

The variances are estimates from a number of passes, so that z has Student's t distribution, not a
normal one, whose tails are heavier: the pixel test uses t with the degrees of freedom of Welch and
Satterthwaite.

A pixel in which rare bright paths make the sum skewed can still fail by itself, for which the
0.25 % are; the mean and the regions rest on hundreds of pixels and the central limit theorem.
Pixels that differ by rounding alone (1e-4 of the band's mean) pass.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from scipy.stats import norm
from scipy.stats import t as student

from validation import colour
from validation.picture import Array, Picture

GRID = 4
SIGNIFICANCE = 0.01
PASSING_PIXELS = 0.9975
THREE_SIGMA = float(2.0 * norm.sf(3.0))
LARGEST_ERROR = 0.002
ROUNDING = 1e-4
CRITERIA = ("finite", "mean", "error", "pixels", "regions")


@dataclass
class Band:
    """How one band fares. Differences are ours minus theirs, relative to their mean."""

    name: str
    mean: float
    difference: float
    error: float
    z: float
    pixels_passed: float
    region_bias: float
    region_error: float
    region_z: float


@dataclass
class Comparison:
    """The verdict on a pair of pictures, and the maps behind it."""

    bands: list[Band]
    failures: list[str]
    z: Array = field(repr=False)
    ours: Picture = field(repr=False)
    theirs: Picture = field(repr=False)

    @property
    def passed(self) -> bool:
        """Whether every test holds."""
        return not self.failures

    def checks(self) -> dict[str, bool]:
        """Each criterion, and whether it holds in every band."""
        found = " ".join(self.failures)
        return {criterion: f"[{criterion}]" not in found for criterion in CRITERIA}

    def as_json(self) -> dict:
        """The figures without the maps."""
        return {
            "passed": self.passed,
            "failures": self.failures,
            "bands": [asdict(band) for band in self.bands],
            "seconds": {"lamina": self.ours.seconds, "mitsuba": self.theirs.seconds},
            "spp": {"lamina": self.ours.spp, "mitsuba": self.theirs.spp},
            "delta_e_2000": self.delta_e_figures(),
        }

    def delta_e(self) -> Array | None:
        """ΔE2000 of each pixel, if the bands reach over the visible range."""
        return colour.delta_e_2000(
            self.ours.mean, self.theirs.mean, [float(band.name) for band in self.bands]
        )

    def delta_e_figures(self) -> dict[str, float] | None:
        """Mean and 95th percentile of ΔE2000; shown, not used to pass."""
        delta = self.delta_e()
        if delta is None:
            return None
        return {"mean": float(delta.mean()), "p95": float(np.percentile(delta, 95.0))}

    def write_pictures(self, folder: Path, stem: str) -> None:
        """Writes what a report shows: `stem-lamina.png` and `stem-mitsuba.png` at one exposure,
        `stem-difference.png` and `stem-z.png` (bands side by side) and, if there is colour,
        `stem-delta-e.png`.
        """
        names = [float(band.name) for band in self.bands]
        pair = colour.shown(self.ours.mean, self.theirs.mean, names)
        for whose, picture in zip(("lamina", "mitsuba"), pair, strict=True):
            write_png(folder / f"{stem}-{whose}.png", picture)
        mean = np.maximum(self.theirs.mean.mean(axis=(0, 1)), np.finfo(float).tiny)
        difference = (self.ours.mean - self.theirs.mean) / mean
        for what, level in (("difference", difference / 0.2), ("z", self.z / 4.0)):
            write_png(folder / f"{stem}-{what}.png", diverging(level))
        delta = self.delta_e()
        if delta is not None:
            # Black to white at ΔE 4; 1 is about what an eye can tell.
            grey = np.clip(delta / 4.0, 0.0, 1.0)
            write_png(folder / f"{stem}-delta-e.png", np.repeat(grey[:, :, None], 3, axis=2))


def diverging(levels: Array) -> Array:
    """Bands side by side, −1 to 1 from blue over white to red."""
    level = np.clip(levels, -1.0, 1.0)
    flat = np.concatenate([level[:, :, band] for band in range(level.shape[2])], axis=1)
    rgb = np.stack([1.0 + np.minimum(flat, 0.0), 1.0 - np.abs(flat), 1.0 - np.maximum(flat, 0.0)])
    return np.moveaxis(rgb, 0, -1)


def compare(ours: Picture, theirs: Picture, names: list[str]) -> Comparison:
    """Compares two pictures of one shape; `names` are the bands' centres in nm."""
    if ours.mean.shape != theirs.mean.shape or ours.mean.shape[2] != len(names):
        raise ValueError(f"shapes {ours.mean.shape} and {theirs.mean.shape}, bands {names}")
    failures = []
    for whose, picture in (("ours", ours), ("theirs", theirs)):
        if not (np.isfinite(picture.mean).all() and np.isfinite(picture.variance).all()):
            failures.append(f"[finite] {whose} has numbers that are not finite")
    difference = ours.mean - theirs.mean
    variance = ours.variance + theirs.variance
    scale = np.maximum(theirs.mean.mean(axis=(0, 1)), np.finfo(float).tiny)
    same = np.abs(difference) <= ROUNDING * scale
    z = np.where(
        variance > 0.0,
        difference / np.sqrt(np.where(variance > 0.0, variance, 1.0)),
        np.where(same, 0.0, np.inf * np.sign(difference)),
    )
    level = sidak(SIGNIFICANCE, z.size)
    p = 2.0 * student.sf(np.abs(z), freedom(ours, theirs))
    good = (p >= level) | same

    regions = GRID * GRID * len(names)
    region_limit = float(norm.isf(0.5 * sidak(THREE_SIGMA, regions)))
    bands = []
    for number, name in enumerate(names):
        d, v = difference[:, :, number], variance[:, :, number]
        mean = float(scale[number])
        off, error = float(d.mean()) / mean, float(np.sqrt(v.sum())) / v.size / mean
        band_z = off / error if error > 0.0 else (0.0 if abs(off) <= ROUNDING else np.inf)
        bias, region_error, region_z = worst_region(d, v, theirs.mean[:, :, number], mean)
        share = float(good[:, :, number].mean())
        bands.append(Band(name, mean, off, error, band_z, share, bias, region_error, region_z))
        if not abs(band_z) < 3.0:
            failures.append(
                f"[mean] {name} nm: the mean differs by {100 * off:+.3f} %, z = {band_z:+.2f}"
            )
        if not error <= LARGEST_ERROR:
            failures.append(f"[error] {name} nm: standard error {100 * error:.3f} % is above 0.2 %")
        if not share >= PASSING_PIXELS:
            failures.append(f"[pixels] {name} nm: only {100 * share:.3f} % of the pixels pass")
        if not abs(region_z) < region_limit:
            failures.append(
                f"[regions] {name} nm: a region differs by {100 * bias:+.3f} %, z = {region_z:+.2f}"
            )
    return Comparison(bands, failures, np.nan_to_num(z, posinf=99.0, neginf=-99.0), ours, theirs)


def sidak(level: float, tests: int) -> float:
    """The level for each of `tests` tests that makes `level` for all of them."""
    return float(-np.expm1(np.log1p(-level) / tests))


def freedom(ours: Picture, theirs: Picture) -> Array:
    """Welch-Satterthwaite degrees of freedom of each pixel's z; a million for "many"."""
    total = ours.variance + theirs.variance
    terms = np.zeros_like(total)
    for picture in (ours, theirs):
        if picture.passes:
            terms += picture.variance**2 / max(picture.passes - 1, 1)
    return np.where(terms > 0.0, np.minimum(total**2 / np.where(terms > 0, terms, 1.0), 1e6), 1e6)


def worst_region(d: Array, v: Array, theirs: Array, mean: float) -> tuple[float, float, float]:
    """Bias, its standard error (both relative to the region's mean) and z of the worst region.

    The worst is that of the largest |z|. Regions that hold nothing (black) count as equal.
    """
    worst = (0.0, 0.0, 0.0)
    rows = np.array_split(np.arange(d.shape[0]), GRID)
    columns = np.array_split(np.arange(d.shape[1]), GRID)
    for row in rows:
        for column in columns:
            cell = np.ix_(row, column)
            off, error = float(d[cell].mean()), float(np.sqrt(v[cell].sum())) / v[cell].size
            if abs(off) <= ROUNDING * mean:
                continue
            level = max(float(theirs[cell].mean()), np.finfo(float).tiny)
            z = off / error if error > 0.0 else np.inf
            if abs(z) >= abs(worst[2]):
                worst = (off / level, error / level, z)
    return worst


def write_png(file: Path, rgb: Array) -> None:
    """Writes an 8-bit PNG from values in [0, 1]."""
    pixels = np.ascontiguousarray(np.round(255.0 * np.clip(rgb, 0.0, 1.0)).astype(np.uint8))
    out = oiio.ImageOutput.create(str(file))
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], oiio.UINT8)
    if out is None or not out.open(str(file), spec) or not out.write_image(pixels):
        raise RuntimeError(f"{file}: {oiio.geterror()}")
    out.close()
