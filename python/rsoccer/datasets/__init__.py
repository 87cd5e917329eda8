"""Matches as data sets for offline learning.

    >>> from rsoccer.datasets import record_episodes
    >>> episodes = record_episodes("fetch", "SSLGoToBall-v0", 2)
    >>> episodes[0].observations.shape[0] == len(episodes[0].actions) + 1
    True

`record_episodes` plays matches with a policy in the place of the learners and returns what each of
them saw, did and was rewarded for. `save_minari` writes such episodes of several policies as a
[Minari](https://minari.farama.org) data set, which offline libraries read, by the extra `data`.
"""

from rsoccer.datasets.episodes import LearnerEpisode, record_episodes
from rsoccer.datasets.minari_dataset import save_minari

__all__ = ["LearnerEpisode", "record_episodes", "save_minari"]
