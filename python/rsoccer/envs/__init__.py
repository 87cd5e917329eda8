"""Environments for PettingZoo and Gymnasium; `rsoccer` exports their constructors.

- `parallel`: one match for PettingZoo, all agents at once (`parallel_env`) or in turn (`env`).
- `single`: one match with one learner for Gymnasium (`single_env`).
- `vector`: many matches with one learner each for Gymnasium (`vector_env`).
- `robots_vector`: many matches for Gymnasium with a row for each robot that learns
  (`robots_vector_env`).
"""
