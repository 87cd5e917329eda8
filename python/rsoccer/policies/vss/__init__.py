"""Scripted policies for VSSS robots, which have a differential drive."""
