"""A thousand matches at once, as arrays: how often does chasing the ball beat drifting about?"""

import sys
import time

import numpy as np

import rsoccer


def main(worlds: int = 1024, steps: int = 400) -> None:
    """Play, count goals and time it."""
    controllers = {"blue": "chase", "yellow": "ou"}
    matches = rsoccer.Matches("VSSSelfPlay-v0", worlds, seed=1, threads=2, controllers=controllers)
    matches.reset()
    nobody = np.zeros((worlds, 0, matches.action_size), np.float32)  # no robot learns

    scores = []
    start = time.perf_counter()
    for _ in range(steps):
        outcome = matches.step(nobody)  # matches that ended have already begun anew
        scores.append(outcome.metrics["goal_score"][outcome.ended])
    seconds = time.perf_counter() - start

    score = np.concatenate(scores)
    won, lost = (score > 0).sum(), (score < 0).sum()
    print(f"{len(score):,} matches ended: blue won {won:,} and lost {lost:,}")
    print(f"{worlds * steps / seconds:,.0f} world-steps a second")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
