"""Scripted policies for SSL robots, which are omnidirectional, with kicker and dribbler."""
