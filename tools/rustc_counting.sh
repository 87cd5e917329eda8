#!/bin/sh
# Compiles one of our crates with counters; tools/measure_coverage.py has cargo call it.
exec "$@" -C instrument-coverage
