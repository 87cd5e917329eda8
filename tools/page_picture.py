"""Pictures of the pages of matches in docs/: `python -m tools.page_picture`; needs Chromium."""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

import rsoccer
from rsoccer.policies import make_policy
from rsoccer.replay import Replay, record_replay
from rsoccer.replay.page import to_html
from tools import whole_matches
from tools.paths import DOCS

SIZE = (1180, 830)
MATCH_SIZE = (1340, 860)
"""Size of a page with a referee, whose panel has statistics too."""
SEED = 2
BEFORE_GOAL = 14
"""Frames between the moment and the second goal of the match."""
AFTER_EVENT = 40
"""Frames between an event and the moment of a match with a referee."""
SHOW = "p.pause(); p.select(0); p.seek({frame}); p.draw();"


def main() -> None:
    """Record matches, open their pages at a moment and keep what a browser shows."""
    replay = self_play()
    goals = [event.frame for event in replay.events if event.kind == "goal"]
    save(replay, goals[1] - BEFORE_GOAL, DOCS / "page.png", SIZE)
    late = sensed()
    save(late, farthest(late), DOCS / "page_sensed.png", SIZE)
    for name in whole_matches.WHOLE_MATCHES:
        match = whole_matches.record(name)
        save(match, moment(match), DOCS / f"{name}.png", MATCH_SIZE)


def self_play() -> Replay:
    """Return a match of two VSSS sides without a referee."""
    teams = {"blue": "scripted", "yellow": "chase"}
    return record_replay(
        "VSSSelfPlay-v0", teams, seed=SEED, seconds=20.0, names=("SCRIPTED", "CHASE")
    )


def sensed() -> Replay:
    """Return an SSL match of six a side in which robots see a tenth of a second late.

    No team forecasts, so that ghosts show what was seen.
    """
    task = rsoccer.make_task("SSLSelfPlay-v0", n_blue=6, n_yellow=6)
    sensing = rsoccer.Sensing("rc2021", delay=0.1)
    script = make_policy("scripted", task)
    script.forecasts = False
    teams = {"blue": script, "yellow": script}
    return record_replay(
        task, teams, seed=SEED, seconds=12.0, names=("BLUE", "YELLOW"), sensing=sensing
    )


def farthest(replay: Replay) -> int:
    """Return the frame in which the ball is farthest from where the robots believe it."""
    assert replay.sensed is not None
    off = np.linalg.norm(replay.sensed.ball - replay.frame.ball.position, axis=-1)
    return int(off.argmax())


def moment(replay: Replay) -> int:
    """Return a frame shortly after the first goal, or after the first event without goals."""
    goals = [event.frame for event in replay.events if event.kind == "goal"]
    announced = [frame for frame, words in enumerate(replay.announcements) if words.text]
    return min((goals or announced or [0])[0] + AFTER_EVENT, len(replay) - 1)


def save(replay: Replay, frame: int, picture: Path, size: tuple[int, int]) -> None:
    """Write what a browser shows of a page at a frame.

    Args:
        replay: The replay.
        frame: The frame.
        picture: The file.
        size: Width and height of the window, pixels.
    """
    script = SHOW.format(frame=frame)
    added = f"<script>window.rsoccerPlayer.then((p) => {{ {script} }});</script></body>"
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder, "page.html"), Path(folder, "page.png")
        page.write_text(to_html(replay).replace("</body>", added))
        browser = shutil.which("chromium") or shutil.which("google-chrome") or "chrome"
        flags = ["--headless=new", "--no-sandbox", "--hide-scrollbars", f"--screenshot={shot}"]
        flags += [f"--user-data-dir={folder}/profile", "--virtual-time-budget=4000"]
        window = f"--window-size={size[0]},{size[1]}"
        subprocess.run([browser, *flags, window, page.as_uri()], check=True)
        # The default method drops colors of a few pixels, such as those of the ball and the chart.
        image = Image.open(shot).convert("RGB").quantize(256, Image.Quantize.FASTOCTREE)
        image.save(picture, optimize=True)


if __name__ == "__main__":
    main()
