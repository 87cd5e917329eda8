"""Scripted policies for VSSS robots."""
