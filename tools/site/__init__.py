"""The documentation site: `make site` builds it into `out/site`.

`source` lays out the pages that Sphinx reads: those written by hand in `docs/`, and those written
from code (`tasks` for the pages of tasks, `api` for the reference). `matches` records a match of
each task. `meanings` holds the texts that the code does not say in a form that a program can read.
`conf` is Sphinx's configuration.
"""
