"""Compatibility: interfaces of other simulators on this one, for code written for them."""
