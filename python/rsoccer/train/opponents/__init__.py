"""Opponents of the learners, and the part of a run with one learner per match."""
