#!/bin/sh
# Compiles a crate of this workspace with coverage counters; cargo calls it for
# tools/measure_coverage.py.
exec "$@" -C instrument-coverage
