"""Results of the last `cargo bench`: speed of the Rust core alone."""

import json
from collections.abc import Iterator
from pathlib import Path

from benches.result_files import ROOT, Figure
from rsoccer import _core

CRITERION = ROOT / "target" / "criterion"
LEAGUES = {"vss": "VSSS", "ssl": "SSL"}


def core_figures(folder: Path = CRITERION, *, since: float | None = None) -> Iterator[Figure]:
    """Yield the figures in criterion's output folder.

    Figures older than `since` (s since the epoch; default: the installed build) are skipped.
    """
    oldest = Path(_core.__file__).stat().st_mtime if since is None else since
    for path in sorted(folder.glob("**/new/benchmark.json")):
        case = json.loads(path.read_text())
        if case["throughput"] is None or path.stat().st_mtime < oldest:
            continue  # measures no steps, or belongs to another build
        median = json.loads((path.parent / "estimates.json").read_text())["median"]
        interval = median["confidence_interval"]
        steps = 1e9 * case["throughput"]["Elements"]  # times are in nanoseconds
        league, sizes, engine = case["group_id"].split("_")
        teams = f"{LEAGUES[league]} {sizes.replace('v', ' v ')}"
        worlds, threads = case["value_str"].split("x")
        yield Figure(
            group="rust",
            scenario=f"{teams} {case['function_id']}",
            variant="rsim-core",
            engine=engine,
            worlds=int(worlds),
            threads=int(threads),
            quantity="speed",
            unit="world-steps/s",
            median=steps / median["point_estimate"],
            minimum=steps / interval["upper_bound"],
            maximum=steps / interval["lower_bound"],
            rounds=1,
        )
