"""Scripted policies for VSSS robots, which drive on two wheels."""
