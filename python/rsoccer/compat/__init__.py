"""Interfaces of other simulators on top of this one, so that code written for them runs."""
