"""The page of the playground: its parts and data."""

import base64
import html
import tempfile
from functools import cache
from pathlib import Path
from typing import Any, Final, NamedTuple

import rsoccer
from rsoccer._core import COMMAND_COLUMNS, SimConfig
from rsoccer.policies.network import Network
from rsoccer.policies.trained import FOLDER, load_best_network, load_file
from rsoccer.replay import match_page, page
from rsoccer.replay.quantized import STEPS
from tools.playground.keys import key_words, keys

WEB: Final = Path(__file__).parent / "web"
"""Parts of the page that are its own."""
DRAWING: Final = ("ghosts.js", "field.js", "match.js", "match_floor.js")
"""Scripts of the pages of replays that draw."""
SCRIPTS: Final = (
    *("engine.js", "live_rows.js", "words.js", "inputs.js", "recorder.js", "situations.js"),
    *("conditions.js", "playground.js"),
)
"""Scripts of the playground, in their order."""
NO_ICON: Final = '<link rel="icon" href="data:,">\n'
"""An empty icon, which a browser would ask a server for."""
HALF_SECONDS: Final = 300.0
"""Playing time of a half, s: the default of `Setup` in `crates/rsim-match`."""


class Policy(NamedTuple):
    """A shipped policy that a league of the playground has."""

    id: str
    """value of the choice, and of links"""
    name: str
    """words of the choice"""
    file: str
    """name of its file in the package; or of a task and a field, and perhaps "robust", where the
    policy of another task plays"""


class League(NamedTuple):
    """A choice of field and team size."""

    id: str
    """value of the choice, and of links"""
    name: str
    """words of the choice"""
    field: str
    """preset of the field"""
    robots: int
    """robots of each team"""
    task: str
    """task whose matches these are, for saved replays"""
    policies: tuple[Policy, ...] = ()
    """shipped policies with observations of such matches"""
    play: str = "match"
    """kind of play of the module: "match", or "self_play" for a task"""


_SSL: Final = (Policy("best", "best of SSLSelfPlay-v0", "SSLSelfPlay-v0.safetensors"),)
_SSL_MATCH: Final = (Policy("best", "best of SSLMatch-v0", "SSLMatch-v0.safetensors"),)
_VSS: Final = (
    Policy("best", "best of VSSSelfPlay-v0", "VSSSelfPlay-v0.safetensors"),
    Policy("multi", "best of VSSMulti-v0", "VSSMulti-v0.safetensors"),
    Policy("robust", "best:robust of VSSSelfPlay-v0", "VSSSelfPlay-v0.robust.safetensors"),
)
_VSS_5: Final = (
    Policy("best", "best of VSSMatch-v0", "VSSMatch-v0 vss_5v5"),
    Policy("robust", "best:robust of VSSMatch-v0", "VSSMatch-v0 vss_5v5 robust"),
)
LEAGUES: Final = (
    League("ssl_b", "SSL, 6 v 6 (division B)", "ssl_b", 6, "SSLMatch-v0", _SSL_MATCH),
    League("ssl_a", "SSL, 11 v 11 (division A)", "ssl_a", 11, "SSLMatch-v0", _SSL_MATCH),
    League("ssl_3", "SSL, 3 v 3 on a small field", "ssl_challenge", 3, "SSLMatch-v0", _SSL),
    League("vss", "VSSS, 3 v 3", "vss_3v3", 3, "VSSMatch-v0", _VSS),
    League("vss_5", "VSSS, 5 v 5", "vss_5v5", 5, "VSSMatch-v0", _VSS_5),
    League(
        "ssl_self_play",
        "Task SSLSelfPlay-v0",
        field="ssl_challenge",
        robots=3,
        task="SSLSelfPlay-v0",
        policies=_SSL,
        play="self_play",
    ),
    League(
        "vss_self_play",
        "Task VSSSelfPlay-v0",
        field="vss_3v3",
        robots=3,
        task="VSSSelfPlay-v0",
        policies=_VSS,
        play="self_play",
    ),
)
"""Choices of the page, the first one is shown at first."""


def to_html(module: str) -> str:
    """Return the page.

    Args:
        module: the WebAssembly module, compressed by gzip, in base64.

    Returns:
        HTML that needs no other file.
    """
    scripts = [*map(page.web_part, DRAWING), *map(web_part, SCRIPTS)]
    styles = [page.web_part("style.css"), page.web_part("match.css"), web_part("playground.css")]
    about = f"rSoccer {rsoccer.__version__}: physics, referee and teams run in this page."
    parts = {
        "data": page.to_json(data()),
        "module": module,
        "about": html.escape(about),
        "keys": html.escape(key_words()),
    }
    body = page.fill(web_part("page.html"), parts)
    return page.document("rSoccer playground", "".join(styles), body, scripts, NO_ICON)


def data() -> dict[str, Any]:
    """Return all that the page shows and that the module does not know, as values for JSON."""
    configs = {league.field: _config(league) for league in LEAGUES}
    return {
        "version": rsoccer.__version__,
        "halfSeconds": HALF_SECONDS,
        "leagues": [_league(league) for league in LEAGUES],
        "files": {
            policy.file: _encoded(policy.file) for each in LEAGUES for policy in each.policies
        },
        "scenes": {name: page.scene(config) for name, config in configs.items()},
        "areas": {name: match_page.areas(config.field) for name, config in configs.items()},
        "floor": match_page.FLOOR,
        "keys": keys(),
        "steps": STEPS,
        "commandColumns": {name: COMMAND_COLUMNS[name] for name in ("differential", "omni")},
    }


@cache
def web_part(name: str) -> str:
    """Return the text of a part of the page.

    Args:
        name: name of a file in the folder `web`.
    """
    return (WEB / name).read_text(encoding="utf-8")


def _config(league: League) -> SimConfig:
    return SimConfig(league.field, league.robots, league.robots)


def _league(league: League) -> dict[str, Any]:
    """A choice with its policies."""
    policies = [policy._asdict() for policy in league.policies]
    scripted = _config(league).robot.drive == "omni"
    return {**league._asdict(), "policies": policies, "scripted": scripted}


def _encoded(name: str) -> str:
    """The file of a shipped policy in base64, of a network without what a lookahead needs."""
    if (FOLDER / name).exists():
        policy = load_file(FOLDER / name)
        if not isinstance(policy, Network):
            return base64.b64encode((FOLDER / name).read_bytes()).decode()
        network = policy
    else:
        task, field, *variant = name.split()
        league = next(league for league in LEAGUES if league.field == field)
        robots = {"n_blue": league.robots, "n_yellow": league.robots}
        network = load_best_network(rsoccer.make_task(task, field=field, **robots), *variant)
    network.set_value(None)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "policy.safetensors"
        network.save(path, half_precision=True)
        return base64.b64encode(path.read_bytes()).decode()
