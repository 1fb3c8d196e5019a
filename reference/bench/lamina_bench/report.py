"""The campaign's figures as a page of Markdown.

`python -m lamina_bench.report bench.json` writes the page anew from figures that are there.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from . import campaign, machine, programs, statistics

DASH = "–"
# The bare tracer is a yardstick of speed, not a program that anybody would use instead.
NOT_PEERS = ("lamina", "embree")


def page(results: dict) -> str:
    """The whole page."""
    about, plan = results["machine"], results["plan"]
    lines = [
        "# Lamina and its peers",
        "",
        "Written by `reference/bench/run`; `reference/bench/README.md` says what is measured and "
        "how.",
        "",
        f"{about['processor']}, {about['processors']} processors"
        f" ({', '.join(about['vectors']) or 'no AVX2'}), {about['memory_gib']} GiB, "
        f"{about['system']}; load {about['load_before']:.1f} before the start; "
        f"Lamina at commit {about['commit']}; {results['date']}.",
        "",
        f"{plan['size'][0]} × {plan['size'][1]} pixels, {plan['seeds']} seeds, "
        f"{' and '.join(str(spp) for spp in plan['ladder'])} samples a pixel; box filter, no "
        "denoiser, no clamping. Error: mean over pixels and channels of var / (mean² + ε), "
        f"ε = ({statistics.FLOOR:g} × the picture's mean)². Efficiency: 1 / (error × seconds), "
        f"where seconds are {campaign.CLOCKS[plan['clock']]}; medians.",
        "",
    ]
    lines += machine.warning(about)
    lines += versions(results["scenes"])
    lines += ["", "## Where Lamina stands", "",
              *standing(results["scenes"], plan["ladder"][-1])]  # fmt: skip
    for title, key in (
        (f"Efficiency at {plan['ladder'][-1]} samples a pixel", "top"),
        (f"Efficiency at the time that Lamina takes for {plan['ladder'][-1]}", "equal_time"),
    ):
        lines += ["", f"## {title}", "", *summary(results["scenes"], key)]
    for scene in results["scenes"]:
        lines += ["", *scene_table(scene)]
    return "\n".join(lines) + "\n"


def versions(scenes: list[dict]) -> list[str]:
    """A line with the version of each program that ran anywhere."""
    found: dict[str, str] = {}
    for scene in scenes:
        for row in scene["programs"]:
            if row["version"]:
                found.setdefault(row["title"], row["version"])
    return ["Versions: " + ", ".join(f"{name} {version}" for name, version in found.items()) + "."]


def chosen(row: dict, key: str) -> dict | None:
    """The point at the ladder's top, or that of equal time."""
    if key == "top":
        return row["points"][-1] if row["points"] else None
    return row["equal_time"]


def figure(row: dict | None, key: str, name: str) -> float | None:
    """A figure of a program at the ladder's top or at equal time, if there is one."""
    at = chosen(row, key) if row else None
    return at[name] if at else None


def ratio(ours: float | None, theirs: float | None) -> str:
    """Lamina's figure over another's."""
    return f"{ours / theirs:.2f}" if ours and theirs else DASH


def best_peer(rows: dict[str, dict], key: str, tuned: bool) -> tuple[str, float] | None:
    """Title and efficiency of the best peer; `tuned` admits samplers that are not the default."""
    peers = {
        row["title"]: value
        for name, row in rows.items()
        if name not in NOT_PEERS
        and (tuned or not name.endswith(programs.TUNED))
        and (value := figure(row, key, "efficiency"))
    }
    return max(peers.items(), key=lambda item: item[1], default=None)


def standing(scenes: list[dict], top: int) -> list[str]:
    """Where Lamina stands: against the best peer, the other spectral one, and bare tracing."""
    lines = [
        f"| scene | best peer at its defaults | Lamina over it, {top} spp | Lamina over the best "
        f"at equal time | best peer with any sampler | Lamina over it, {top} spp | "
        "Lamina over the best at equal time | Lamina over Mitsuba llvm_ad_spectral | "
        "paths per second over the bare tracer |",
        f"|{' --- |' * 9}",
    ]
    for scene in scenes:
        rows = {row["program"]: row for row in scene["programs"]}
        ours = rows.get("lamina")
        cells = []
        for tuned in (False, True):
            for key in ("top", "equal_time"):
                best = best_peer(rows, key, tuned)
                if key == "top":
                    missing = any(
                        figure(row, key, "efficiency") is None
                        for name, row in rows.items()
                        if name not in NOT_PEERS
                    )
                    among = " (of those that finished)" if missing else ""
                    cells.append(best[0] + among if best else DASH)
                value = ratio(figure(ours, key, "efficiency"), best[1] if best else None)
                cells.append(f"**{value}**")
        spectral = figure(rows.get("mitsuba-spectral"), "top", "efficiency")
        cells.append(ratio(figure(ours, "top", "efficiency"), spectral))
        bare = figure(rows.get("embree"), "top", "mpaths_per_s")
        cells.append(ratio(figure(ours, "top", "mpaths_per_s"), bare))
        lines.append(f"| {scene['title']} | {' | '.join(cells)} |")
    return lines


def summary(scenes: list[dict], key: str) -> list[str]:
    """Efficiency, scenes by programs."""
    names = list(dict.fromkeys(row["program"] for scene in scenes for row in scene["programs"]))
    titles = {row["program"]: row["title"] for scene in scenes for row in scene["programs"]}
    head = ["scene", *(titles[name] for name in names)]
    lines = [f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}"]
    for scene in scenes:
        rows = {row["program"]: row for row in scene["programs"]}
        cells = [number(figure(rows.get(name), key, "efficiency")) for name in names]
        lines.append(f"| {scene['title']} | {' | '.join(cells)} |")
    return lines


def scene_table(scene: dict) -> list[str]:
    """One scene, a row for each program."""
    lines = [
        f"## {scene['title']}",
        "",
        f"![Error against time](bench-{scene['name']}.svg)",
        "",
        "| program | start s | spp | wall s | CPU s | Mpaths/s | error | efficiency | "
        "at equal time: spp | wall s | error | efficiency | means off by (worst region) |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    notes = []
    for row in scene["programs"]:
        top, equal = chosen(row, "top"), row["equal_time"]
        if row["reason"]:
            notes.append(f"- {row['title']}: {row['reason']}.")
        start = DASH if row["start_s"] is None else f"{row['start_s']:.1f}"
        cells = [row["title"], start, *point_cells(top), *equal_cells(equal), difference(row)]
        lines.append(f"| {' | '.join(cells)} |")
    return [*lines, *([""] if notes else []), *notes]


def point_cells(at: dict | None) -> list[str]:
    """Columns of the ladder's top."""
    if at is None:
        return [DASH] * 6
    return [
        number(at["spp"]), number(at["wall_s"]), number(at["cpu_s"]), number(at["mpaths_per_s"]),
        number(at["rel_mse"]), number(at["efficiency"]),
    ]  # fmt: skip


def equal_cells(at: dict | None) -> list[str]:
    """Columns of equal time."""
    if at is None:
        return [DASH] * 4
    return [number(at[key]) for key in ("spp", "wall_s", "rel_mse", "efficiency")]


def difference(row: dict) -> str:
    """The largest relative difference of means, with its standard error."""
    worst = (0.0, 0.0, "")
    for region, (off, error) in row["off"].items():
        for value, width, channel in zip(off, error, "RGB", strict=True):
            if abs(value) >= abs(worst[0]):
                worst = (value, width, f"{region} {channel}")
    if not worst[2]:
        return DASH
    text = f"{100 * worst[0]:+.2f} ± {100 * worst[1]:.2f} % ({worst[2]})"
    bound = f"{100 * campaign.BOUND:g} %"
    return text if row["agrees"] else f"**{text}: beyond {bound}, so no efficiency**"


def number(value: float | None) -> str:
    """Three significant digits, without an exponent where it can be avoided."""
    if value is None:
        return DASH
    if value >= 100.0:
        return f"{value:.0f}"
    text = f"{value:.3g}"
    return f"{value:.6f}".rstrip("0") if "e" in text and value > 1e-6 else text


def main() -> None:
    """Writes `bench.md` beside the named `bench.json`."""
    file = Path(sys.argv[1])
    results = json.loads(file.read_text(encoding="utf-8"))
    file.with_suffix(".md").write_text(page(results), encoding="utf-8")


if __name__ == "__main__":
    main()
