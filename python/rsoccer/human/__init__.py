"""Matches in which a person drives a robot by keyboard or gamepad."""
