"""Agreement of the two contact engines in docs/physics.md, from benches/results."""

from benches import engine_agreement
from benches.engine_agreement import COMPARED, REFERENCE, Comparison, play_agrees, score_agrees
from benches.markdown import table
from benches.result_files import format_number

DIFFERENCE = "difference (95% interval)"


def play_table() -> str:
    """Return the statistics of play under both engines, with their differences."""
    _, play, _ = engine_agreement.load()
    header = ("scene", "worlds", "quantity", f"`{REFERENCE}`", f"`{COMPARED}`", DIFFERENCE)
    rows = [(*_cells(row), _verdict(agrees=play_agrees(row))) for row in play]
    limits = ["" if row.limit is None else format_number(row.limit) for row in play]
    rows = [(*row[:5], limit, *row[5:]) for row, limit in zip(rows, limits, strict=True)]
    return table((*header[:5], f"`{REFERENCE}`, ticks of 1 ms", DIFFERENCE, "agree"), rows)


def policy_table() -> str:
    """Return the success of policies under both engines, with their differences."""
    results, _, policies = engine_agreement.load()
    header = ("task and policy", "matches", "metric", f"`{REFERENCE}`", f"`{COMPARED}`")
    rows = [(*_cells(row), _verdict(agrees=score_agrees(row))) for row in policies]
    note = (
        f"`trained` is a policy trained on VSS-v0 with {results['samples']:,} samples. Measured on "
        f"{results['date']}."
    )
    return f"{note}\n\n{table((*header, DIFFERENCE, 'agree'), rows)}"


def _cells(row: Comparison) -> tuple[str, ...]:
    quantity = f"{row.quantity} ({row.unit})" if row.unit else row.quantity
    means = (format_number(row.reference), format_number(row.compared))
    interval = f"{row.difference:+.2g} ({row.low:+.2g} to {row.high:+.2g})"
    return (row.scene, str(row.count), quantity, *means, interval)


def _verdict(*, agrees: bool) -> str:
    return "yes" if agrees else "no"
