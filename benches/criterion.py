"""What the last `cargo bench` measured of the Rust core alone."""

import json
from collections.abc import Iterator
from pathlib import Path

from benches.table import ROOT, Figure
from rsoccer import _core

CRITERION = ROOT / "target" / "criterion"
LEAGUES = {"vss": "VSSS", "ssl": "SSL"}


def physics_alone(folder: Path = CRITERION, *, since: float | None = None) -> Iterator[Figure]:
    """Figures that it left; none that are older than the build at hand, or than `since`."""
    oldest = Path(_core.__file__).stat().st_mtime if since is None else since
    for path in sorted(folder.glob("**/new/benchmark.json")):
        case = json.loads(path.read_text())
        if case["throughput"] is None or path.stat().st_mtime < oldest:
            continue  # not of steps, or of another build
        median = json.loads((path.parent / "estimates.json").read_text())["median"]
        within = median["confidence_interval"]
        steps = 1e9 * case["throughput"]["Elements"]  # times are in nanoseconds
        worlds, threads = case["value_str"].split("x")
        yield Figure(
            group="rust",
            game=f"{_teams(case['group_id'])} {case['function_id']}",
            who="rsim-core",
            worlds=int(worlds),
            threads=int(threads),
            quantity="speed",
            unit="world-steps/s",
            median=steps / median["point_estimate"],
            least=steps / within["upper_bound"],
            most=steps / within["lower_bound"],
            rounds=1,
        )


def _teams(group: str) -> str:
    """`vss_3v3_step` as "VSSS 3 v 3"."""
    league, sizes = group.removesuffix("_step").split("_")
    return f"{LEAGUES[league]} {sizes.replace('v', ' v ')}"
