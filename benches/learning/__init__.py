"""The learning study: `python -m benches.learning`.

`table` lists the experiments: tasks, algorithms and variants, with their settings and seeds. Every
run of an experiment is learned and evaluated in a process of its own, and leaves one JSON file in
`benches/results/learning/runs`. `--report` makes docs/learning.md, its pictures and the table of
the README from these files.
"""
