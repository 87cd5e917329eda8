"""Running a study: learning, evaluation, and the state of its runs."""
