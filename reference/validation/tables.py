"""The comparison's figures as Markdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from validation.compare import Comparison


def table(name: str, result: Comparison, variant: str) -> str:
    """One scene: a line of facts, a table with a row for each band, and what failed."""
    ours, theirs = result.ours, result.theirs
    height, width, _ = ours.mean.shape
    lines = [
        f"## {name}: {'agrees' if result.passed else 'DIFFERS'}",
        "",
        f"{width} × {height} pixels. Lamina {ours.spp} samples a pixel over {ours.passes} seeds, "
        f"{ours.seconds:.1f} s; Mitsuba ({variant}) {theirs.spp} over {theirs.passes} passes, "
        f"{theirs.seconds:.1f} s.",
        "",
        "| band nm | mean W m⁻² sr⁻¹ nm⁻¹ | difference of means | z | pixels that pass | "
        "largest regional bias | z |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for band in result.bands:
        lines.append(
            f"| {band.name} | {band.mean:.5g} | {100 * band.difference:+.3f} ± "
            f"{100 * band.error:.3f} % | {band.z:+.2f} | {100 * band.pixels_passed:.3f} % | "
            f"{100 * band.region_bias:+.3f} ± {100 * band.region_error:.3f} % | "
            f"{band.region_z:+.2f} |"
        )
    figures = result.delta_e_figures()
    if figures:
        lines += [
            "",
            f"ΔE2000 (shown, not tested): mean {figures['mean']:.3f}, 95th percentile "
            f"{figures['p95']:.3f}.",
        ]
    if result.failures:
        lines += ["", *(f"- {failure}" for failure in result.failures)]
    return "\n".join(lines) + "\n"
