"""Layers of the package: a module imports only from earlier layers."""

import ast
import graphlib
import subprocess
import sys
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

import rsoccer

ROOT = Path(rsoccer.__file__).parent

# An entry is a module, or a package with all of its modules that have no entry of their own.
# Modules of the same layer do not import each other. The order is also a reading order.
LAYERS = [
    {"_core"},
    {
        *{"arrays", "files", "markers", "matches.consistency", "option_values", "plugins"},
        *{"interrupts", "option_words", "sensing_text"},
    },
    {"frame", "reflection", "vectors"},
    {"rng", "game", "global_state", "view", "entities"},
    {"checks", "derived", "randomization"},
    {"senses"},
    {"play"},
    {"rules"},
    {"referee"},
    {"task_definition"},
    {"task_checks"},
    {"encoded_blocks", "new_play"},
    {"observation_layout"},
    {"task", "matches.outcome", "matches.result_checks", "simulator_interface", "compat"},
    {"completed", "history", "placed_by_hand"},
    {"ids", "render", "simulated_senses", "sources", "spaces"},
    {"registry", "spawn", "rewards"},
    {"tasks"},
    {"policies"},
    {"controllers"},
    {"lineup"},
    {
        "matches.changes",
        "matches.learners",
        "matches.match_state",
        "matches.paused",
        "matches.sensing",
        "matches.starts",
    },
    {"matches.loop"},
    {"matches", "matches.policy_match"},
    {"envs"},
    {"envs.agent_dicts", "envs.env_matches", "envs.options"},
    {"envs.viewer"},
    {"envs.robot_rows"},
    {"envs.parallel", "envs.robots_vector", "envs.single", "evaluate", "recording"},
    {"envs.aec", "envs.vector"},
    {"__init__"},
    {"benchmark", "datasets", "identify", "testing", "torchrl"},
    {"replay"},
    {"match_evaluation"},
    {"sb3"},
    {"protocols.errors", "protocols.protobuf"},
    {"protocols.layout", "protocols.schemas"},
    {"protocols"},
    {"bridge.match_tasks", "bridge.message_rows", "bridge.message_template"},
    {"bridge.refusals", "bridge.team"},
    {"bridge.arena", "bridge.clocks", "bridge.control_reader", "bridge.settings"},
    {"bridge.stand_ins", "bridge.tracker_packets", "bridge.vision_packets"},
    {"bridge.session"},
    {"bridge.awaited_answers", "bridge.external_referee", "bridge.officials"},
    {"bridge.ssl_ports", "bridge.vsss_ports"},
    {"bridge.server"},
    {"bridge.recording", "bridge.sockets"},
    {"bridge", "bridge.live_page"},
    {"drive.settings", "drive.vision_clock", "drive.guard"},
    {"drive.kicks", "drive.peers"},
    {"drive.link", "drive.officials", "drive.sight"},
    {"drive.guard_process", "drive.state_sight"},
    {"drive.reception"},
    {"drive.connection"},
    {"drive.delay", "drive.simulator"},
    {"drive.check", "drive.network"},
    {"drive", "drive.session"},
    {"train.setting_types", "train.clock", "train.prefixes", "train.workers"},
    {"train.network", "train.opponents", "train.rollout.settings", "train.run.settings"},
    {"train.rollout"},
    {"train.ppo"},
    {"train.task_settings"},
    {"train.args"},
    {"train.run"},
    {"train.distillation"},
    {"train"},
    {"human", "rllib"},
    {"commands", "demo"},
    {"cli"},
    {"__main__"},
]
KNOWN = set().union(*LAYERS)


def module_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return entry_of(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)


def entry_of(parts: Sequence[str]) -> str:
    """Return the longest entry of LAYERS that is a prefix of the module's name."""
    names = [".".join(parts[:end]) for end in range(len(parts), 0, -1)]
    return next((name for name in names if name in KNOWN), "__init__")


def rank(module: str) -> int:
    return next(i for i, layer in enumerate(LAYERS) if module in layer)


def full_names(node: ast.AST) -> list[str]:
    """Return the names that a statement imports from the package, with their modules."""
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom) and node.module:
        names = [f"{node.module}.{alias.name}" for alias in node.names]
    else:
        return []
    return [name for name in names if name.split(".")[0] == "rsoccer"]


def imported(node: ast.AST) -> list[str]:
    """Return the modules of the package that a statement imports."""
    return [entry_of(name.split(".")[1:]) for name in full_names(node)]


def imports() -> Iterator[tuple[str, str]]:
    """Yield importing and imported module, of imports in functions and for type checkers too."""
    for path in ROOT.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            for name in imported(node):
                yield module_of(path), name


def test_every_module_has_a_layer() -> None:
    modules = {module_of(path) for path in ROOT.rglob("*.py")} | {"_core"}
    assert modules == KNOWN


def test_modules_import_only_from_earlier_layers() -> None:
    found = list(imports())
    backward = {
        f"{importer} imports {name}"
        for importer, name in found
        if importer != name and rank(name) >= rank(importer)
    }
    assert not backward
    assert len(found) > 100, "imports are found"


def test_importing_the_package_loads_no_heavy_library() -> None:
    heavy = ["torch", "pygame", "PIL", "matplotlib", "safetensors", "tyro", "tqdm"]
    heavy += ["stable_baselines3", "torchrl", "ray", "onnx", "onnxruntime", "minari"]
    program = f"import sys, rsoccer; sys.exit(str([m for m in {heavy} if m in sys.modules] or ''))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stderr.strip() == ""


def files() -> dict[str, Path]:
    """Return all modules of the package but its root, which exports their names."""
    paths = {path.relative_to(ROOT).with_suffix("").parts: path for path in ROOT.rglob("*.py")}
    names = {".".join(p[:-1] if p[-1] == "__init__" else p): path for p, path in paths.items()}
    return {name: path for name, path in names.items() if name}


def used(path: Path, modules: Collection[str]) -> set[str]:
    """Return the modules that a file imports from."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        for name in full_names(node):
            parts = name.split(".")[1:]
            prefixes = [".".join(parts[:end]) for end in range(len(parts), 0, -1)]
            names |= set([prefix for prefix in prefixes if prefix in modules][:1])
    return names


def test_modules_do_not_import_each_other_in_cycles() -> None:
    """Formerly a replay imported the page that it became, whose module imported the replay."""
    modules = files()
    graph = {name: used(path, modules) - {name} for name, path in modules.items()}
    assert sum(map(len, graph.values())) > 500, "imports are found"
    order = [*graphlib.TopologicalSorter(graph).static_order()]  # raises for a cycle
    assert order.index("replay.recorded") < order.index("replay.page") < order.index("replay")
