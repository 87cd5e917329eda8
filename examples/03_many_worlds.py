"""A thousand matches at once with array interfaces: ball chasers against random drifters."""

import sys
import time

import numpy as np

import rsoccer


def main(worlds: int = 1024, steps: int = 400) -> None:
    """Play, count wins and measure the speed."""
    controllers = {"blue": "chase", "yellow": "ou"}
    matches = rsoccer.Matches("VSSSelfPlay-v0", worlds, seed=1, threads=2, controllers=controllers)
    matches.reset()
    # Scripted controllers drive all robots, so there are no agents.
    actions = np.zeros((worlds, 0, matches.action_size), np.float32)

    scores = []
    start = time.perf_counter()
    for _ in range(steps):
        outcome = matches.step(actions)  # matches that ended are reset automatically
        scores.append(outcome.metrics["goal_score"][outcome.ended])
    seconds = time.perf_counter() - start

    score = np.concatenate(scores)
    won, lost = (score > 0).sum(), (score < 0).sum()
    print(f"{len(score):,} matches ended: blue won {won:,} and lost {lost:,}")
    print(f"{worlds * steps / seconds:,.0f} world-steps per second")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
