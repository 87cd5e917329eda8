"""Scripted policies for SSL robots."""
