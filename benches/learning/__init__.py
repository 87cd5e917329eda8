"""The learning study: `python -m benches.learning`.

`table` lists the experiments: tasks, algorithms and variants, with their settings and seeds. Every
run of an experiment is learned and evaluated in a process of its own, and leaves one JSON file in
`benches/results/learning/runs`: the package `running`. `--report` makes the pages of the study and
their pictures from these files alone: the package `reporting`. Neither imports the other; both know
the study and the conditions of a result, the modules of this folder.
"""
