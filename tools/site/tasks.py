"""Pages of the registered tasks, written from the code and from `tools.site.meanings`."""

import inspect
import math
from typing import Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from rsoccer import Matches, Task
from rsoccer.observation_layout import Block
from rsoccer.task import LEARN
from tools.site import matches, meanings, solved, task_docs
from tools.site.meanings import ROBOT, Number, Part

WEIGHTS: Final = "reward_weights"
"""Option of all tasks that has the weights of the reward terms."""


def index(names: list[str]) -> str:
    """Return the page that lists all tasks, with a picture of each."""
    rows = [_row(name) for name in names]
    header = ("task", "teams", "learners", "observation", "action", "time limit", "success")
    return "\n".join(
        [
            "# Tasks",
            "",
            "A task defines starts, actions, observations, rewards and the end of an episode. "
            "`rsoccer.make_task(name, **options)` makes one; every environment takes its name and "
            "options. VSSS robots have a differential drive; SSL robots are omnidirectional and "
            "have a kicker, a dribbler and a break beam.",
            "",
            ":::::{container} gallery",
            *(_card(name) for name in names),
            ":::::",
            "",
            "## At a glance",
            "",
            "Sizes are those with default options: numbers in a learner's observation and in its "
            "action.",
            "",
            table(header, rows),
            "",
            "```{toctree}",
            ":hidden:",
            "",
            *names,
            "```",
        ]
    )


def page(name: str) -> str:
    """Return the page of one task."""
    task = rsoccer.make_task(name)
    goal = task_docs.paragraph(task, "Goal of the task")
    sections = (
        f"# {name}",
        task_docs.summary(task),
        f"![A moment of {name}]({name}.png)",
        f"**Goal.** {_sentence(goal)}",
        _overview(task),
        "## Initial state\n\n" + _sentence(task_docs.paragraph(task, "Initial state")),
        "## Observation\n\n" + _observation(task),
        "## Action\n\n" + _action(task),
        "## Reward\n\n" + _reward(name, task),
        "## End of an episode\n\n" + _end(task),
        "## Options\n\n" + _options(task),
        "## Metrics\n\n" + _metrics(task),
        "## Solution\n\n" + _solution(name),
        "## A match\n\n" + matches.shown(name),
    )
    return "\n\n".join(sections) + "\n"


def _card(name: str) -> str:
    """A picture that links to a task's page, with the first line of its docstring."""
    return "\n".join(
        [
            f"::::{{figure}} {name}.png",
            f":alt: A moment of {name}",
            f":target: {name}.html",
            "",
            f"[{name}]({name}.md)<br>{task_docs.summary(rsoccer.make_task(name))}",
            "::::",
        ]
    )


def _row(name: str) -> tuple[str, ...]:
    """A row of the table of all tasks."""
    task = rsoccer.make_task(name)
    return (
        f"[{name}]({name}.md)",
        f"{task.n_blue} v {task.n_yellow}",
        str(len(task.agents)),
        str(task.layout.size),
        str(task.action_size),
        f"{task.max_steps * task.config.time_step:g} s",
        f"`{task.success}`",
    )


def _sentence(text: str) -> str:
    """Text that starts with a capital letter, unless it starts with the name of a robot."""
    return text if "_" in text.split(" ")[0] else text[:1].upper() + text[1:]


def _overview(task: Task) -> str:
    """The table of robots, controllers, field and ids."""
    config, controllers = task.config, task.default_controllers()
    learners = ", ".join(f"`{name}`" for name in task.agents)
    others: dict[str, list[str]] = {}
    for name, controller in controllers.items():
        if controller is not LEARN:
            others.setdefault(str(controller), []).append(f"`{name}`")
    driven = "; ".join(f"{', '.join(names)}: policy `{name}`" for name, names in others.items())
    rows = [
        ("Teams", f"{task.n_blue} blue, {task.n_yellow} yellow"),
        ("Learners", learners),
        ("Other robots", driven or "none"),
        ("Field", f"`{config.field.name}`, {config.field.length:g} x {config.field.width:g} m"),
        ("Robot", f"`{config.robot.name}`"),
        ("Ball", f"`{config.ball.name}`"),
        ("Control step", f"{config.time_step * 1000:g} ms"),
        ("Environments", _environments(task)),
        ("Source", task_docs.paragraph(task, "Source")),
    ]
    return table(("", ""), [(f"**{key}**", value) for key, value in rows])


def _environments(task: Task) -> str:
    """Calls that make the task's environments."""
    calls = [f'`rsoccer.Matches("{task.name}")`', f'`rsoccer.parallel_env("{task.name}")`']
    if len(task.agents) == 1:
        calls.append(f'`gymnasium.make("rsoccer/{task.name}")`')
    else:
        calls += [
            f'`gymnasium.make("rsoccer/{task.name}", learner="{task.agents[0]}")`',
            f'`gymnasium.make_vec("rsoccer/{task.name}", {4 * len(task.agents)})`',
        ]
    return "<br>".join(calls)


def _observation(task: Task) -> str:
    """The table of the flat observation, with the scales of its units."""
    config, limits = task.config, task.observation_limits()
    robot = config.robot
    scales = (
        f"One learner observes {task.layout.size} numbers, float32, as its own team sees the "
        "field: every team attacks +x, and y points to the left of that. Each block lists its name "
        "and shape; rows of absent robots are 0 (in `body_positions` the center of the field). A "
        f"half field length is {config.field.half_length:g} m, a top speed "
        f"{robot.top_speed:.3g} m/s and a top angular velocity "
        f"{robot.top_angular_velocity:.3g} rad/s. Numbers beyond a range are clipped to it."
    )
    rows = [
        row
        for name, block in task.layout.blocks.items()
        for row in _block(task, name, block, limits)
    ]
    return f"{scales}\n\n{table(('index', 'block', 'meaning', 'unit', 'range'), rows)}"


def _block(task: Task, name: str, block: Block, limits: dict[str, float]) -> list[tuple[str, ...]]:
    """Rows of the observation table for one block: one for each part, or one for all robots."""
    limit = f"±{limits.get(name, rsoccer.observation_layout.DEFAULT_LIMIT):g}"
    head = f"`{name}`<br>{' x '.join(map(str, block.shape))}"
    first = block.columns.start
    if not block.size:
        return []
    chosen = parts(name, block)
    if len(block.shape) == 2 and len(chosen) != block.shape[0]:
        noun = meanings.ROWS.get(name)
        each = "; ".join(part.meaning for part in chosen)
        meaning = f"for each {noun}: {each}" if noun else each
        unit = "as `ego`" if noun else chosen[0].unit
        return [(_range(first, block.size), head, meaning, unit, limit)]
    rows: list[tuple[str, ...]] = []
    for number, part in enumerate(chosen):
        size = part.size or block.size
        title = "" if number else head
        rows.append((_range(first, size), title, part.meaning, part.unit, limit))
        first += size
    return rows


def parts(name: str, block: Block) -> tuple[Part, ...]:
    """Return the parts of a block that fill its last axis, or the block as a whole."""
    if name == "ball":
        return meanings.BALL_PARTS[block.size]
    found = meanings.BLOCKS[name]
    if found == ROBOT:
        return tuple(_fill(meanings.ROBOT_PARTS, block.shape[-1]))
    assert not isinstance(found, str)
    return found


def _fill(all_parts: tuple[Part, ...], size: int) -> list[Part]:
    """Parts from the first on, as many as fill `size` numbers."""
    chosen, total = [], 0
    for part in all_parts:
        if total < size:
            chosen.append(part)
            total += part.size
    if total != size:
        raise ValueError(f"parts: expected {size} numbers, got {total}")
    return chosen


def _range(first: int, size: int) -> str:
    """Indices as text, the last one included."""
    return f"{first}" if size == 1 else f"{first}\u00a0to\u00a0{first + size - 1}"


def _action(task: Task) -> str:
    """The table of an action and, for discrete agents, the number of choices."""
    numbers = actions(task)
    scales = action_scales(task)
    rows = [
        (
            str(index),
            f"{number.name}: {number.meaning}",
            f"{scale:.3g} {number.unit}".removesuffix(" 1"),
        )
        for index, (number, scale) in enumerate(zip(numbers, scales, strict=True))
    ]
    choices = rsoccer.make_task(task.name, discrete=True).action_table
    count = 0 if choices is None else len(choices)
    return (
        f"{task.action_size} numbers in [-1, 1], float32.\n\n"
        f"{table(('index', 'meaning', 'value at 1'), rows)}\n\n"
        f"With `discrete=True` an action is one of {count} choices; "
        "`task.action_table` lists them."
    )


def actions(task: Task) -> tuple[Number, ...]:
    """Return the numbers of a task's action, by the drive of its robots."""
    return meanings.ACTIONS[task.config.robot.drive][: task.action_size]


def action_scales(task: Task) -> list[float]:
    """Return the command at an action of 1, by number of the action, in SI units."""
    scales = getattr(task, "action_scales", None)
    if scales is not None:
        return [*(float(scale) for scale in scales), 1.0][: task.action_size]  # 1 for the chip
    return [task.config.robot.max_wheel_speed] * task.action_size


def _reward(name: str, task: Task) -> str:
    """The table of reward terms with both sets of weights."""
    default, paper = weights(name), weights(name, "paper")
    terms = task_docs.reward_terms(task)
    rows = [
        (f"`{term}`", "{} ({})".format(*terms[term]), f"{weight:g}", f"{paper[term]:g}")
        for term, weight in default.items()
    ]
    return (
        "The reward of a step is the sum of these terms times their weights, which are per unit. "
        f"Terms in meters are differences of a potential. `{WEIGHTS}` replaces weights by name; "
        f'`{WEIGHTS}="paper"` takes those of the paper.\n\n'
        f"{table(('term', 'value before the weight (unit)', 'weight', 'paper'), rows)}"
    )


def weights(name: str, given: str | None = None) -> dict[str, float]:
    """Return the weights of a task by reward term: the defaults, or those under a name."""
    task = rsoccer.make_task(name, **({WEIGHTS: given} if given else {}))
    return dict(getattr(task, WEIGHTS))


def _end(task: Task) -> str:
    """Events that terminate an episode, and its time limit."""
    listed = "\n".join(f"- {event}" for event in task_docs.events(task))
    seconds = task.max_steps * task.config.time_step
    parts = ("Terminated by:", listed, task_docs.exceptions(task))
    limit = f"Truncated after {task.max_steps:,} control steps ({seconds:g} s)."
    return "\n\n".join(part for part in (*parts, limit) if part)


def _options(task: Task) -> str:
    """The table of the options."""
    meanings_of = task_docs.options(task)
    rows = []
    for option, parameter in inspect.signature(type(task)).parameters.items():
        default = f"`{_default(parameter.default, getattr(task, option))}`"
        rows.append((f"`{option}`", _type(parameter.annotation), default, meanings_of[option]))
    note = "[Physics](../physics.md#presets) lists the presets of fields, robots and balls."
    return f"{table(('option', 'type', 'default', 'meaning'), rows)}\n\n{note}"


def _default(default: object, value: object) -> str:
    """A default as Python writes it; for factories, the value that they make."""
    if isinstance(value, dict):
        return "{}"
    return repr(default if isinstance(default, str | int | float | bool | None) else value)


def _type(annotation: Any) -> str:  # noqa: ANN401  (annotations are anything)
    """An annotation as text."""
    written = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    for prefix in ("collections.abc.", "typing."):
        written = written.replace(prefix, "")
    return f"`{written}`".replace("|", "\\|")


def _metrics(task: Task) -> str:
    """The table of the metrics; the one that counts as success is marked."""
    rows = [
        (f"`{metric}`", meaning, "yes" if metric == task.success else "")
        for metric, meaning in task_docs.metrics(task).items()
    ]
    full = task.full_success
    full_text = "The success has no upper bound." if full is None else f"Full success is {full:g}."
    return (
        "`Outcome.metrics` and the infos at the end of an episode hold these numbers. Evaluations "
        f"report the mean of the success. {full_text}\n\n"
        f"{table(('metric', 'meaning', 'success'), rows)}"
    )


def metrics(task: Task) -> list[str]:
    """Return the names of the metrics that a task reports."""
    matches = Matches(task)
    matches.reset()
    actions = np.zeros((1, len(matches.agents), matches.action_size), np.float32)
    return list(matches.step(actions).metrics)


def _solution(name: str) -> str:
    """Return the measured results of a shipped policy, as text."""
    kept = solved.load()
    found = kept["tasks"][name]
    against = (
        "" if found["opponent"] in ("-", "zero", "hold") else f" against `{found['opponent']}`"
    )
    interval = f"(95% interval {found['low']:g} to {found['high']:g})"
    if math.isclose(found["low"], found["high"]):
        interval = "(the same in every match)"
    options = "".join(f", {option}={value!r}" for option, value in found["options"].items())
    task, shorter = f'"{name}"', ""
    if options:
        task, shorter = f'rsoccer.make_task("{name}"{options})', f" with `{options[2:]}`"
    return (
        f"The policy `{found['policy']}`{against} reaches a mean `{found['metric']}` of "
        f"{found['score']:g} {interval} over {kept['matches']} matches{shorter}; an episode lasts "
        f"{found['seconds']:g} s on average.\n\n"
        "```python\nimport rsoccer\n\n"
        f'print(rsoccer.evaluate("{found["policy"]}", task={task}, matches=20))\n```'
    )
