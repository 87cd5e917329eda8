"""Train a policy by self-play, evaluate it, and film a match.

After a minute of training the robots drive to the ball; `make demo` has settings for a shorter run.
"""

from pathlib import Path

import rsoccer
from rsoccer.recording import record_match
from rsoccer.train import Args, OpponentSettings, train

OUT = Path("out/self_play")


def main(samples: int = 1_500_000) -> None:
    """Train; each world plays the current policy, a past one, or a fixed one."""
    args = Args(
        task="VSSSelfPlay-v0",
        out=OUT,
        samples=samples,
        opponents=OpponentSettings(
            latest_fraction=0.5, past_fraction=0.3, fixed={"ou": 3, "scripted": 1}
        ),
        overwrite=True,  # without it a second run does not replace the first
    )
    policy = train(args)  # Ctrl-C saves; Args(..., resume=True) continues
    for opponent in ("zero", "ou", OUT / "untrained.safetensors"):
        print(rsoccer.evaluate(policy, opponent, matches=100))
    record_match(OUT / "match.mp4", controllers={"blue": str(policy), "yellow": "ou"})


if __name__ == "__main__":
    main()
