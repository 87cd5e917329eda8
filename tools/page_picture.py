"""The picture of a match page in docs/page.png: `python -m tools.page_picture`; needs Chromium."""

import shutil
import subprocess
import tempfile
from pathlib import Path

from PIL import Image

from rsoccer.replay import record_replay
from rsoccer.replay.page import to_html

PICTURE = Path(__file__).parents[1] / "docs" / "page.png"
SIZE = (1180, 830)
SEED = 2
BEFORE_GOAL = 14
"""Frames between the moment and the second goal of the match."""
SHOW = "p.pause(); p.select(0); p.seek({frame}); p.draw();"


def main() -> None:
    """Record a match, open its page at a moment and keep what a browser shows."""
    teams = {"blue": "scripted", "yellow": "chase"}
    replay = record_replay(
        "VSSSelfPlay-v0", teams, seed=SEED, seconds=20.0, names=("SCRIPTED", "CHASE")
    )
    goals = [event.frame for event in replay.events if event.kind == "goal"]
    script = SHOW.format(frame=goals[1] - BEFORE_GOAL)
    added = f"<script>window.rsoccerPlayer.then((p) => {{ {script} }});</script></body>"
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder, "page.html"), Path(folder, "page.png")
        page.write_text(to_html(replay).replace("</body>", added))
        browser = shutil.which("chromium") or shutil.which("google-chrome") or "chrome"
        flags = ["--headless=new", "--no-sandbox", "--hide-scrollbars", f"--screenshot={shot}"]
        flags += [f"--user-data-dir={folder}/profile", "--virtual-time-budget=4000"]
        size = ",".join(map(str, SIZE))
        subprocess.run([browser, *flags, f"--window-size={size}", page.as_uri()], check=True)
        # The default method drops colors of a few pixels, such as those of the ball and the chart.
        picture = Image.open(shot).convert("RGB").quantize(256, Image.Quantize.FASTOCTREE)
        picture.save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
