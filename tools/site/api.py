"""The reference of the Python package: which modules it shows, and in which order."""

import ast
import importlib
import inspect
from pathlib import Path
from typing import Final, NamedTuple

import rsoccer
from benches.markdown import table
from tools.paths import ROOT
from tools.site import stub


class Group(NamedTuple):
    """Modules that stand together in the reference."""

    title: str
    modules: tuple[str, ...]

    @property
    def page(self) -> str:
        """Name of the group's page, without an ending."""
        return self.title.lower().replace(" ", "-")


GROUPS: Final = (
    Group(
        "Playing",
        (
            "rsoccer.matches.loop",
            "rsoccer.matches.outcome",
            "rsoccer.controllers",
            "rsoccer.sources",
            "rsoccer.lineup",
            "rsoccer.envs.parallel",
            "rsoccer.envs.aec",
            "rsoccer.envs.single",
            "rsoccer.envs.vector",
            "rsoccer.envs.robots_vector",
            "rsoccer.envs.robot_rows",
            "rsoccer.history",
            "rsoccer.spaces",
            "rsoccer.global_state",
        ),
    ),
    Group(
        "Writing tasks",
        (
            "rsoccer.task",
            "rsoccer.task_definition",
            "rsoccer.observation_layout",
            "rsoccer.encoded_blocks",
            "rsoccer.play",
            "rsoccer.frame",
            "rsoccer.arrays",
            "rsoccer.reflection",
            "rsoccer.vectors",
            "rsoccer.view",
            "rsoccer.rng",
            "rsoccer.spawn",
            "rsoccer.rewards",
            "rsoccer.game",
            "rsoccer.rules",
            "rsoccer.rules.base",
            "rsoccer.rules.crossings",
            "rsoccer.rules.ball_out",
            "rsoccer.rules.free_ball",
            "rsoccer.rules.free_places",
            "rsoccer.rules.passes",
            "rsoccer.rules.possession",
            "rsoccer.rules.referee",
            "rsoccer.rules.referee_config",
            "rsoccer.referee",
            "rsoccer.referee.scene",
            "rsoccer.referee.start",
            "rsoccer.senses",
            "rsoccer.randomization",
            "rsoccer.markers",
            "rsoccer.registry",
            "rsoccer.registry.names",
            "rsoccer.registry.arguments",
            "rsoccer.option_values",
            "rsoccer.option_words",
            "rsoccer.plugins",
            "rsoccer.testing.task_check",
        ),
    ),
    Group(
        "Shipped tasks",
        (
            "rsoccer.tasks.soccer",
            "rsoccer.tasks.match",
            "rsoccer.tasks.vss",
            "rsoccer.tasks.vss_match",
            "rsoccer.tasks.vss_single",
            "rsoccer.tasks.vss_multi",
            "rsoccer.tasks.vss_self_play",
            "rsoccer.tasks.ssl",
            "rsoccer.tasks.ssl_attack",
            "rsoccer.tasks.ssl_contested_possession",
            "rsoccer.tasks.ssl_dribbling",
            "rsoccer.tasks.ssl_go_to_ball",
            "rsoccer.tasks.ssl_keepaway",
            "rsoccer.tasks.ssl_match",
            "rsoccer.tasks.ssl_pass",
            "rsoccer.tasks.ssl_pass_endurance",
            "rsoccer.tasks.ssl_pass_endurance_multi",
            "rsoccer.tasks.ssl_self_play",
            "rsoccer.tasks.ssl_static_defenders",
        ),
    ),
    Group("Physics", ("rsoccer._core",)),
    Group(
        "Simulators and robots",
        (
            "rsoccer.simulator_interface",
            "rsoccer.completed",
            "rsoccer.placed_by_hand",
            "rsoccer.derived",
            "rsoccer.derived.motion",
            "rsoccer.derived.lines",
            "rsoccer.derived.touches",
            "rsoccer.derived.collisions",
            "rsoccer.derived.track_record",
            "rsoccer.derived.outlines",
        ),
    ),
    Group(
        "Policies",
        (
            "rsoccer.policies",
            "rsoccer.policies.base",
            "rsoccer.policies.names",
            "rsoccer.policies.network",
            "rsoccer.policies.heads",
            "rsoccer.policies.policy_file",
            "rsoccer.policies.shield",
            "rsoccer.policies.tactics",
            "rsoccer.policies.evolved",
            "rsoccer.policies.libraries",
            "rsoccer.policies.torch_network",
            "rsoccer.policies.onnx_export",
            "rsoccer.policies.onnx_policy",
            "rsoccer.policies.trained",
        ),
    ),
    Group(
        "Training",
        (
            "rsoccer.train",
            "rsoccer.train.args",
            "rsoccer.train.rollout.settings",
            "rsoccer.train.network.settings",
            "rsoccer.train.ppo.settings",
            "rsoccer.train.opponents.settings",
            "rsoccer.train.run.settings",
            "rsoccer.train.run.callback",
            "rsoccer.train.task_settings",
            "rsoccer.train.distillation",
            "rsoccer.train.distillation.settings",
            "rsoccer.train.distillation.task_settings",
            "rsoccer.train.evolution",
            "rsoccer.train.evolution.settings",
            "rsoccer.train.evolution.strategy",
            "rsoccer.train.run.learning_curve",
            "rsoccer.train.rollout.running_mean_std",
            "rsoccer.train.rollout.transition",
        ),
    ),
    Group(
        "Evaluation",
        (
            "rsoccer.evaluate",
            "rsoccer.evaluate.evaluation",
            "rsoccer.evaluate.results",
            "rsoccer.evaluate.tournament",
            "rsoccer.evaluate.standings",
            "rsoccer.evaluate.ratings",
            "rsoccer.evaluate.cooperation",
            "rsoccer.evaluate.cooperation_report",
            "rsoccer.evaluate.team_play",
            "rsoccer.match_evaluation",
            "rsoccer.benchmark",
            "rsoccer.benchmark.protocol",
            "rsoccer.benchmark.conditions",
            "rsoccer.benchmark.measuring",
            "rsoccer.benchmark.entry",
            "rsoccer.benchmark.validation",
            "rsoccer.benchmark.numbers",
            "rsoccer.benchmark.replaying",
            "rsoccer.benchmark.table",
            "rsoccer.datasets",
            "rsoccer.datasets.episodes",
            "rsoccer.datasets.minari_dataset",
        ),
    ),
    Group(
        "Identification",
        (
            "rsoccer.identify",
            "rsoccer.identify.identification",
            "rsoccer.identify.log",
            "rsoccer.identify.log_files",
            "rsoccer.identify.program",
            "rsoccer.identify.recorder",
            "rsoccer.identify.report",
            "rsoccer.identify.results",
        ),
    ),
    Group(
        "Pictures and videos",
        (
            "rsoccer.render.image",
            "rsoccer.render.picture",
            "rsoccer.render.referee_state",
            "rsoccer.render.words",
            "rsoccer.render.announcer",
            "rsoccer.recording",
            "rsoccer.render.video",
            "rsoccer.render.window",
        ),
    ),
    Group(
        "Libraries",
        (
            "rsoccer.sb3.vec_env",
            "rsoccer.sb3.vec_normalize",
            "rsoccer.sb3.callback",
            "rsoccer.torchrl",
            "rsoccer.rllib.env",
            "rsoccer.rllib.runner",
            "rsoccer.rllib.league",
            "rsoccer.rllib.callback",
            "rsoccer.rllib.episodes",
            "rsoccer.rllib.decisions",
        ),
    ),
    Group(
        "Replays",
        (
            "rsoccer.replay.recorded",
            "rsoccer.replay.sensed_poses",
            "rsoccer.replay.replay",
            "rsoccer.replay.recorder",
            "rsoccer.replay.what_if",
            "rsoccer.replay.evaluation",
            "rsoccer.replay.film",
            "rsoccer.replay.events",
            "rsoccer.replay.container",
            "rsoccer.replay.quantized",
            "rsoccer.replay.referee_columns",
            "rsoccer.replay.file_format",
        ),
    ),
    Group(
        "Protocols",
        (
            "rsoccer.protocols",
            "rsoccer.protocols.layout",
            "rsoccer.protocols.errors",
            "rsoccer.protocols.parsing",
            "rsoccer.protocols.vision",
            "rsoccer.protocols.geometry",
            "rsoccer.protocols.cameras",
            "rsoccer.protocols.tracker",
            "rsoccer.protocols.tracked",
            "rsoccer.protocols.referee",
            "rsoccer.protocols.referee_state",
            "rsoccer.protocols.reported_referee",
            "rsoccer.protocols.game_events",
            "rsoccer.protocols.simulator_control",
            "rsoccer.protocols.robot_control",
            "rsoccer.protocols.answers",
            "rsoccer.protocols.robot_specs",
            "rsoccer.protocols.placing",
            "rsoccer.protocols.commands",
            "rsoccer.protocols.grsim",
            "rsoccer.protocols.fira",
            "rsoccer.protocols.vssref",
            "rsoccer.protocols.logs",
            "rsoccer.protocols.replay_log",
            "rsoccer.protocols.log_replay",
        ),
    ),
    Group(
        "Network",
        (
            "rsoccer.bridge",
            "rsoccer.bridge.settings",
            "rsoccer.bridge.server",
            "rsoccer.bridge.sockets",
            "rsoccer.bridge.session",
            "rsoccer.bridge.refusals",
            "rsoccer.bridge.team",
            "rsoccer.bridge.clocks",
            "rsoccer.bridge.arena",
            "rsoccer.bridge.recording",
            "rsoccer.bridge.live_page",
        ),
    ),
    Group(
        "Driving",
        (
            "rsoccer.drive",
            "rsoccer.drive.settings",
            "rsoccer.drive.network",
            "rsoccer.drive.simulator",
            "rsoccer.drive.session",
            "rsoccer.drive.connection",
            "rsoccer.drive.check",
            "rsoccer.drive.delay",
        ),
    ),
    Group("Other interfaces", ("rsoccer.compat.robosim", "rsoccer.entities")),
)
"""Every public module, once."""

LIBRARIES: Final = {
    "rsoccer.rllib": "ray",
    "rsoccer.sb3": "stable_baselines3",
    "rsoccer.torchrl": "torchrl",
}
"""Library that an integration needs, by the beginning of the names of its modules.

Sphinx does without these libraries.
"""

PRIVATE: Final = (
    "rsoccer.__main__",
    "rsoccer.benchmark.machine",
    "rsoccer.bridge.*",
    "rsoccer.checks",
    "rsoccer.cli",
    "rsoccer.commands",
    "rsoccer.commands.*",
    "rsoccer.compat",
    "rsoccer.compat.*",
    "rsoccer.demo",
    "rsoccer.drive.*",
    "rsoccer.envs",
    "rsoccer.envs.*",
    "rsoccer.evaluate.*",
    "rsoccer.files",
    "rsoccer.human",
    "rsoccer.human.*",
    "rsoccer.identify.*",
    "rsoccer.ids",
    "rsoccer.interrupts",
    "rsoccer.new_play",
    "rsoccer.registry.overrides",
    "rsoccer.task_checks",
    "rsoccer.rules.touches",
    "rsoccer.matches",
    "rsoccer.matches.*",
    "rsoccer.policies.*",
    "rsoccer.protocols.*",
    "rsoccer.render",
    "rsoccer.render.*",
    "rsoccer.replay",
    "rsoccer.replay.*",
    "rsoccer.rllib",
    "rsoccer.sensing_text",
    "rsoccer.simulated_senses",
    "rsoccer.sb3",
    "rsoccer.tasks",
    "rsoccer.tasks.courses",
    "rsoccer.tasks.legacy_names",
    "rsoccer.tasks.options",
    "rsoccer.tasks.scenarios",
    "rsoccer.tasks.vss_base",
    "rsoccer.testing",
    "rsoccer.testing.*",
    "rsoccer.train.*",
)
"""Modules without a page: parts of the implementation, and packages that only collect names.

`package.*` stands for all modules of a package that are in no group.
"""


def write(folder: Path, rust: bool) -> None:
    """Write the reference: its index and a page for each module.

    Args:
        folder: Folder of the pages.
        rust: Whether the index may link to the reference of the crates.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "index.md").write_text(index(rust))
    for group in GROUPS:
        contents = ["```{toctree}", ":hidden:", "", *group.modules, "```"]
        page = [f"# {group.title}", "", _modules(group), "", *contents, ""]
        (folder / f"{group.page}.md").write_text("\n".join(page))
    for module in modules():
        (folder / f"{module}.md").write_text(_page(module))


def modules() -> list[str]:
    """Return the names of all modules in the reference."""
    return [module for group in GROUPS for module in group.modules]


def loadable() -> list[str]:
    """Return the modules of the reference that need no library of the group `wrappers`."""
    return [module for module in modules() if library_of(module) is None]


def library_of(module: str) -> str | None:
    """Return the library of the group `wrappers` that a module needs, if any."""
    needed = (
        library
        for start, library in LIBRARIES.items()
        if module == start or module.startswith(f"{start}.")
    )
    return next(needed, None)


def found() -> list[str]:
    """Return the names of all modules that the package has."""
    # By its files: `pkgutil` finds nothing in a package that needs a library which is absent.
    folder = Path(rsoccer.__file__).parent
    names = {
        ".".join(path.relative_to(folder.parent).with_suffix("").parts).removesuffix(".__init__")
        for path in folder.rglob("*.py")
    }
    return sorted(names - {"rsoccer"} | {"rsoccer._core"})


def index(rust: bool) -> str:
    """Return the first page of the reference: the package's own names, then the modules."""
    core = stub.load()
    rows = [
        (
            f"{{py:obj}}`rsoccer.{name} <{home(name)}>`",
            _summary(getattr(core, name, getattr(rsoccer, name))),
        )
        for name in sorted(public_names(), key=str.lower)
    ]
    parts = [
        "# API reference",
        "",
        "`import rsoccer` needs NumPy, Gymnasium and PettingZoo only. These names are in the "
        "package itself; each links to the module that defines it.",
        "",
        table(("name", "summary"), rows),
    ]
    for group in GROUPS:
        parts += ["", f"## [{group.title}]({group.page}.md)", "", _modules(group)]
    parts += ["", "## Rust", "", _rust(rust), ""]
    parts += ["```{toctree}", ":hidden:", "", *(group.page for group in GROUPS), "```", ""]
    return "\n".join(parts)


RUST: Final = ROOT / "target" / "doc"
"""Folder of the reference of the crates, where `cargo doc` has been run."""


def _rust(linked: bool) -> str:
    """A paragraph on the crates, with links where their reference is part of the site."""
    text = "The physics is the crate `rsim_core`; `rsim_py` makes it the module `rsoccer._core`. "
    if not (linked and RUST.is_dir()):
        return text + "`make site` adds their reference by rustdoc."
    link = '<a href="../rust/{0}/index.html">{0}</a>'
    return text + f"Reference by rustdoc: {link.format('rsim_core')}, {link.format('_core')}."


def _modules(group: Group) -> str:
    """The modules of a group as a table."""
    rows = [(f"[`{name}`]({name}.md)", _module_summary(name)) for name in group.modules]
    return table(("module", "summary"), rows)


def public_names() -> list[str]:
    """Return the names of `rsoccer.__all__` that are objects with a reference."""
    return [name for name in rsoccer.__all__ if not name.startswith("__")]


def home(name: str) -> str:
    """Return the dotted name under which the reference has a public name of `rsoccer`.

    Raises:
        LookupError: No module of the reference has it.
    """
    thing = getattr(rsoccer, name)
    for module in loadable():
        loaded = _load(module)
        own = getattr(thing, "__module__", module) == module
        if own and getattr(loaded, name, None) is thing:
            return f"{module}.{name}"
    raise LookupError(f"rsoccer.{name}: its module is not in tools/site/api.py")


def _page(module: str) -> str:
    """The page of one module."""
    options = [":undoc-members:"] if module == "rsoccer._core" else []
    return "\n".join(
        [
            f"# {module}",
            "",
            "```{eval-rst}",
            f".. automodule:: {module}",
            *(f"   {option}" for option in options),
            "```",
            "",
        ]
    )


def _load(module: str) -> object:
    return importlib.import_module(module)


def _module_summary(name: str) -> str:
    """The first paragraph of a module's docstring, without importing what needs a library."""
    if library_of(name) is None:
        return _summary(_load(name))
    path = ROOT / "python" / f"{name.replace('.', '/')}.py"
    return _first_paragraph(ast.get_docstring(ast.parse(path.read_text())))


def _summary(thing: object) -> str:
    """The first paragraph of a docstring, in one line."""
    documented = inspect.ismodule(thing) or inspect.isclass(thing) or inspect.isroutine(thing)
    text = inspect.getdoc(thing) if documented else inspect.getdoc(type(thing))
    return _first_paragraph(text)


def _first_paragraph(text: str | None) -> str:
    """The first paragraph of a docstring as a cell of a table."""
    return " ".join((text or "").split("\n\n")[0].split()).replace("|", "\\|")
