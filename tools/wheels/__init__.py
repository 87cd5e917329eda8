"""Wheels and the source distribution: built, audited, and tried without a compiler."""
