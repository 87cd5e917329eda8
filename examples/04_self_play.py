"""Train a policy by self-play, measure it, and film it.

A minute of training is enough to see robots go for the ball; `make demo` trains longer.
"""

from pathlib import Path

import rsoccer
from rsoccer.render.record import record_match
from rsoccer.train import Args, train

OUT = Path("out/self_play")


def main(samples: int = 1_500_000) -> None:
    """Each world plays its own opponent: the latest self, a past one, or drifting robots."""
    args = Args(
        task="VSSSelfPlay-v0",
        out=OUT,
        samples=samples,
        latest_fraction=0.5,
        past_fraction=0.3,
        ou_fraction=0.2,
        overwrite=True,  # without it a second run refuses to replace the first
    )
    policy = train(args)  # Ctrl-C saves; Args(..., resume=True) goes on from there
    for opponent in ("zero", "ou", OUT / "untrained.safetensors"):
        print(rsoccer.evaluate(policy, opponent, matches=100))
    record_match(OUT / "match.mp4", controllers={"blue": str(policy), "yellow": "ou"})


if __name__ == "__main__":
    main()
